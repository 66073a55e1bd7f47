#include "report/charts/location_figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <itin/counted.hpp>

#include "report/charts/chart_frame.hpp"
#include "sheet/map_frame.hpp"
#include "sheet/paper.hpp"

namespace itin::profile {

namespace {

constexpr double kTitle = 30, kBeside = 14, kReferences = 24, kLine = 10;  ///< points
const Lettering kCaption{7.5, kReportGrey, Align::kLeft, false, 0};

/// The rows of the legend in one line, without its headings.
std::string legend_text(const MapSheet& map) {
  std::string text;
  for (const SheetKey& key : map.legend)
    if (key.sample != SheetKey::Sample::kHeading) text += (text.empty() ? "" : "; ") + key.text;
  return text;
}

}  // namespace

void draw_location(Drawing& drawing, const Box& area, const MapSheet& map) {
  drawing.text({area.xmin, area.ymin + 10}, map.title.title, {10, kReportInk, Align::kLeft, true, 0});
  Paper paper = paper_of(map.paper);
  const std::vector<std::string> legend = drawing.lines(legend_text(map), area.width(), kCaption);
  // The frame has the shape of the sheet's, and shows no more ground: there are no more cells.
  const double below = kReferences + kLine * static_cast<double>(legend.size());
  const double part = std::min((area.width() - 2 * kBeside) / paper.frame.width(),
                               (area.height() - kTitle - below) / paper.frame.height());
  const Point2 corner{area.xmin + kBeside, area.ymin + kTitle};
  paper.frame = {corner.x, corner.y, corner.x + part * paper.frame.width(), corner.y + part * paper.frame.height()};
  const double scale = std::min(scale_within(paper.frame, map), scale_of(map) / part);
  MapFrame frame(drawing, paper, ground_in(paper.frame, map.area, scale));
  frame.draw(map);
  double y = paper.frame.ymax + kReferences;
  const auto add = [&](const std::string& line) { drawing.text({area.xmin, y}, line, kCaption), y += kLine; };
  add(fmt::format("1:{} at {}; grid north is up{}{}", grouped(static_cast<std::uint64_t>(std::nearbyint(scale))),
                  paper.name, frame.left_out().empty() ? "" : "; ", frame.left_out()));
  for (const std::string& line : legend) add(line);
}

}  // namespace itin::profile
