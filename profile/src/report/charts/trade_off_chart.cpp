#include "report/charts/trade_off_chart.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "report/tables/tables.hpp"

namespace itin::profile {

namespace {

constexpr Colour kCurves[] = {
    {0.13, 0.13, 0.13, 1}, {0.05, 0.35, 0.70, 1}, {0.80, 0.35, 0.05, 1}, {0.15, 0.50, 0.20, 1}, {0.50, 0.20, 0.55, 1}};
constexpr Colour kPlanned{0.75, 0.05, 0.05, 1};

/// The ranges of both axes. Curves run off to any height; the interesting part lies about the equal heights.
std::pair<double, double> ranges(const LosReport& report) {
  const double x = report.query.from_height_m, y = report.query.to_height_m;
  double equal = 0;
  for (const NamedHeights& named : report.required) {
    if (named.heights.both_equal_m) equal = std::max(equal, *named.heights.both_equal_m);
  }
  return {std::max({1.25 * x, 2 * equal, 1.0}), std::max({1.25 * y, 2 * equal, 1.0})};
}

}  // namespace

bool has_trade_off(const LosReport& report) {
  return std::any_of(report.required.begin(), report.required.end(),
                     [](const NamedHeights& named) { return !named.curve.empty(); });
}

void draw_trade_off_chart(Drawing& drawing, const Box& area, const LosReport& report) {
  const auto [x_most, y_most] = ranges(report);
  ChartFrame frame = make_frame({area.xmin + 46, area.ymin + 16, area.xmax - 8, area.ymax - 62}, 0, x_most, 0, y_most);
  frame.x_ticks = 7, frame.y_ticks = 7;
  frame.x_title = std::string("Height at A, m above ") + base_name(report.query.from_on_surface);
  frame.y_title = std::string("Height at B, m above ") + base_name(report.query.to_on_surface);
  drawing.text({area.xmin, area.ymin + 8}, "Heights at A against B", {10, kReportInk, Align::kLeft, true, 0});
  for (const double tick : frame.y.ticks(frame.y_ticks)) {
    const Point2 line[] = {frame.at(0, tick), frame.at(x_most, tick)};
    drawing.polyline(line, {kReportFaint, 0.5, {}});
  }
  drawing.clip(frame.box);
  std::vector<LegendItem> items;
  for (std::size_t i = 0; i < report.required.size(); ++i) {
    const Stroke stroke{kCurves[i % std::size(kCurves)], 1.3, {}};
    std::vector<Point2> curve;
    for (const HeightPair& pair : report.required[i].curve) {
      if (pair.to_m) curve.push_back(frame.at(pair.from_m, *pair.to_m));
    }
    // From the curve's last point on, the second end needs no more than at that point.
    if (!curve.empty()) curve.push_back({frame.box.xmax, curve.back().y}), drawing.polyline(curve, stroke);
    items.push_back({report.required[i].name, stroke, false});
  }
  drawing.unclip();
  draw_frame(drawing, frame);
  const Point2 planned = frame.at(report.query.from_height_m, report.query.to_height_m);
  drawing.circle(planned, 3, kPlanned);
  drawing.text({planned.x + 5, planned.y - 4}, "planned", {8, kPlanned, Align::kLeft, false, 0});
  draw_legend(drawing, {frame.box.xmin, frame.box.ymax + 44}, frame.box.width(), items);
}

}  // namespace itin::profile
