// How the heights of a source are understood.
#pragma once

#include <optional>
#include <string>

#include <itin/height_axis.hpp>

#include "gdal/crs.hpp"
#include "gdal/linear_unit.hpp"

namespace itin {

struct SourceHeights {
  HeightAxis axis;
  std::string crs;      ///< the source's, in which height_axis() finds this axis again: authority:code or WKT 2
  std::string warning;  ///< empty when there is nothing to say
};

/// The unit is the one that --crs has, else the one `stated` by the file apart from its CRS, else the vertical part's
/// of its CRS, else that of the CRS's own axes, for a survey in feet has its heights in feet though few files say so,
/// else the metre. Heights grow upwards unless the CRS says otherwise.
SourceHeights source_heights(const std::string& path, const std::optional<LinearUnit>& stated, const Crs& crs);

}  // namespace itin
