// The losses of a radio path over a line, by the profile that its triangles make.
//
//   const LineLosses losses(surface, nullptr, {.frequency_ghz = 2.5});
//   LineLosses::Scratch scratch;  // for many lines
//   if (const auto loss = losses.of_line({eye, target}, scratch)) ...
//
// The profile has the places where the line crosses the surface's edges, as SectionLine finds them for cross-sections.
// Between these it has further places, as a report of the line has them: both come to one loss (itin/diffraction.hpp).
#pragma once

#include <optional>
#include <vector>

#include <itin/diffraction.hpp>
#include <itin/tin.hpp>

#include "modes/lines/surface_pieces.hpp"

namespace itin::viewshed {

/// Safe for concurrent use.
class LineLosses {
 public:
  /// `bare`: the ground under what stands on the surface; null where nothing does.
  LineLosses(std::shared_ptr<const SurfacePieces> surface, std::shared_ptr<const SurfacePieces> bare,
             const RadioPath& path);

  /// The ends of a line, grid units; they differ horizontally.
  struct Line {
    Point3 from, to;
  };
  struct Loss {
    double diffraction_db = 0;  ///< delta-Bullington
    double free_space_db = 0;
    PathEnds ends = {};
    double azimuth_deg = 0;  ///< from the first end to the second, from grid north
  };
  struct Outcome {
    std::optional<Loss> loss;   ///< over known ground; nothing where an end is within a raised feature
    bool over_missing = false;  ///< the line crosses ground without data
  };
  class Scratch;
  /// Computes the loss of a line. Cost: all triangles under the line, about 60 nanoseconds each.
  Outcome of_line(const Line& line, Scratch& scratch) const;

 private:
  std::shared_ptr<const SurfacePieces> surface_, bare_;
  RadioPath path_;
};

/// Memory to use again, for one thread.
class LineLosses::Scratch {
 private:
  friend class LineLosses;
  std::vector<SurfacePieces::Piece> pieces_;
  std::vector<PathPoint> tops_, ground_;
};

}  // namespace itin::viewshed
