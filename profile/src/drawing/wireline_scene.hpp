// The terrain and turbines of a wireline in a frame, under any projection.
//
//   WirelineScene scene(view, frame, [&](double across, double elevation) { return Point2{...}; }, {0, 90});
//   scene.draw(drawing);
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <profile/wireline.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

/// Gives the place at which a direction is drawn. The direction is in degrees, clockwise from the view's left edge, and
/// of elevation.
using WirelineProjection = std::function<Point2(double across_deg, double elevation_deg)>;

struct PlacedTurbine {
  const WirelineTurbine* turbine;
  double distance;   ///< metres
  double across;     ///< degrees clockwise from the left edge
  double base, top;  ///< elevation angles, degrees
};

/// The turbines within the field of view and its reach, from the farthest.
std::vector<PlacedTurbine> placed_turbines(const WirelineQuery& query);

/// Writes the farms' names in their colours, in the order of their first turbines, on one line that ends at
/// `right_end`, where there are several farms that colours tell apart.
void draw_farm_names(Drawing& drawing, const WirelineQuery& query, Point2 right_end, double size, double gap);

class WirelineScene {
 public:
  /// The part that is drawn lies between these two degrees from the left edge. Labels have this size, in points.
  struct Part {
    double from_deg = 0, to_deg = 360;
    double label_size = 6;
    double weight = 1;  ///< factor for the width of all lines
  };
  WirelineScene(const Wireline& view, const Box& frame, WirelineProjection projection, const Part& part);

  void draw(Drawing& drawing) const;

 private:
  void draw_band(Drawing& drawing, const WirelineBand& band) const;
  void draw_mesh(Drawing& drawing, std::size_t farther) const;
  void draw_joints(Drawing& drawing, std::size_t nearer) const;
  void draw_stretch(Drawing& drawing, const WirelineBand& band, std::size_t first, std::size_t last) const;
  void draw_turbine(Drawing& drawing, const PlacedTurbine& placed, bool dashed) const;
  void draw_labels(Drawing& drawing) const;
  /// The place where a line of sight meets the band's greatest angle.
  Point2 place(std::size_t line, const WirelineBand& band) const;
  /// The first line of sight of the part, and the one after its last.
  std::pair<std::size_t, std::size_t> lines_within() const;
  Stroke stroke_of(const WirelineBand& band) const;
  Stroke mesh_stroke(const WirelineBand& band) const;
  bool within(double across) const { return across >= part_.from_deg && across <= part_.to_deg; }

  const Wireline& view_;
  Box frame_;
  WirelineProjection at_;
  Part part_;
  std::vector<PlacedTurbine> turbines_;
};

}  // namespace itin::profile
