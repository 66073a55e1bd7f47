// Which imported feature stands at a place.
//
//   const CrossSection section = cross_section(store, a, b, detail, themes);
//   for (const Breakpoint& p : section.breakpoints) {
//     if (p.theme != 0) features_at(store, p.theme, {{p.position.x, p.position.y}});
//   }
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

class Store;

struct FeatureAt {
  std::int64_t number = 0;  ///< from 0, of its theme in the order of import
  std::string name;         ///< as its source calls it: the name field's value, or "feature 12" by its number there
};

/// The feature of a standing theme (its number from 1) whose footprint holds each place, or is nearest to it within a
/// metre, for footprints are moved a little when they are made to fit together. Of several the first one imported.
/// Cost: reads all footprints of the theme, a block of 256 at a time, about a microsecond each. Throws CorruptStore.
std::vector<std::optional<FeatureAt>> features_at(const Store& store, std::uint16_t theme,
                                                  const std::vector<Point2>& places);

}  // namespace itin
