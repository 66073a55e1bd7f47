// Lines as they were imported, read back from what a store keeps of them (store/set_aside.hpp), and the part that a
// store has to keep.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pyramid/theme_lines.hpp"
#include "store/set_aside.hpp"

namespace itin {

/// A piece of a line as it was imported. Themes are numbered from 0.
struct ImportedPiece {
  std::uint32_t theme = 0;
  ImportedSegment segment;
  friend auto operator<=>(const ImportedPiece&, const ImportedPiece&) = default;
};

/// Returns the pieces in any order. `stored` are all segments of the store's lines. `with_heights` gives a segment's
/// ends as the store has them, its source and its feature.
std::vector<ImportedPiece> imported_pieces(const StoreRows& rows, std::size_t themes,
                                           const std::vector<Segment>& stored,
                                           const std::function<ImportedSegment(const Segment&)>& with_heights);

/// Returns, by theme, the differences between these pieces (ascending, all distinct) and the segments `placed` of the
/// lines, which belong to these `features`.
std::vector<SetAsideLines> set_aside_of(std::span<const ImportedPiece> pieces, const std::vector<Segment>& placed,
                                        const std::vector<SegmentFeature>& features, const ThemeLines& lines);

}  // namespace itin
