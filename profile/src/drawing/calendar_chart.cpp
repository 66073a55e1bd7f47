#include "drawing/calendar_chart.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "drawing/axis.hpp"
#include "drawing/palette.hpp"

namespace itin::profile {

namespace {

constexpr std::uint32_t kMinutesOfDay = 1440, kMinutesOfHour = 60;
constexpr Rgba kNight{208, 213, 224, 255}, kDaylight{255, 255, 255, 255}, kSeveralTurbines{40, 40, 40, 255};
constexpr Colour kSunrise{0.88, 0.55, 0.05}, kSunset{0.55, 0.20, 0.45}, kWithinLimit{0.55, 0.58, 0.63},
    kBeyondLimit{0.59, 0.12, 0.12};

Colour opaque_colour(const Rgba& c) {
  return {c.red / 255.0, c.green / 255.0, c.blue / 255.0};
}

/// Returns the days of the year before each month, and all of its days.
std::array<std::uint32_t, 13> days_before_months(int year) {
  using namespace std::chrono;
  const sys_days first = sys_days{std::chrono::year{year} / 1 / 1};
  std::array<std::uint32_t, 13> days{};
  for (unsigned m = 1; m < days.size(); ++m) {
    const sys_days last = std::chrono::year{year} / month{m} / std::chrono::last;
    days[m] = static_cast<std::uint32_t>((last - first).count() + 1);
  }
  return days;
}

/// The minutes of a year, and whose shadow flickers in each.
struct CalendarCells {
  explicit CalendarCells(const FlickerCalendar& calendar, std::uint32_t days)
      : colours(std::size_t{days} * kMinutesOfDay, kNight), of_days(days) {
    for (const CalendarMinutes& run : calendar.daylight)
      for (std::uint32_t m = run.first; m < run.first + run.count; ++m) colours[m] = kDaylight;
    std::vector<bool> taken(colours.size());
    for (const CalendarTurbine& turbine : calendar.turbines)
      for (const CalendarMinutes& run : turbine.flicker)
        for (std::uint32_t m = run.first; m < run.first + run.count; ++m) {
          several = several || taken[m];
          colours[m] = taken[m] ? kSeveralTurbines : turbine.colour;
          of_days[m / kMinutesOfDay] += taken[m] ? 0 : 1;
          taken[m] = true;
        }
  }

  std::vector<Rgba> colours;           ///< what each minute is drawn in
  std::vector<std::uint32_t> of_days;  ///< minutes with flicker on each day
  bool several = false;                ///< turbines flicker in the same minute
};

class CalendarChart {
 public:
  CalendarChart(Drawing& drawing, const Box& box, const FlickerCalendar& calendar, double type)
      : drawing_(drawing),
        calendar_(calendar),
        type_(type),
        months_(days_before_months(calendar.year)),
        cells_(calendar, months_.back()),
        hours_(hours_of_day(calendar)) {
    const double left = box.xmin + 34 * type, right = box.xmax - 4 * type;
    const double strip = 0.15 * box.height(), legend = 16 * type, names = 12 * type;
    strip_ = {left, box.ymax - legend - strip, right, box.ymax - legend};
    frame_ = {left, box.ymin + names, right, strip_.ymin - 7 * type};
    legend_ = box.ymax - 3 * type;
    day_ = {0, static_cast<double>(months_.back()), left, right};
    minute_ = {static_cast<double>(hours_.first * kMinutesOfHour), static_cast<double>(hours_.second * kMinutesOfHour),
               frame_.ymax, frame_.ymin};
  }

  void draw() {
    draw_minutes();
    draw_grid();
    draw_sun(true, kSunrise);
    draw_sun(false, kSunset);
    drawing_.outline(frame_, {kInk, 0.6 * type_, {}});
    draw_days();
    draw_legend();
  }

