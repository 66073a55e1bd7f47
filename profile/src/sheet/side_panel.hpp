// The panel beside a map: title, legend, scale bar and north, statement, facts, sources, title block.
#pragma once

#include <string>

#include <profile/map_sheet.hpp>

#include "drawing/drawing.hpp"
#include "sheet/paper.hpp"

namespace itin::profile {

class SidePanel {
 public:
  SidePanel(Drawing& drawing, const Paper& paper, const MapSheet& sheet, double scale, std::string below_legend);
  void draw();
  /// The height that its content took when it was drawn, points: what a panel has to have.
  double height() const;

 private:
  void draw_heading();
  void draw_legend(double bottom);
  void draw_key(const SheetKey& key);
  void draw_scale();
  void draw_north(Point2 foot);
  void heading(const std::string& text, std::size_t most_lines, double size, bool bold);
  void paragraph(const std::string& text, double size, bool bold);
  void draw_notes();
  void draw_foot();
  double notes_height();
  bool has_date() const { return !sheet_.title.date.empty() || !sheet_.title.figure.empty(); }
  double foot_height() const;
  void rule();

  Drawing& drawing_;
  const Paper& paper_;
  const MapSheet& sheet_;
  double scale_;              ///< 1 : scale
  std::string below_legend_;  ///< may be empty
  double left_, right_, y_;
  bool measuring_ = false;  ///< moves y_ without drawing
};

}  // namespace itin::profile
