// The triangles of a lattice along one line. Posts are kept for a sheet about the line, and are read when a cell asks
// for them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>

#include "cross_section/cell_triangles.hpp"
#include "cross_section/lattice_sheet.hpp"
#include "store/codec/point_index.hpp"
#include "triangulate/apex/read_once.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

/// Finds half cells along a line. Serves one thread and one line.
class LatticeCells final : public CellTriangles {
 public:
  /// Takes the direction `heading` in which, about, edges will come one after another.
  LatticeCells(const ReadOnce& index, const Selection& selection, Point2 heading);

 private:
  struct Unread {
    Leaf leaf;
    GridBox box;  ///< the box of the leaf's cell
  };

  const LatticeSheet* sheet_of(const LatticeCell& cell) override;
  std::optional<LatticeCell> cell_about(const GridBox& box) override;
  bool lay(const LatticeCell& cell);

  const ReadOnce& index_;
  const Selection& selection_;
  Point2 heading_;

  LatticeSheet sheet_;
  std::vector<Unread> unread_;            ///< leaves of the sheet that are still to be read
  std::vector<Leaf> leaves_;              ///< kept to reuse its memory
  std::uint64_t sheets_ = 0, cells_ = 0;  ///< sheets laid, and cells found on them
};

}  // namespace itin
