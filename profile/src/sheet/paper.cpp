#include "sheet/paper.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin::profile {

const char* name_of(PaperSize paper) {
  return paper == PaperSize::kA1 ? "A1" : paper == PaperSize::kA3 ? "A3" : "A4";
}

Paper paper_of(PaperSize size) {
  const bool a1 = size == PaperSize::kA1, a4 = size == PaperSize::kA4;
  Paper paper{};
  paper.width = (a1 ? 841 : a4 ? 297 : 420) * kPointsPerMillimetre;
  paper.height = (a1 ? 594 : a4 ? 210 : 297) * kPointsPerMillimetre;
  paper.type = a1 ? 1.6 : a4 ? 0.8 : 1;
  paper.name = name_of(size);
  const double margin = (a1 ? 15 : 8) * kPointsPerMillimetre, panel = 82 * paper.type * kPointsPerMillimetre,
               references = 4 * paper.type * kPointsPerMillimetre;
  paper.panel = {paper.width - margin - panel, margin, paper.width - margin, paper.height - margin};
  paper.frame = {margin + references, margin + references, paper.panel.xmin - references - 2 * kPointsPerMillimetre,
                 paper.height - margin - references};
  return paper;
}

Paper picture_of(const Box& area, int pixels, double pixels_per_point) {
  // Everything begins at whole pixels, so that the map's pixels are the picture's.
  const auto whole = [&](double points) { return std::round(points * pixels_per_point) / pixels_per_point; };
  const double longer = std::max(area.width(), area.height());
  const double points_per_metre = pixels / pixels_per_point / longer;
  Paper picture{};
  picture.type = 1;
  const double margin = whole(4 * kPointsPerMillimetre), references = whole(5 * kPointsPerMillimetre);
  const Point2 corner{margin + references, margin + references};
  picture.frame = {corner.x, corner.y, corner.x + whole(area.width() * points_per_metre),
                   corner.y + whole(area.height() * points_per_metre)};
  const double panel = picture.frame.xmax + references + margin / 2;
  picture.panel = {panel, margin, panel + 82 * kPointsPerMillimetre, picture.frame.ymax + references};
  picture.width = picture.panel.xmax + margin, picture.height = picture.panel.ymax + margin;
  return picture;
}

Paper with_panel(Paper picture, double height) {
  const double margin = picture.height - picture.panel.ymax;
  picture.panel.ymax = std::max(picture.panel.ymax, picture.panel.ymin + height);
  picture.height = picture.panel.ymax + margin;
  return picture;
}

namespace {

/// The scale at which the area fills the frame.
double filling_scale(const Box& frame, const Box& area) {
  const double metre = 1000 * kPointsPerMillimetre;
  return std::max(area.width() / frame.width(), area.height() / frame.height()) * metre;
}

}  // namespace

double usual_scale_within(const Box& frame, const Box& area) {
  const double least = filling_scale(frame, area);
  constexpr std::array<double, 11> kUsual{10, 12.5, 15, 20, 25, 30, 40, 50, 60, 75, 80};
  for (double decade = 1;; decade *= 10)
    for (const double usual : kUsual)
      if (usual * decade >= least) return usual * decade;
}

double scale_within(const Box& frame, const MapSheet& sheet) {
  if (sheet.scale > 0) {
    const double least = filling_scale(frame, sheet.area);
    if (sheet.scale < least * (1 - 1e-9))
      throw InputError(fmt::format("at `scale` 1:{:.0f} the study area does not fit on {}; give at least {:.0f}",
                                   sheet.scale, name_of(sheet.paper), std::ceil(least / 100) * 100),
                       "scale");
    return sheet.scale;
  }
  return usual_scale_within(frame, sheet.area);
}

Box ground_in(const Box& frame, const Box& area, double scale) {
  const double metres = scale / (1000 * kPointsPerMillimetre);
  const Point2 middle{(area.xmin + area.xmax) / 2, (area.ymin + area.ymax) / 2};
  const double x = frame.width() * metres / 2, y = frame.height() * metres / 2;
  return {middle.x - x, middle.y - y, middle.x + x, middle.y + y};
}

}  // namespace itin::profile
