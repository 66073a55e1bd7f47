// What a map of a viewshed shows: every cell in a colour, and what the colours stand for.
//
//   const ResultMap map = result_map(result, {.seen = "Visible"});
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <viewshed/map_image.hpp>
#include <viewshed/viewshed.hpp>
#include <viewshed/visibility_index.hpp>

namespace itin::viewshed {

/// How much a class hides the relief below it, 0 to 255.
inline constexpr std::uint8_t kAlphaOverRelief = 165;

struct ResultMap {
  struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0, alpha = 0;
  };
  struct Key {
    Colour colour;
    std::string text;
  };
  std::vector<Colour> cells;  ///< clear where nothing is shown
  std::vector<Key> keys;      ///< of single colours, with their shares of the cells decided
  std::string scale_title;
  std::vector<Key> scale;  ///< empty where the mode has no more to tell
};

ResultMap result_map(const Result& result, const MapOptions& options);
/// Its shares in bands; keys tell the area of each, and its part of all observers' cells.
ResultMap result_map(const VisibilityIndex& index);

}  // namespace itin::viewshed
