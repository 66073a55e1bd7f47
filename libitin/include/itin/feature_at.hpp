// Which imported feature stands at a place, and the surface without some features.
//
//   const CrossSection street =
//       cross_section(store, {321590, 4297655}, {321790, 4297655}, Detail::tolerance(0), ThemeChoice::all());
//   for (const Breakpoint& p : street.breakpoints) {
//     if (p.theme == 0) continue;
//     const std::optional<FeatureAt> house = features_at(store, p.theme, {{p.position.x, p.position.y}})[0];
//     if (house) std::cout << title_of(*house) << '\n';
//   }
//   const ThemeChoice without_it = without_features(store, ThemeChoice::all(), {{1, 42}}, progress);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/theme.hpp>

namespace itin {

class Store;

struct FeatureAt {
  std::int64_t number = 0;  ///< the feature's number in its theme, from 0, in the order of its sources
  std::string name;         ///< as the source calls it: the name field's value, or "feature 12" by its number in the
                            ///< source
  std::string id;           ///< the id field's value, or the feature's number in the source; empty where the import
                            ///< kept none
};

/// Returns "Town Hall (id 42)", or the name alone where it already tells the id.
std::string title_of(const FeatureAt& feature);

/// Finds for each place the feature of a raised theme (its number from 1) whose footprint holds the place or is nearest
/// to it within a metre: footprints are moved a little when they are made to fit together. Of several that hold it, as
/// a tower on a podium, it is the one whose top the surface has there. Cost: reads all footprints of the theme, a block
/// of 256 at a time, about a microsecond each, and triangulates the ground under those that overlap at a place. Throws
/// CorruptStore, Cancelled.
std::vector<std::optional<FeatureAt>> features_at(const Store& store, std::uint16_t theme,
                                                  const std::vector<Point2>& places,
                                                  const Progress& progress = NoProgress());

/// Returns the features of a raised theme that have these numbers, and nothing for a number that the theme does not
/// have. Cost: reads the blocks of 256 that hold these features. Throws CorruptStore.
std::vector<std::optional<FeatureAt>> features_numbered(const Store& store, std::uint16_t theme,
                                                        const std::vector<std::int64_t>& numbers);

/// Returns all features of a raised theme, by number. Throws CorruptStore.
std::vector<FeatureAt> features_of(const Store& store, std::uint16_t theme);

/// A feature of a raised theme, by its number.
struct FeatureNumber {
  std::uint16_t theme = 0;  ///< the theme's number, from 1
  std::int64_t number = 0;  ///< the feature's number in its theme, from 0
  friend auto operator<=>(const FeatureNumber&, const FeatureNumber&) = default;
};

/// Returns the features of these names, as reports and documents print them. A name is the theme's, and
///   - a colon and the feature's id or name: "woods:17", "houses:Town Hall";
///   - a comma and its title: "houses, Town Hall (id 42)";
///   - or # and its number: "woods#16".
/// Cost: reads all footprints of the themes. Throws InputError for a name of no feature or of several; CorruptStore.
std::vector<FeatureNumber> features_called(const Store& store, const std::vector<std::string>& names);

/// Returns the choice of themes without these features: a surface on which they do not stand, in every query. Nothing
/// changes beyond their outlines; within, the surface is the ground as the store has it, whatever else made way for
/// them. It ends at their outlines, where it is straight between their vertices; at tolerance 0 these lie on each edge
/// of the ground that an outline crosses, so that it is the ground to a step of the store's grid. A feature of a theme
/// that is not chosen changes nothing.
///
/// The choice is for this store alone. Cost: reads all footprints of their themes, and triangulates about them. Throws
/// InputError for a theme that is not raised or a number that it does not have, CorruptStore, FileError, Cancelled.
ThemeChoice without_features(const Store& store, const ThemeChoice& themes, std::vector<FeatureNumber> features,
                             Progress& progress);

}  // namespace itin
