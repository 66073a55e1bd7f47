#include "modes/lines/line_losses.hpp"

#include <algorithm>
#include <cmath>

#include <itin/azimuth.hpp>
#include <itin/grid_units.hpp>
#include <itin/section_line.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

using Pieces = std::vector<SurfacePieces::Piece>;

/// Turns the pieces to be seen from the line's other end.
void mirror(double length_m, Pieces& pieces) {
  std::reverse(pieces.begin(), pieces.end());
  for (auto& [from, to] : pieces) {
    std::swap(from, to);
    from.distance_m = length_m - from.distance_m, to.distance_m = length_m - to.distance_m;
  }
}

/// Makes the profile of pieces of a surface, in order of distance; no two points are farther apart than `most_m` where
/// pieces are joined. Returns whether all pieces are joined.
bool chain(const Pieces& pieces, double most_m, std::vector<PathPoint>& points) {
  points.clear();
  bool whole = true;
  for (const SurfacePieces::Piece& piece : pieces) {
    const PathPoint &from = piece.from, &to = piece.to;
    // This is a triangle that comes again, or another beside an edge that the line runs along or a corner that it
    // passes over.
    if (!points.empty() && to.distance_m <= points.back().distance_m) continue;
    const bool joined = !points.empty() && points.back().distance_m == from.distance_m;
    whole = whole && (joined || from.distance_m == 0);
    if (!joined || points.back().height_m != from.height_m) points.push_back(from);
    for_each_place_between(from.distance_m, to.distance_m, most_m, [&](double t) {
      points.push_back(
          {from.distance_m + (to.distance_m - from.distance_m) * t, from.height_m + (to.height_m - from.height_m) * t});
    });
    if (to.distance_m > from.distance_m) points.push_back(to);
  }
  return whole;
}

bool reaches_from_end_to_end(const std::vector<PathPoint>& points, double length_m) {
  return !points.empty() && points.front().distance_m == 0 && points.back().distance_m == length_m;
}

}  // namespace

LineLosses::LineLosses(std::shared_ptr<const SurfacePieces> surface, std::shared_ptr<const SurfacePieces> bare,
                       const RadioPath& path)
    : surface_(std::move(surface)), bare_(std::move(bare)), path_(path) {}

LineLosses::Outcome LineLosses::of_line(const Line& line, Scratch& scratch) const {
  const Grid& grid = surface_->grid();
  const auto metres = [&](const Point3& end) { return place_in_metres(grid, {end.x, end.y}); };
  const Point2 from = metres(line.from), to = metres(line.to);
  const SectionLine section(grid, from, to);
  const double length = section.length();
  const auto profile = [&](const SurfacePieces& over, double most_m, std::vector<PathPoint>& points) {
    over.along(section, scratch.pieces_);
    if (section.is_mirrored()) mirror(length, scratch.pieces_);
    return chain(scratch.pieces_, most_m, points);
  };
  Outcome outcome;
  outcome.over_missing = !profile(*surface_, greatest_spacing_m(length), scratch.tops_);
  if (!reaches_from_end_to_end(scratch.tops_, length)) return outcome;
  const auto ends = above_tops({length, line.from.z * grid.resolution, line.to.z * grid.resolution},
                               scratch.tops_.front().height_m, scratch.tops_.back().height_m);
  if (!ends) return outcome;
  if (bare_) profile(*bare_, kInfinity, scratch.ground_);
  const std::vector<PathPoint>& ground = bare_ ? scratch.ground_ : scratch.tops_;
  outcome.loss = Loss{delta_bullington(scratch.tops_, ground, *ends, path_).ld_db,
                      free_space_db(std::hypot(length, ends->to_m - ends->from_m), wavelength_m(path_.frequency_ghz)),
                      *ends, grid_azimuth_deg(from, to)};
  return outcome;
}

}  // namespace itin::viewshed
