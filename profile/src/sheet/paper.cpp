#include "sheet/paper.hpp"

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
  const double margin = (a1 ? 15 : 8) * kPointsPerMillimetre, panel = 82 * paper.type * kPointsPerMillimetre,
               references = 4 * paper.type * kPointsPerMillimetre;
  paper.panel = {paper.width - margin - panel, margin, paper.width - margin, paper.height - margin};
  paper.frame = {margin + references, margin + references, paper.panel.xmin - references - 2 * kPointsPerMillimetre,
                 paper.height - margin - references};
  return paper;
}

Box ground_in(const Box& frame, const Box& area, double scale) {
  const double metres = scale / (1000 * kPointsPerMillimetre);
  const Point2 middle{(area.xmin + area.xmax) / 2, (area.ymin + area.ymax) / 2};
  const double x = frame.width() * metres / 2, y = frame.height() * metres / 2;
  return {middle.x - x, middle.y - y, middle.x + x, middle.y + y};
}

}  // namespace itin::profile
