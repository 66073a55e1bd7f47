// The classes of verdicts in rasters and polygons, in the colours of maps.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/result.hpp>

#include "drawing/map_overlay.hpp"
#include "line/verdicts.hpp"

namespace itin::viewshed {

/// The classes of cells in view that the result's mode may have.
inline std::vector<RasterClass> verdict_classes(const Result& result) {
  constexpr Rgba kHiddenColour{225, 225, 225};
  std::vector<RasterClass> classes;
  const auto add = [&](Verdict verdict, std::string name, Rgba colour) {
    classes.push_back({code_of(verdict), std::move(name), colour});
  };
  const bool zones = result.request.mode == Mode::kFresnel;
  const std::string certainly = result.certified ? "certainly " : "";
  add(Verdict::kVisible, zones ? "in sight, zone clear" : certainly + "visible", kSeenColour);
  if (zones) add(Verdict::kZoneCut, "in sight, zone cut", kZoneCutColour);
  add(Verdict::kHidden, certainly + "hidden", kHiddenColour);
  add(Verdict::kUndecided, "undecided", kUndecidedColour);
  return classes;
}

}  // namespace itin::viewshed
