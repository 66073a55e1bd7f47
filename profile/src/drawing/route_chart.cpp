#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/route_chart.hpp>

#include "drawing/axis.hpp"
#include "drawing/drawing.hpp"
#include "drawing/palette.hpp"

namespace itin::profile {

namespace {

constexpr double kRouteWidth = 780, kRouteHeight = 260;
constexpr Colour kTips{0.60, 0.78, 0.91}, kHubs{0.00, 0.35, 0.60}, kUnknown{0.90, 0.90, 0.92},
    kUndecided{0.68, 0.68, 0.68};

class RoutePage {
 public:
  RoutePage(const RouteChart& chart, Drawing::Format format)
      : chart_(chart),
        drawing_(format, kRouteWidth, kRouteHeight),
        frame_{52, 52, kRouteWidth - 18, kRouteHeight - 52},
        x_{0, chart.steps.back().to_m / 1000, frame_.xmin, frame_.xmax},
        y_{0, static_cast<double>(chart.turbines), frame_.ymax, frame_.ymin} {}

  std::string run() {
    drawing_.rectangle({0, 0, kRouteWidth, kRouteHeight}, kPaper);
    drawing_.text({frame_.xmin, 20}, chart_.title,
                  drawing_.lettering_for(chart_.title, frame_.width(), 1, {.size = 12, .colour = kInk, .bold = true}));
    drawing_.text({frame_.xmin, 34}, chart_.note, {.size = 8, .colour = kFaint});
    for (const RouteStep& step : chart_.steps) draw_step(step);
    draw_axes();
    draw_legend();
    return drawing_.finish();
  }

 private:
  Box bar(const RouteStep& step, double top) const {
    return {x_.at(step.from_m / 1000), y_.at(top), x_.at(step.to_m / 1000), frame_.ymax};
  }

  void draw_step(const RouteStep& step) {
    if (!step.known) return drawing_.rectangle(bar(step, y_.high), kUnknown);
    if (step.tips_undecided > 0)
      drawing_.rectangle(bar(step, static_cast<double>(step.tips + step.tips_undecided)), kUndecided);
    if (step.tips > 0) drawing_.rectangle(bar(step, static_cast<double>(step.tips)), kTips);
    if (step.hubs.value_or(0) > 0) drawing_.rectangle(bar(step, static_cast<double>(*step.hubs)), kHubs);
  }

  void draw_axes() {
    const Stroke ink{kInk, 0.8, {}};
    drawing_.polyline(std::array{Point2{frame_.xmin, frame_.ymin}, Point2{frame_.xmin, frame_.ymax},
                                 Point2{frame_.xmax, frame_.ymax}},
                      ink);
    for (const double km : x_.ticks(10)) {
      drawing_.polyline(std::array{Point2{x_.at(km), frame_.ymax}, Point2{x_.at(km), frame_.ymax + 4}}, ink);
      drawing_.text({x_.at(km), frame_.ymax + 14}, tick_label(km, x_.step(10)),
                    {.size = 8, .colour = kInk, .align = Align::kCentre});
    }
    for (const double count : y_.ticks(static_cast<int>(std::clamp<std::size_t>(chart_.turbines, 2, 6)))) {
      if (count != static_cast<double>(static_cast<int>(count))) continue;
      drawing_.text({frame_.xmin - 5, y_.at(count) + 3}, fmt::format("{}", static_cast<int>(count)),
                    {.size = 8, .colour = kInk, .align = Align::kRight});
    }
    drawing_.text({(frame_.xmin + frame_.xmax) / 2, frame_.ymax + 27}, "distance along the route, km",
                  {.size = 8, .colour = kInk, .align = Align::kCentre});
    drawing_.text({16, (frame_.ymin + frame_.ymax) / 2}, "turbines visible",
                  {.size = 8, .colour = kInk, .align = Align::kCentre, .rotation_deg = 90});
  }

  void draw_legend() {
    double x = frame_.xmin;
    const auto add = [&](const Colour& colour, const char* text) {
      drawing_.rectangle({x, kRouteHeight - 16, x + 14, kRouteHeight - 8}, colour);
      drawing_.text({x + 18, kRouteHeight - 8}, text, {.size = 8, .colour = kInk});
      x += 30 + drawing_.text_width(text, {.size = 8, .colour = kInk});
    };
    const auto any = [&](const auto& holds) { return std::any_of(chart_.steps.begin(), chart_.steps.end(), holds); };
    add(kTips, "blade tip visible");
    if (any([](const RouteStep& s) { return s.hubs.has_value(); })) add(kHubs, "hub visible");
    if (any([](const RouteStep& s) { return s.tips_undecided > 0; }))
      add(kUndecided, "undecided whether a tip is, across ground without data");
    if (any([](const RouteStep& s) { return !s.known; })) add(kUnknown, "no terrain data");
  }

  const RouteChart& chart_;
  Drawing drawing_;
  Box frame_;
  Axis x_, y_;
};

}  // namespace

std::string draw_route_chart(const RouteChart& chart, const std::string& path) {
  const auto format = Drawing::format_of(path);
  if (!format) throw InputError(fmt::format("{}: a route's chart ends in .svg, .pdf or .png", path));
  if (chart.steps.empty()) throw InputError("a route without a place on it");
  return RoutePage(chart, *format).run();
}

}  // namespace itin::profile
