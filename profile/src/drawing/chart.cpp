#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/chart.hpp>

#include "drawing/axis.hpp"
#include "drawing/drawing.hpp"
#include "drawing/palette.hpp"
#include "drawing/theme_colour.hpp"

namespace itin::profile {

namespace {

constexpr double kChartWidth = 780, kChartHeight = 360;
constexpr Colour kGround{0.86, 0.83, 0.76}, kVoid{0.95, 0.95, 0.95};
// Colours from the palette of Okabe and Ito, which differ with every kind of colour blindness.
constexpr std::array<Colour, 6> kLines{{{0.30, 0.24, 0.15},
                                        {0.00, 0.45, 0.70},
                                        {0.84, 0.37, 0.00},
                                        {0.00, 0.62, 0.45},
                                        {0.80, 0.47, 0.65},
                                        {0.90, 0.62, 0.00}}};

class ChartPage {
 public:
  ChartPage(const Chart& chart, Drawing::Format format)
      : chart_(chart),
        drawing_(format, kChartWidth, kChartHeight),
        frame_{58, 54, kChartWidth - 18, kChartHeight - 42} {
    place_axes();
  }

  std::string run() {
    drawing_.rectangle({0, 0, kChartWidth, kChartHeight}, {1, 1, 1});
    const Lettering title{.size = 12, .colour = kInk, .bold = true}, note{.size = 8, .colour = kFaint};
    drawing_.text({frame_.xmin, 20}, drawing_.fitted(chart_.title, frame_.width(), title), title);
    drawing_.text({frame_.xmin, 34}, drawing_.fitted(chart_.note, frame_.width(), note), note);
    if (!empty_) draw_gaps();
    draw_grid();
    if (!empty_) draw_series();
    draw_corners();
    draw_axes();
    draw_legend();
    return drawing_.finish();
  }

 private:
  void place_axes() {
    double low = 0, high = 0, length = 0;
    for (const ChartSeries& s : chart_.series) {
      length = std::max(length, s.profile.length_m);
      for (const ProfilePoint& p : s.profile.points) {
        low = empty_ ? p.ground_m : std::min(low, p.ground_m);
        high = empty_ ? p.ground_m : std::max(high, p.ground_m);
        empty_ = false;
      }
    }
    // The margins are at least a metre together, lest rounding errors look like hills.
    const double margin = std::max(0.06 * (high - low), 0.5);
    in_km_ = length >= 2000;
    x_ = {0, length > 0 ? length / unit() : 1, frame_.xmin, frame_.xmax};
    y_ = {low - margin, high + margin, frame_.ymax, frame_.ymin};
  }

  double unit() const { return in_km_ ? 1000 : 1; }
  Point2 at(const ProfilePoint& p) const { return {x_.at(p.distance_m / unit()), y_.at(p.ground_m)}; }

  /// Returns the points of each stretch of ground without gaps.
  static std::vector<std::vector<ProfilePoint>> stretches(const Profile& profile) {
    std::vector<std::vector<ProfilePoint>> result;
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
      if (i == 0 || !profile.joined(i - 1)) result.emplace_back();
      result.back().push_back(profile.points[i]);
    }
    return result;
  }

  void draw_gaps() {
    for (const auto& [from, to] : chart_.series.front().profile.gaps) {
      drawing_.rectangle({x_.at(from / unit()), frame_.ymin, x_.at(to / unit()), frame_.ymax}, kVoid);
    }
  }

  void draw_grid() {
    for (const double v : x_.ticks(10)) line({x_.at(v), frame_.ymin}, {x_.at(v), frame_.ymax}, {kGrid, 0.6, {}});
    for (const double v : y_.ticks(7)) line({frame_.xmin, y_.at(v)}, {frame_.xmax, y_.at(v)}, {kGrid, 0.6, {}});
  }

  void draw_series() {
    drawing_.clip(frame_);
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      if (i == 0) fill_first();
      for (const auto& stretch : stretches(chart_.series[i].profile)) drawing_.polyline(placed(stretch), stroke(i));
    }
    drawing_.unclip();
  }

  /// Numbers the corners so far as there is room.
  void draw_corners() {
    constexpr double kRoom = 44;
    double labelled = frame_.xmin - kRoom;
    for (std::size_t i = 0; i < chart_.corners_m.size(); ++i) {
      const double x = x_.at(chart_.corners_m[i] / unit());
      line({x, frame_.ymin + 10}, {x, frame_.ymax}, {kFaint, 0.8, {3, 3}});
      if (x - labelled < kRoom) continue;
      labelled = x;
      drawing_.text({x, frame_.ymin + 7}, fmt::format("corner {}", i + 1),
                    {.size = 8, .colour = kFaint, .align = Align::kCentre});
    }
  }

