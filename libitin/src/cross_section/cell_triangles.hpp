// Triangles of a lattice of posts, told by where they are and not by a search.
//
//   if (const auto c = cells.beyond(a, b)) ...           // abc is a triangle of the global triangulation
//
// Where the posts come from is told by those who implement it: lattice_cells.hpp for one line, section_tiles.hpp for
// many lines.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cross_section/lattice_sheet.hpp"
#include "cross_section/section_walk.hpp"
#include "geometry/predicates.hpp"

namespace itin {

/// Does not know everything: what it says nothing of has to be searched for.
class CellTriangles {
 public:
  virtual ~CellTriangles() = default;

  /// The third vertex of the triangle to the left of ab, where it is half a cell.
  std::optional<SectionVertex> beyond(Position a, Position b);
  /// The triangles of all cells that meet a box, counterclockwise; none unless all that is there are cells.
  std::vector<std::array<SectionVertex, 3>> around(const GridBox& box);

 private:
  /// A sheet on which the cell stands alone, until the next call; null where none is known.
  virtual const LatticeSheet* sheet_of(const LatticeCell& cell) = 0;
  /// Any cell of the lattice that the posts about a box lie on, if they seem to lie on one.
  virtual std::optional<LatticeCell> cell_about(const GridBox& box) = 0;
};

}  // namespace itin
