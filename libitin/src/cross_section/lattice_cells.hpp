// The triangles of a lattice along one line, whose posts are kept for a sheet about the line and are read where a cell
// asks for them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>

#include "cross_section/cell_triangles.hpp"
#include "cross_section/lattice_sheet.hpp"
#include "store/point_index.hpp"
#include "triangulate/read_once.hpp"
#include "triangulate/selection.hpp"

namespace itin {

/// Serves one thread and one line.
class LatticeCells final : public CellTriangles {
 public:
  /// Edges will come one after another in about the direction `heading`.
  LatticeCells(const ReadOnce& index, const Selection& selection, Point2 heading);

 private:
  struct Unread {
    Leaf leaf;
    GridBox box;  ///< its cell's
  };

  const LatticeSheet* sheet_of(const LatticeCell& cell) override;
  std::optional<LatticeCell> cell_about(const GridBox& box) override;
  bool lay(const LatticeCell& cell);

  const ReadOnce& index_;
  const Selection& selection_;
  Point2 heading_;

  LatticeSheet sheet_;
  std::vector<Unread> unread_;            ///< leaves of the sheet
  std::vector<Leaf> leaves_;              ///< for their memory
  std::uint64_t sheets_ = 0, cells_ = 0;  ///< laid, and known by them
};

}  // namespace itin
