// The triangles of a lattice along one of many lines. The posts are on sheets that all of the lines share.
#pragma once

#include <memory>
#include <optional>

#include "cross_section/cell_triangles.hpp"
#include "cross_section/section_tiles.hpp"

namespace itin {

/// Finds half cells along a line. Serves one thread and one line.
class SharedCells final : public CellTriangles {
 public:
  /// Takes statistics that count what is read for this line.
  SharedCells(SectionTiles& tiles, RetrievalStatistics& statistics) : tiles_(tiles), statistics_(statistics) {}

  /// Tells whether a triangle at this place that is not half a cell is worth a triangulated tile. Counts its calls.
  bool is_worth_a_tile(Position place);

 private:
  const LatticeSheet* sheet_of(const LatticeCell& cell) override;
  std::optional<LatticeCell> cell_about(const GridBox& box) override;

  SectionTiles& tiles_;
  RetrievalStatistics& statistics_;
  std::shared_ptr<const SharedSheet> sheet_;
};

}  // namespace itin
