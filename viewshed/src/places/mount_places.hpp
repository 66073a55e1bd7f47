// Where antennas may be mounted on a building: before its walls and on its roof.
//
//   const MountPlaces places = mount_places({foot, surface, ground, {.spacing = 1, .reveal = 0.3}}, progress);
//
// A foot is cut into equally long stretches. One of them has a wall where the surface rises by more than kLeastWall
// from one side to the other, onto the building: so a party wall has none, but where one house is higher, and a wall
// above a lower roof has one. Roof places are a grid of points on the building.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <itin/building_outlines.hpp>
#include <itin/progress.hpp>
#include <itin/tin.hpp>
#include <viewshed/premises.hpp>

#include "bounds/height_pyramid.hpp"

namespace itin::viewshed {

/// The sides of a wall differ by more than this, metres.
inline constexpr double kLeastWall = 2.5;

/// A surface, and what finds the triangle under a place.
struct PlacedSurface {
  /// Throws Cancelled.
  PlacedSurface(Tin of, const Progress& progress)
      : tin(std::move(of)), pyramid(std::make_shared<const HeightPyramid>(tin, progress)) {}
  PlacedSurface(const PlacedSurface&) = delete;
  PlacedSurface& operator=(const PlacedSurface&) = delete;

  /// The elevation under a position, metres; nothing where there is no surface.
  std::optional<double> height(Point2 position) const;
  /// The theme of what stands there, from 1; 0 where nothing does.
  std::uint16_t theme(Point2 position) const;

  const Tin tin;
  const std::shared_ptr<const HeightPyramid> pyramid;  ///< finds the triangles of `tin`
};

struct MountPlaces {
  std::vector<WallPlace> walls;
  std::vector<RoofPlace> roof;
  std::vector<Point3> street;  ///< the places of the street before those walls that stand on open ground
};

struct MountRules {
  double spacing = 1, reveal = 0.3;
  std::optional<double> setback = {};   ///< how far before its wall a place of the street is; nothing: there is none
  double wall_offset = 0.05;            ///< how far within the foot walls reach their height
  std::vector<bool> of_buildings = {};  ///< by theme: whether it stands as buildings do
};

/// A building on a surface, which stands on the bare ground.
struct StandingBuilding {
  const BuildingFoot& foot;
  const PlacedSurface &surface, &ground;
  MountRules rules;
};

/// Finds the places of a building. Throws Cancelled.
MountPlaces mount_places(const StandingBuilding& building, const Progress& progress);
/// Finds those before its walls alone.
std::vector<WallPlace> wall_places(const StandingBuilding& building, const Progress& progress);

/// The heights at which an antenna is mounted before a wall: multiples of a storey where the wall is, up to its top. A
/// wall without any has one height, its top, to a centimetre.
std::vector<double> mount_heights(const WallPlace& wall, double storey);

}  // namespace itin::viewshed
