// The triangles of a lattice along one of many lines, whose posts are on sheets that all of the lines share.
#pragma once

#include <memory>
#include <optional>

#include "cross_section/cell_triangles.hpp"
#include "cross_section/section_tiles.hpp"

namespace itin {

/// Serves one thread and one line.
class SharedCells final : public CellTriangles {
 public:
  /// Statistics count what is read for this line.
  SharedCells(SectionTiles& tiles, RetrievalStatistics& statistics) : tiles_(tiles), statistics_(statistics) {}

  /// Whether a triangle there that is not half a cell is worth a triangulated tile. Counts how often that was asked.
  bool is_worth_a_tile(Position place);

 private:
  const LatticeSheet* sheet_of(const LatticeCell& cell) override;
  std::optional<LatticeCell> cell_about(const GridBox& box) override;

  SectionTiles& tiles_;
  RetrievalStatistics& statistics_;
  std::shared_ptr<const SharedSheet> sheet_;
};

}  // namespace itin
