#include "chart/bar_chart.hpp"

#include <array>

#include "chart/bar_chart_layout.hpp"
#include "drawing/palette.hpp"

namespace itin::bars {

namespace {

using profile::Colour;
using profile::Drawing;

/// A few series have colours that are told apart with every kind of colour blindness (Okabe and Ito). More have an
/// order, which shades of blue show.
Colour colour_of(std::size_t series, std::size_t count) {
  constexpr std::array<Colour, 4> kColours{
      {{0.00, 0.62, 0.45, 1}, {0.00, 0.45, 0.70, 1}, {0.55, 0.55, 0.55, 1}, {0.84, 0.37, 0.00, 1}}};
  if (count <= kColours.size()) return kColours[series];
  const double share = static_cast<double>(series) / static_cast<double>(count - 1);
  return {0.08 + 0.62 * share, 0.25 + 0.55 * share, 0.45 + 0.45 * share, 1};
}

}  // namespace

std::string draw(const BarChart& chart, Drawing::Format format) {
  const BarChartLayout layout = lay_out(chart);
  const Box& frame = layout.frame;
  Drawing drawing(format, layout.width, layout.height);
  drawing.rectangle({0, 0, layout.width, layout.height}, profile::kPaper);
  for (const double tick : layout.ticks) {
    const double x = layout.axis.at(tick);
    drawing.polyline(std::array{Point2{x, frame.ymin}, Point2{x, frame.ymax}}, {profile::kGrid, 0.75, {}});
  }
  for (const auto* bars : {&layout.swatches, &layout.bars}) {
    for (const PlacedBar& bar : *bars) drawing.rectangle(bar.box, colour_of(bar.series, chart.series.size()));
  }
  drawing.polyline(std::array{Point2{frame.xmin, frame.ymin}, Point2{frame.xmin, frame.ymax}},
                   {profile::kInk, 0.75, {}});
  if (chart.line) {
    const double x = layout.axis.at(*chart.line);
    drawing.polyline(std::array{Point2{x, frame.ymin}, Point2{x, frame.ymax}}, {profile::kInk, 0.75, {3, 2}});
  }
  for (const Box& box : layout.clearings) drawing.rectangle(box, profile::kPaper);
  for (const PlacedText& text : layout.texts) drawing.text(text.anchor, text.text, text.lettering);
  return drawing.finish();
}

}  // namespace itin::bars
