// Sight lines against a full surface by Embree, decided exactly.
//
//   const ExactRays rays(tin, earth, {observer});
//   ExactRays::Scratch scratch;                                   // one per thread
//   const unsigned hidden = rays.hidden(lines, scratch);       // one bit per line, as SightLine has it
//
// Two scenes hold the surface between them. A ray whose ends are raised by more than single precision can err, and
// which hits a triangle that hides the line in double precision, is hidden (scene.hpp). One whose ends are lowered by
// as much, and which clears the surface raised against drift, is visible (upper_scene.hpp). The few lines that neither
// decides pass close to the surface: there, and only there, double precision asks every triangle.
#pragma once

#include <vector>

#include <itin/earth.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "bounds/triangle_bins.hpp"
#include "line/sight_lines.hpp"
#include "scene/rays/scene.hpp"
#include "scene/rays/upper_scene.hpp"

namespace itin::viewshed {

/// Returns the active lines that some triangle hides, decided in double precision where `upper` is not cleared.
/// `starts_under` and `ends_under`: lines whose end is not above that surface.
unsigned hidden_exactly(const Scene& surface, const UpperScene& upper, const SightLines& lines, unsigned starts_under,
                        unsigned ends_under);

class ExactRays {
 public:
  /// The Tin must outlive this; every line starts above one of the eyes, metres. Takes some 700 bytes per triangle.
  /// Throws std::bad_alloc.
  ExactRays(const Tin& surface, const Earth& earth, const std::vector<Point2>& eyes);

  struct Scratch {
    Occluder occluder;
  };
  /// Returns one bit per line: 1 if it is hidden. Lines start at one eye, and their ends differ horizontally. Safe for
  /// concurrent use.
  unsigned hidden(const SightLines& lines, Scratch& scratch) const;

 private:
  /// The raised surface at a place in grid units, or -infinity where there is none.
  double upper_at(double x, double y) const;

  Tin upper_tin_;
  RasterGrid location_;
  TriangleBins bins_;
  Scene surface_;
  UpperScene upper_;
};

}  // namespace itin::viewshed
