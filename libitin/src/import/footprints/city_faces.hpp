// The faces of a building of a city model, and those of them that are its top.
//
//   const BuildingTop top = top_of(faces, vertices);
//   if (!top.surfaces.empty()) raise(top.surfaces, top.base);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>

#include "store/segments/footprint.hpp"

namespace itin {

/// What a face is called. Names only decide where the geometry does not.
enum class FaceName { other, roof, ground, closure };

/// A face with numbers of vertices; the first ring is its outline, all others are holes. Rings may run either way.
struct CityFace {
  std::vector<std::vector<std::uint32_t>> rings;
  FaceName name = FaceName::other;
};

struct BuildingTop {
  std::vector<RoofSurface> surfaces;
  double base = 0;           ///< the least elevation of the grounds, or of all faces where there is no ground
  std::size_t closures = 0;  ///< the number of closures that were left out and could be seen from above
};

/// Returns the faces that are open to the sky, whatever they are called and wherever they face; faces of one plane that
/// share an edge are joined. Walls are not among them, nor closures, nor floors: faces over nothing, with others of the
/// building above them, that are called ground or face down. Precondition: all vertices have finite coordinates, and
/// outlines at least three. Throws OverlayError for a face that crosses itself too often.
BuildingTop top_of(const std::vector<CityFace>& faces, const std::vector<Point3>& vertices);

}  // namespace itin
