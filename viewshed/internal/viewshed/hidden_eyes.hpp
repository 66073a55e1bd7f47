// Finds observers and masts whose eyes are within what stands on the ground.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin::viewshed {

/// A feature that a place lies within.
struct Cover {
  std::string theme;
  double top = 0;  ///< the elevation of its top there
};

/// Returns what stands at a place; nothing where it is in the open.
std::optional<Cover> cover_at(const Store& store, Point2 place, const Detail& detail, const ThemeChoice& themes);

/// Places of eyes over one surface; z is their elevation.
struct Eyes {
  std::string what;  ///< the name of a single one: "observer"
  std::vector<Point3> places;
  Detail detail;
  ThemeChoice themes;
};

/// Warns of eyes that are within a feature of the surface and lower than its top: they see nothing but their own place.
void warn_of_hidden_eyes(const Store& store, const Eyes& eyes, std::vector<std::string>& warnings);

}  // namespace itin::viewshed
