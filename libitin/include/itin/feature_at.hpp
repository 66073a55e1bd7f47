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
  std::int64_t number = 0;  ///< the feature's number in its theme, from 0, in the order of import
  std::string name;         ///< as the source calls it: the name field's value, or "feature 12" by its number in the
                            ///< source
  std::string id;           ///< the id field's value, or the feature's number in the source; empty where the import
                            ///< kept none
};

/// Returns "Town Hall (id 42)", or the name alone where it already tells the id.
std::string title_of(const FeatureAt& feature);

/// Finds for each place the feature of a raised theme (its number from 1) whose footprint holds the place or is nearest
/// to it within a metre: footprints are moved a little when they are made to fit together. Where there are several, the
/// first one imported counts. Cost: reads all footprints of the theme, a block of 256 at a time, about a microsecond
/// each. Throws CorruptStore, Cancelled.
std::vector<std::optional<FeatureAt>> features_at(const Store& store, std::uint16_t theme,
                                                  const std::vector<Point2>& places,
                                                  const Progress& progress = NoProgress());

/// Returns the features of a raised theme that have these numbers, and nothing for a number that the theme does not
/// have. Cost: reads the blocks of 256 that hold these features. Throws CorruptStore.
std::vector<std::optional<FeatureAt>> features_numbered(const Store& store, std::uint16_t theme,
                                                        const std::vector<std::int64_t>& numbers);

}  // namespace itin
