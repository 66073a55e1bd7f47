#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/map_sheet.hpp>

#include "drawing/drawing.hpp"
#include "drawing/palette.hpp"
#include "sheet/map_frame.hpp"
#include "sheet/paper.hpp"
#include "sheet/side_panel.hpp"

namespace itin::profile {

namespace {

constexpr double kPixelsPerPoint = 200 / 72.0;

/// The metres of ground that a metre of the frame must hold.
double least_scale(const MapSheet& sheet) {
  const Box frame = paper_of(sheet.paper).frame;
  const double metre = 1000 * kPointsPerMillimetre;
  return std::max(sheet.area.width() / frame.width(), sheet.area.height() / frame.height()) * metre;
}

}  // namespace

double scale_of(const MapSheet& sheet) {
  const double least = least_scale(sheet);
  if (sheet.scale > 0) {
    if (sheet.scale < least * (1 - 1e-9))
      throw InputError(fmt::format("at `scale` 1:{:.0f} the study area does not fit on {}; give at least {:.0f}",
                                   sheet.scale, name_of(sheet.paper), std::ceil(least / 100) * 100),
                       "scale");
    return sheet.scale;
  }
  constexpr std::array<double, 11> kUsual{10, 12.5, 15, 20, 25, 30, 40, 50, 60, 75, 80};
  for (double decade = 1;; decade *= 10)
    for (const double usual : kUsual)
      if (usual * decade >= least) return usual * decade;
}

Box ground_in_frame(const MapSheet& sheet) {
  return ground_in(paper_of(sheet.paper).frame, sheet.area, scale_of(sheet));
}

void require_sheet_format(const std::string& path) {
  const auto format = Drawing::format_of(path);
  // Cairo numbers the pictures in an SVG over a whole process: equal sheets would not be equal files.
  if (!format || *format == Drawing::Format::kSvg)
    throw InputError(fmt::format("{}: a map sheet ends in .pdf or .png", path));
}

std::string draw_map_sheet(const MapSheet& sheet, const std::string& path) {
  require_sheet_format(path);
  const Paper paper = paper_of(sheet.paper);
  Drawing drawing(*Drawing::format_of(path), paper.width, paper.height, kPixelsPerPoint);
  drawing.rectangle({0, 0, paper.width, paper.height}, kPaper);
  MapFrame map(drawing, paper, ground_in_frame(sheet));
  map.draw(sheet);
  SidePanel(drawing, paper, sheet, scale_of(sheet), map.left_out()).draw();
  return drawing.finish();
}

}  // namespace itin::profile