 private:
  /// The hours between which it is day, or flickers, at some time of the year.
  static std::pair<std::uint32_t, std::uint32_t> hours_of_day(const FlickerCalendar& calendar) {
    std::uint32_t low = kMinutesOfDay, high = 0;
    const auto take = [&](const CalendarMinutes& run) {
      const std::uint32_t from = run.first % kMinutesOfDay;
      low = std::min(low, from), high = std::max(high, from + run.count);
    };
    for (const CalendarMinutes& run : calendar.daylight) take(run);
    for (const CalendarTurbine& turbine : calendar.turbines)
      for (const CalendarMinutes& run : turbine.flicker) take(run);
    if (low >= high) return {0, 24};
    return {low / kMinutesOfHour, (high + kMinutesOfHour - 1) / kMinutesOfHour};
  }

  void draw_minutes() {
    const std::uint32_t first = hours_.first * kMinutesOfHour, end = hours_.second * kMinutesOfHour;
    std::vector<Rgba> colours;
    for (std::uint32_t minute = end; minute-- > first;)
      for (std::uint32_t day = 0; day < months_.back(); ++day)
        colours.push_back(cells_.colours[std::size_t{day} * kMinutesOfDay + minute]);
    drawing_.cells(frame_, {months_.back(), end - first}, colours);
  }

  void draw_grid() {
    const Stroke fine{{0.6, 0.62, 0.66, 0.55}, 0.3 * type_, {}};
    const Lettering small{.size = 7 * type_, .colour = kInk, .align = Align::kCentre};
    Lettering right = small;
    right.align = Align::kRight;
    static constexpr std::array kMonths{"January", "February", "March",     "April",   "May",      "June",
                                        "July",    "August",   "September", "October", "November", "December"};
    for (std::size_t m = 0; m < kMonths.size(); ++m) {
      const double from = day_.at(months_[m]), to = day_.at(months_[m + 1]);
      if (m > 0) drawing_.polyline(std::array{Point2{from, frame_.ymin}, Point2{from, strip_.ymax}}, fine);
      drawing_.text({(from + to) / 2, frame_.ymin - 3 * type_}, kMonths[m], small);
    }
    for (std::uint32_t hour = hours_.first; hour <= hours_.second; ++hour) {
      if (hour % 2 != 0) continue;
      const double y = minute_.at(hour * kMinutesOfHour);
      drawing_.polyline(std::array{Point2{frame_.xmin, y}, Point2{frame_.xmax, y}}, fine);
      drawing_.text({frame_.xmin - 3 * type_, y + 2.5 * type_}, fmt::format("{:02}:00", hour), right);
    }
  }

  /// Draws when the sun rises, or sets, on each day on which it does.
  void draw_sun(bool rises, const Colour& colour) {
    constexpr double kLeap = 30;  // minutes: between days that differ by more, no line is drawn
    std::vector<Point2> line;
    double before = 0;
    const auto end_line = [&] {
      if (line.size() > 1) drawing_.polyline(line, {colour, 0.9 * type_, {}});
      line.clear();
    };
    for (const CalendarMinutes& run : calendar_.daylight) {
      const std::uint32_t at = rises ? run.first : run.first + run.count, day = run.first / kMinutesOfDay;
      const double minute = at - day * kMinutesOfDay;
      if (minute == 0 || minute == kMinutesOfDay) continue;  // the day before or after goes on
      const Point2 p{day_.at(day + 0.5), minute_.at(minute)};
      if (!line.empty() &&
          (std::abs(minute - before) > kLeap || p.x - line.back().x > 1.5 * day_.at(1) - 1.5 * day_.at(0)))
        end_line();
      line.push_back(p), before = minute;
    }
    end_line();
  }

