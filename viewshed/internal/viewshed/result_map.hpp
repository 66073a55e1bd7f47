// What a map of a viewshed shows: every cell in a colour, and what the colours stand for.
//
//   const ResultMap map = result_map(result, {.seen = "Visible"});
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <viewshed/map_image.hpp>
#include <viewshed/result.hpp>
#include <viewshed/visibility_index.hpp>

namespace itin::viewshed {

/// Makes a class's colour translucent, so that the relief below it shows. A class without a colour stays transparent.
constexpr Rgba over_relief(const Rgba& colour) {
  return colour.alpha > 0 ? Rgba{colour.red, colour.green, colour.blue, 165} : kTransparent;
}

struct ResultMap {
  struct Key {
    std::vector<Rgba> colours;  ///< side by side
    std::string text;
  };
  std::vector<Rgba> cells;  ///< clear where nothing is shown
  std::vector<Key> keys;    ///< what is seen and what is not, with their shares of the cells decided
  std::string scale_title;
  std::vector<Key> scale;  ///< empty where the mode has no more to tell
};

ResultMap result_map(const Result& result, const MapOptions& options);
/// Shows the index's shares in bands; keys tell the area of each band, and its part of all observers' cells.
ResultMap result_map(const VisibilityIndex& index);

}  // namespace itin::viewshed