  std::vector<Point2> placed(const std::vector<ProfilePoint>& stretch) const {
    std::vector<Point2> points;
    for (const ProfilePoint& p : stretch) points.push_back(at(p));
    return points;
  }

  /// Draws features first: the ground covers the parts of them within it.
  void fill_first() {
    const Profile& profile = chart_.series.front().profile;
    for (const FeatureRun& run : feature_runs(profile)) {
      std::vector<Point2> top;
      for (std::size_t i = run.first; i <= run.last; ++i) top.push_back(at(profile.points[i]));
      fill_below(top, theme_colour(run.theme));
      themes_.insert(run.theme);
    }
    for (const auto& stretch : stretches(chart_.ground.points.empty() ? profile : chart_.ground)) {
      fill_below(placed(stretch), kGround);
    }
  }

  void fill_below(std::vector<Point2> points, const Colour& colour) {
    points.push_back({points.back().x, frame_.ymax});
    points.push_back({points.front().x, frame_.ymax});
    drawing_.polygon(points, colour);
  }

  static Stroke stroke(std::size_t i) { return {kLines[i % kLines.size()], i == 0 ? 1.2 : 1.0, {}}; }

  void draw_axes() {
    const Point2 corners[] = {{frame_.xmin, frame_.ymin}, {frame_.xmin, frame_.ymax}, {frame_.xmax, frame_.ymax}};
    drawing_.polyline(corners, {kInk, 0.8, {}});
    for (const double v : x_.ticks(10)) {
      line({x_.at(v), frame_.ymax}, {x_.at(v), frame_.ymax + 4}, {kInk, 0.8, {}});
      drawing_.text({x_.at(v), frame_.ymax + 14}, tick_label(v, x_.step(10)),
                    {.colour = kInk, .align = Align::kCentre});
    }
    for (const double v : y_.ticks(7)) {
      line({frame_.xmin - 4, y_.at(v)}, {frame_.xmin, y_.at(v)}, {kInk, 0.8, {}});
      drawing_.text({frame_.xmin - 7, y_.at(v) + 3}, tick_label(v, y_.step(7)),
                    {.colour = kInk, .align = Align::kRight});
    }
    drawing_.text({(frame_.xmin + frame_.xmax) / 2, frame_.ymax + 30}, in_km_ ? "distance, km" : "distance, m",
                  {.colour = kInk, .align = Align::kCentre});
    drawing_.text({16, (frame_.ymin + frame_.ymax) / 2}, "elevation, m",
                  {.colour = kInk, .align = Align::kCentre, .rotation_deg = 90});
    const double across = (x_.high - x_.low) * unit() / (x_.to - x_.from), up = (y_.high - y_.low) / (y_.from - y_.to);
    drawing_.text({frame_.xmax, frame_.ymax + 30}, fmt::format("vertical exaggeration {:.3g}", across / up),
                  {.size = 8, .colour = kFaint, .align = Align::kRight});
  }

  void draw_legend() {
    double x = frame_.xmin;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const Lettering lettering{.size = 8, .colour = kInk};
      line({x, 44}, {x + 16, 44}, stroke(i));
      drawing_.text({x + 20, 47}, chart_.series[i].name, lettering);
      x += 34 + drawing_.text_width(chart_.series[i].name, lettering);
    }
    for (const std::uint16_t theme : themes_) {
      const Lettering lettering{.size = 8, .colour = kInk};
      const std::string name = theme < chart_.themes.size() ? chart_.themes[theme] : fmt::format("theme {}", theme);
      drawing_.rectangle({x, 40, x + 16, 48}, theme_colour(theme));
      drawing_.text({x + 20, 47}, name, lettering);
      x += 34 + drawing_.text_width(name, lettering);
    }
  }

  void line(Point2 a, Point2 b, const Stroke& stroke) { drawing_.polyline(std::array{a, b}, stroke); }

  const Chart& chart_;
  Drawing drawing_;
  Box frame_;
  Axis x_, y_;
  bool in_km_ = false;
  bool empty_ = true;
  std::set<std::uint16_t> themes_;  ///< themes met on the profile
};

}  // namespace

void require_chart_format(const std::string& path) {
  if (!Drawing::format_of(path)) throw InputError(fmt::format("{}: a chart ends in .svg, .pdf or .png", path));
}

std::string draw_chart(const Chart& chart, const std::string& path) {
  require_chart_format(path);
  return ChartPage(chart, *Drawing::format_of(path)).run();
}

}  // namespace itin::profile
