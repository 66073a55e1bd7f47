// Whether a part's features rise no higher above the ground, and cut no deeper into it, than its cells say.
#pragma once

#include <vector>

#include <itin/store.hpp>

#include "store/store_file.hpp"
#include "triangulate/raised_index.hpp"
#include "verify/false_cell.hpp"

namespace itin {

/// The features of one part of a raised theme, among those of the whole theme. Safe for concurrent use.
class PartHeights {
 public:
  /// Takes the part's number, from 0. Refers to the store, which must outlive it.
  PartHeights(const Store& store, std::size_t part);

  /// Returns the tiles in which the part's features have vertices.
  std::vector<Cell> tiles() const;
  /// Compares the features that meet a tile with the ground under them. Throws Error where there are no surfaces.
  std::vector<FalseCell> higher_in(const Cell& tile) const;
  Damage higher(const FalseCell& cell) const;

 private:
  bool too_deep(const Extremes& differs, std::int32_t lowest) const;
  std::vector<Leaf> leaves_about(const GridBox& box) const;
  double vertices_in(const Cell& cell) const;
  std::vector<std::uint64_t> codes_in(const GridBox& box) const;
  std::vector<std::uint32_t> features_of(const RegionMesh& mesh, const GridBox& box) const;

  const Store& store_;
  const StoreFile& file_;
  const ThemeInfo& theme_;
  int tree_;
  Selection ground_, selection_;
  RaisedIndex raised_;
  bool founded_;                  ///< whether some foundations may bend the ground about them, and cut into it
  std::vector<int> other_trees_;  ///< trees of the theme's other parts
};

}  // namespace itin
