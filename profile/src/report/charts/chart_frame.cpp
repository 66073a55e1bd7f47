#include "report/charts/chart_frame.hpp"

namespace itin::profile {

namespace {

constexpr double kTick = 4, kLabelSize = 8;

void draw_line(Drawing& drawing, Point2 a, Point2 b, const Stroke& stroke) {
  const Point2 ends[] = {a, b};
  drawing.polyline(ends, stroke);
}

}  // namespace

ChartFrame make_frame(const Box& box, double x_low, double x_high, double y_low, double y_high) {
  ChartFrame frame;
  frame.box = box;
  frame.x = {x_low, x_high, box.xmin, box.xmax};
  frame.y = {y_low, y_high, box.ymax, box.ymin};
  return frame;
}

void draw_frame(Drawing& drawing, const ChartFrame& frame, const std::function<std::string(double, double)>& x_label) {
  const Box& box = frame.box;
  const Point2 outline[] = {
      {box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}, {box.xmin, box.ymin}};
  drawing.polyline(outline, {kReportInk, 0.8, {}});
  for (const double value : frame.x.ticks(frame.x_ticks)) {
    const double x = frame.x.at(value);
    draw_line(drawing, {x, box.ymax}, {x, box.ymax + kTick}, {kReportInk, 0.8, {}});
    drawing.text({x, box.ymax + kTick + kLabelSize + 1}, x_label(value, frame.x.step(frame.x_ticks)),
                 {kLabelSize, kReportInk, Align::kCentre, false, 0});
  }
  double widest = 0;
  for (const double value : frame.y.ticks(frame.y_ticks)) {
    const double y = frame.y.at(value);
    const std::string label = tick_label(value, frame.y.step(frame.y_ticks));
    const Lettering lettering{kLabelSize, kReportInk, Align::kRight, false, 0};
    draw_line(drawing, {box.xmin - kTick, y}, {box.xmin, y}, {kReportInk, 0.8, {}});
    drawing.text({box.xmin - kTick - 2, y + kLabelSize * 0.36}, label, lettering);
    widest = std::max(widest, drawing.text_width(label, lettering));
  }
  drawing.text({(box.xmin + box.xmax) / 2, box.ymax + kTick + 2 * kLabelSize + 6}, frame.x_title,
               {kLabelSize + 0.5, kReportInk, Align::kCentre, false, 0});
  drawing.text({box.xmin - kTick - widest - 8, (box.ymin + box.ymax) / 2}, frame.y_title,
               {kLabelSize + 0.5, kReportInk, Align::kCentre, false, 90});
}

void draw_legend(Drawing& drawing, Point2 at, double width, const std::vector<LegendItem>& items) {
  constexpr double kSample = 22, kGap = 5, kBetween = 16, kRow = 13;
  const Lettering lettering{kLabelSize, kReportInk, Align::kLeft, false, 0};
  Point2 p = at;
  for (const LegendItem& item : items) {
    const std::string name = drawing.fitted(item.name, width - kSample - kGap, lettering);
    const double length = kSample + kGap + drawing.text_width(name, lettering);
    if (p.x > at.x && p.x + length > at.x + width) p = {at.x, p.y + kRow};
    if (item.area)
      drawing.rectangle({p.x, p.y - 6, p.x + kSample, p.y + 1}, item.stroke.colour);
    else
      draw_line(drawing, {p.x, p.y - 2.5}, {p.x + kSample, p.y - 2.5}, item.stroke);
    drawing.text({p.x + kSample + kGap, p.y}, name, lettering);
    p.x += length + kBetween;
  }
}

}  // namespace itin::profile
