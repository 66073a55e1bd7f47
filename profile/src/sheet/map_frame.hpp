// The map of a sheet: its layers to scale in their frame, with the grid's references about it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/label_places.hpp>
#include <profile/map_sheet.hpp>

#include "drawing/drawing.hpp"
#include "sheet/paper.hpp"

namespace itin::profile {

class MapFrame {
 public:
  /// `ground` fills the paper's frame.
  MapFrame(Drawing& drawing, const Paper& paper, const Box& ground);

  void draw(const MapSheet& sheet);
  double points_per_metre() const { return scale_; }
  /// A line of text about the marks within the frame whose names have no place; empty where all names have one.
  std::string left_out() const { return left_out_ > 0 ? left_out_text(left_out_, names_) : ""; }

 private:
  Point2 at(Point2 ground) const;
  std::vector<Point2> at(const std::vector<Point2>& ground) const;
  void draw_layer(const SheetCells& cells);
  void draw_layer(const SheetAreas& areas);
  void draw_layer(const SheetLines& lines);
  void draw_layer(const SheetMarks& marks);
  std::vector<Point2> label_places(const SheetLine& line) const;
  void label_line(const SheetLine& line, const Rgba& colour);
  void label_marks(const SheetMarks& marks);
  void draw_grid(const std::string& crs_wkt);

  Drawing& drawing_;
  const Paper& paper_;
  Box ground_;
  double scale_;  ///< points per metre
  LabelPlaces places_;
  std::size_t names_ = 0, left_out_ = 0;
};

}  // namespace itin::profile
