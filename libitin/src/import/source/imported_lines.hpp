// Lines as they were imported, read back from what a store keeps of them (store/set_aside.hpp), and what it has to
// keep.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pyramid/theme_lines.hpp"
#include "store/set_aside.hpp"

namespace itin {

/// A line's piece as it was imported, of a theme, from 0.
struct ImportedPiece {
  std::uint32_t theme = 0;
  ImportedSegment segment;
  friend auto operator<=>(const ImportedPiece&, const ImportedPiece&) = default;
};

/// In any order. `stored`: all segments of the store's lines; `with_heights` gives the ends of one as the store has
/// them, its source and its feature.
std::vector<ImportedPiece> imported_pieces(const StoreRows& rows, std::size_t themes,
                                           const std::vector<Segment>& stored,
                                           const std::function<ImportedSegment(const Segment&)>& with_heights);

/// By theme, what tells these pieces (ascending, all distinct) from the segments `placed` of the lines, which are of
/// these `features`.
std::vector<SetAsideLines> set_aside_of(std::span<const ImportedPiece> pieces, const std::vector<Segment>& placed,
                                        const std::vector<SegmentFeature>& features, const ThemeLines& lines);

}  // namespace itin
