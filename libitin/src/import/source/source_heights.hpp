// Tells how the heights of a source are understood.
#pragma once

#include <optional>
#include <string>

#include <itin/height_axis.hpp>

#include "gdal/crs.hpp"
#include "gdal/linear_unit.hpp"

namespace itin {

struct SourceHeights {
  HeightAxis axis;
  std::string crs;      ///< the source's CRS, in which height_axis() finds this axis again: authority:code or WKT 2
  std::string warning;  ///< empty when there is nothing to say
};

/// Finds the unit of the heights. It is the one that --crs has, else the one `stated` by the file apart from its CRS,
/// else that of the vertical part of its CRS. Otherwise it is the unit of the CRS's own axes, for a survey in feet has
/// its heights in feet though few files say so, or else the metre. Heights grow upwards unless the CRS says otherwise.
SourceHeights source_heights(const std::string& path, const std::optional<LinearUnit>& stated, const Crs& crs);

}  // namespace itin