  /// Draws how many minutes each day has, and the limit.
  void draw_days() {
    const auto most = static_cast<double>(*std::max_element(cells_.of_days.begin(), cells_.of_days.end()));
    const double limit = calendar_.limit_minutes_day.value_or(0);
    const Axis minutes{0, 1.05 * std::max({most, 1.2 * limit, 10.0}), strip_.ymax, strip_.ymin};
    constexpr double kOver = 0.3;  // neighbours overlap, so that no light shows between them
    for (std::uint32_t day = 0; day < months_.back(); ++day) {
      const std::uint32_t count = cells_.of_days[day];
      if (count == 0) continue;
      const bool beyond = calendar_.limit_minutes_day && count > *calendar_.limit_minutes_day;
      drawing_.rectangle({day_.at(day), minutes.at(count), day_.at(day + 1) + kOver, strip_.ymax},
                         beyond ? kBeyondLimit : kWithinLimit);
    }
    const Lettering right{.size = 6.5 * type_, .colour = kInk, .align = Align::kRight};
    for (const double tick : minutes.ticks(3))
      drawing_.text({strip_.xmin - 3 * type_, minutes.at(tick) + 2 * type_}, tick_label(tick, minutes.step(3)), right);
    drawing_.text({strip_.xmin - 24 * type_, (strip_.ymin + strip_.ymax) / 2}, "min",
                  {.size = 6.5 * type_, .colour = kFaint, .align = Align::kCentre, .rotation_deg = 90});
    if (calendar_.limit_minutes_day)
      drawing_.polyline(std::array{Point2{strip_.xmin, minutes.at(limit)}, Point2{strip_.xmax, minutes.at(limit)}},
                        {kInk, 0.6 * type_, {3 * type_, 2 * type_}});
    drawing_.outline(strip_, {kInk, 0.5 * type_, {}});
  }

  void draw_legend() {
    double x = frame_.xmin;
    const Lettering lettering{.size = 7 * type_, .colour = kInk};
    const auto add = [&](const Colour& colour, double height, const std::string& text) {
      const double width = 12 * type_, middle = legend_ - 2.5 * type_;
      const std::string fitted = drawing_.fitted(text, std::max(0.0, frame_.xmax - x - width), lettering);
      drawing_.rectangle({x, middle - height / 2, x + width, middle + height / 2}, colour);
      drawing_.text({x + width + 3 * type_, legend_}, fitted, lettering);
      x += width + 12 * type_ + drawing_.text_width(fitted, lettering);
    };
    const double patch = 7 * type_, line = 1 * type_;
    add(kSunrise, line, "sunrise"), add(kSunset, line, "sunset");
    for (const CalendarTurbine& turbine : calendar_.turbines) add(opaque_colour(turbine.colour), patch, turbine.name);
    if (cells_.several) add(opaque_colour(kSeveralTurbines), patch, "several of them at once");
    if (calendar_.limit_minutes_day)
      add(kBeyondLimit, patch, fmt::format("day with more than {:g} minutes", *calendar_.limit_minutes_day));
    if (calendar_.turbines.empty()) add({1, 1, 1}, 0, "no shadow flicker");
  }

  Drawing& drawing_;
  const FlickerCalendar& calendar_;
  double type_;
  std::array<std::uint32_t, 13> months_;  ///< the days before each, and all of the year
  CalendarCells cells_;
  std::pair<std::uint32_t, std::uint32_t> hours_;
  Box frame_, strip_;
  double legend_ = 0;
  Axis day_, minute_;
};

}  // namespace

void draw_calendar(Drawing& drawing, const Box& box, const FlickerCalendar& calendar, double type) {
  CalendarChart(drawing, box, calendar, type).draw();
}

std::string draw_flicker_calendar(const FlickerCalendar& calendar, const std::string& path) {
  constexpr double kWidth = 1120, kHeight = 440, kMargin = 14;
  const auto format = Drawing::format_of(path);
  if (!format || *format == Drawing::Format::kSvg)
    throw InputError(fmt::format("{}: a calendar of flicker ends in .pdf or .png", path));
  Drawing drawing(*format, kWidth, kHeight, 1.5);
  drawing.rectangle({0, 0, kWidth, kHeight}, kPaper);
  drawing.text(
      {kMargin, 24}, calendar.title,
      drawing.lettering_for(calendar.title, kWidth - 2 * kMargin, 1, {.size = 13, .colour = kInk, .bold = true}));
  draw_calendar(drawing, {kMargin, 36, kWidth - kMargin, kHeight - 30}, calendar, 1.15);
  drawing.text({kMargin, kHeight - 12}, drawing.fitted(calendar.note, kWidth - 2 * kMargin, {.size = 8}),
               {.size = 8, .colour = kFaint});
  return drawing.finish();
}

}  // namespace itin::profile
