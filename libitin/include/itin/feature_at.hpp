// Which imported feature stands at a place.
//
//   const CrossSection street =
//       cross_section(store, {321590, 4297655}, {321790, 4297655}, Detail::tolerance(0), ThemeChoice::all());
//   for (const Breakpoint& p : street.breakpoints) {
//     if (p.theme == 0) continue;
//     const std::optional<FeatureAt> house = features_at(store, p.theme, {{p.position.x, p.position.y}})[0];
//     if (house) std::cout << title_of(*house) << '\n';
//   }
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>

namespace itin {

class Store;

struct FeatureAt {
  std::int64_t number = 0;  ///< from 0, of its theme in the order of import
  std::string name;         ///< as its source calls it: the name field's value, or "feature 12" by its number there
  std::string id;           ///< the id field's value, or its number there; empty where the import kept none
};

/// "Town Hall (id 42)", or the name alone where that tells the id.
std::string title_of(const FeatureAt& feature);

/// The feature of a raised theme (its number from 1) whose footprint holds each place, or is nearest to it within a
/// metre, for footprints are moved a little when they are made to fit together. Where several do, the first one
/// imported counts. Cost: reads all footprints of the theme, a block of 256 at a time, about a microsecond each. Throws
/// CorruptStore, Cancelled.
std::vector<std::optional<FeatureAt>> features_at(const Store& store, std::uint16_t theme,
                                                  const std::vector<Point2>& places,
                                                  const Progress& progress = NoProgress());

/// The features of a raised theme of these numbers; nothing for one that it does not have. Cost: reads the blocks of
/// 256 that they are in. Throws CorruptStore.
std::vector<std::optional<FeatureAt>> features_numbered(const Store& store, std::uint16_t theme,
                                                        const std::vector<std::int64_t>& numbers);

}  // namespace itin
