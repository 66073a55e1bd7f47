#include "sheet/map_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/grid_reference.hpp>

#include "drawing/palette.hpp"
#include "sheet/map_symbols.hpp"

namespace itin::profile {

namespace {

constexpr Colour kGridInk{0.25, 0.35, 0.55};
constexpr double kLongestLabel = 0.4;         ///< in widths of the frame: a longer label is cut
constexpr Colour kNoLayer{0.93, 0.93, 0.95};  ///< where the map has no layer

/// The distance of grid lines: the least one usual on maps that puts them at least 20 mm apart.
double grid_step(double points_per_metre) {
  for (const double step : {100.0, 500.0, 1000.0, 5000.0, 10000.0, 50000.0})
    if (step * points_per_metre >= 20 * kPointsPerMillimetre) return step;
  return 100000;
}

/// The length of the grid's marks along the frame, where no contour has its label.
double grid_tick(const Paper& paper) {
  return 2 * kPointsPerMillimetre * paper.type;
}

Colour opaque(Rgba c) {
  c.alpha = 255;
  return drawn(c);
}

}  // namespace

MapFrame::MapFrame(Drawing& drawing, const Paper& paper, const Box& ground)
    : drawing_(drawing), paper_(paper), ground_(ground), scale_(paper.frame.width() / ground.width()) {}

Point2 MapFrame::at(Point2 p) const {
  return {paper_.frame.xmin + (p.x - ground_.xmin) * scale_, paper_.frame.ymax - (p.y - ground_.ymin) * scale_};
}

std::vector<Point2> MapFrame::at(const std::vector<Point2>& ground) const {
  std::vector<Point2> points;
  points.reserve(ground.size());
  for (const Point2& p : ground) points.push_back(at(p));
  return points;
}

void MapFrame::draw(const MapSheet& sheet) {
  drawing_.clip(paper_.frame);
  drawing_.rectangle(paper_.frame, kNoLayer);
  for (const SheetLayer& layer : sheet.layers) std::visit([&](const auto& l) { draw_layer(l); }, layer);
  // Labels go above all layers: first the labels of marks, then those of lines, so that marks find a place.
  for (const SheetLayer& layer : sheet.layers)
    if (const auto* marks = std::get_if<SheetMarks>(&layer)) label_marks(*marks);
  for (const SheetLayer& layer : sheet.layers)
    if (const auto* lines = std::get_if<SheetLines>(&layer))
      for (const SheetLine& line : lines->lines) label_line(line, lines->colour);
  drawing_.unclip();
  draw_grid(sheet.crs_wkt);
  drawing_.outline(paper_.frame, {kInk, 0.8 * paper_.type, {}});
}

void MapFrame::draw_layer(const SheetCells& cells) {
  const Box box = cells.grid.bounds();
  const Point2 top = at({box.xmin, box.ymax}), bottom = at({box.xmax, box.ymin});
  drawing_.cells({top.x, top.y, bottom.x, bottom.y}, counts_of(cells.grid), cells.colours);
}

void MapFrame::draw_layer(const SheetAreas& areas) {
  std::vector<std::vector<Point2>> rings;
  for (const auto& area : areas.areas) {
    rings.clear();
    for (const std::vector<Point2>& ring : area) rings.push_back(at(ring));
    drawing_.area(rings, drawn(areas.colour));
  }
}

void MapFrame::draw_layer(const SheetLines& lines) {
  Stroke stroke{drawn(lines.colour), lines.width_mm * kPointsPerMillimetre * paper_.type, {}};
  if (lines.dashed) stroke.dashes = map_dashes(paper_.type);
  for (const SheetLine& line : lines.lines) drawing_.polyline(at(line.points), stroke);
}

void MapFrame::draw_layer(const SheetMarks& marks) {
  const double size = 3.4 * kPointsPerMillimetre * paper_.type;
  for (const SheetMark& mark : marks.marks) {
    const Point2 p = at(mark.at);
    draw_symbol(drawing_, marks.symbol, p, size, marks.colour);
    if (marks.symbol == SheetSymbol::kDot) continue;  // names may cover dots
    const double up = marks.symbol == SheetSymbol::kTurbine ? size : size / 2;
    places_.take({p.x - 0.4 * size, p.y - up, p.x + 0.4 * size, p.y - up + size});
  }
}

/// The points of a line in the drawing, the best place for its label first.
std::vector<Point2> MapFrame::label_places(const SheetLine& line) const {
  std::vector<Point2> places = at(line.points);
  if (!line.label_in_middle) {
    std::sort(places.begin(), places.end(), [](Point2 a, Point2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    return places;
  }
  const Point2 middle = places[places.size() / 2];
  std::stable_sort(places.begin(), places.end(),
                   [&](Point2 a, Point2 b) { return distance(a, middle) < distance(b, middle); });
  return places;
}

void MapFrame::label_line(const SheetLine& line, const Rgba& colour) {
  if (line.label.empty()) return;
  const Lettering lettering{.size = paper_.letters(6), .colour = opaque(colour), .align = Align::kCentre, .rim = 1.4};
  const double half = drawing_.text_width(line.label, lettering) / 2 + 1, up = lettering.size / 2,
               tick = grid_tick(paper_);
  const Box &frame = paper_.frame, within{frame.xmin + tick, frame.ymin + tick, frame.xmax - tick, frame.ymax - tick};
  for (const Point2& p : label_places(line)) {
    const Box box{p.x - half, p.y - up, p.x + half, p.y + up};
    if (!within.contains(Point2{box.xmin, box.ymin}) || !within.contains(Point2{box.xmax, box.ymax}) ||
        !places_.free(box))
      continue;
    drawing_.text({p.x, p.y + 0.35 * lettering.size}, line.label, lettering);
    places_.take(box);
    return;
  }
}

void MapFrame::label_marks(const SheetMarks& marks) {
  const double size = 3.4 * kPointsPerMillimetre * paper_.type,
               up = marks.symbol == SheetSymbol::kTurbine ? 0.4 * size : 0;
  const bool bold = marks.symbol == SheetSymbol::kViewpoint;
  const Lettering lettering{.size = paper_.letters(bold ? 7 : 5.5), .colour = kInk, .bold = bold, .rim = 1.4};
  for (const SheetMark& mark : marks.marks) {
    const Point2 p = at(mark.at);
    if (mark.label.empty() || !paper_.frame.contains(p)) continue;
    const std::string label = drawing_.fitted(mark.label, kLongestLabel * paper_.frame.width(), lettering);
    ++names_;
    const auto anchor = places_.take_beside(
        {{p.x, p.y - up}, 0.55 * size, drawing_.text_width(label, lettering), 0.75 * lettering.size}, paper_.frame);
    if (anchor) {
      drawing_.text(*anchor, label, lettering);
    } else {
      ++left_out_;
    }
  }
}

void MapFrame::draw_grid(const std::string& crs_wkt) {
  const double step = grid_step(scale_), tick = grid_tick(paper_), arm = 1.2 * kPointsPerMillimetre * paper_.type;
  const Box& frame = paper_.frame;
  const Stroke fine{kGridInk, 0.35 * paper_.type, {}};
  const Lettering outside{.size = paper_.letters(5.5), .colour = kInk, .align = Align::kCentre};
  const Lettering inside{.size = 4.5 * paper_.type, .colour = kGridInk, .rim = 0.8};
  const bool national = is_national_grid(crs_wkt);
  const auto label = [](double metres) { return fmt::format("{:.10g}", metres / 1000); };
  const auto first = [&](double from) { return std::ceil(from / step) * step; };
  for (double x = first(ground_.xmin); x <= ground_.xmax; x += step) {
    const double px = at({x, 0}).x;
    drawing_.polyline(std::array{Point2{px, frame.ymin}, Point2{px, frame.ymin + tick}}, fine);
    drawing_.polyline(std::array{Point2{px, frame.ymax}, Point2{px, frame.ymax - tick}}, fine);
    drawing_.text({px, frame.ymin - 3}, label(x), outside);
    drawing_.text({px, frame.ymax + 3 + 0.75 * outside.size}, label(x), outside);
  }
  for (double y = first(ground_.ymin); y <= ground_.ymax; y += step) {
    const double py = at({0, y}).y;
    drawing_.polyline(std::array{Point2{frame.xmin, py}, Point2{frame.xmin + tick, py}}, fine);
    drawing_.polyline(std::array{Point2{frame.xmax, py}, Point2{frame.xmax - tick, py}}, fine);
    Lettering turned = outside;
    turned.rotation_deg = 90;
    // At a corner the label would run into that of the easting.
    const double half = drawing_.text_width(label(y), outside) / 2;
    if (py - half >= frame.ymin && py + half <= frame.ymax) {
      drawing_.text({frame.xmin - 3, py}, label(y), turned);
      drawing_.text({frame.xmax + 3 + 0.75 * outside.size, py}, label(y), turned);
    }
    for (double x = first(ground_.xmin); x <= ground_.xmax; x += step) {
      const Point2 p = at({x, y});
      drawing_.polyline(std::array{Point2{p.x - arm, p.y}, Point2{p.x + arm, p.y}}, fine);
      drawing_.polyline(std::array{Point2{p.x, p.y - arm}, Point2{p.x, p.y + arm}}, fine);
      const auto reference = national ? national_grid_reference({x, y}, step >= 10000  ? 1
                                                                        : step >= 1000 ? 2
                                                                                       : 3)
                                      : std::nullopt;
      const Box box{p.x + 1, p.y - 1 - inside.size, p.x + 1 + (reference ? drawing_.text_width(*reference, inside) : 0),
                    p.y - 1};
      if (reference && box.xmax < frame.xmax - tick && box.ymin > frame.ymin + tick && places_.free(box))
        drawing_.text({p.x + 1, p.y - 1}, *reference, inside);
    }
  }
}

}  // namespace itin::profile
