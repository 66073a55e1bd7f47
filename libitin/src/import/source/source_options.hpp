// Tells which options of an import mean something for which kinds of source.
#pragma once

#include <cstdint>
#include <span>

#include <itin/import.hpp>

namespace itin {

/// The kind of a source, so far as options depend on it.
enum class SourceKind : std::uint16_t {
  raster,
  las,
  text,           ///< delimited text of points
  points,         ///< a layer of points
  contours,       ///< a layer of lines that are ground by themselves
  terrain_lines,  ///< a layer of other lines with heights that are part of the ground
  ground_lines,   ///< a layer of lines and outlines that lie on the ground
  buildings,      ///< a layer of footprints that stand
  walls,          ///< a layer of walls or vegetation
  city_model,     ///< CityJSON
  canopy,         ///< a raster of heights above the ground, of what stands
  surface         ///< a raster of elevations, of the ground and what stands on it
};

/// Throws InputError, naming the option, where an option is given that none of the sources uses.
void require_useful_options(const ImportOptions& options, std::span<const SourceKind> sources);

/// The kind of source that lines of this kind of theme are, where they do not stand.
SourceKind kind_of_lines(ThemeKind kind);

}  // namespace itin
