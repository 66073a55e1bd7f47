// Triangles of a lattice of posts, found by their places and not by a search.
//
//   if (const auto c = cells.beyond(a, b)) ...           // abc is a triangle of the global triangulation
//
// The classes that implement it say where the posts come from: lattice_cells.hpp for one line, section_tiles.hpp for
// many lines.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cross_section/lattice_sheet.hpp"
#include "cross_section/section_walk.hpp"
#include "geometry/predicates.hpp"

namespace itin {

/// Finds triangles that are halves of cells. It does not know all of them: the others have to be searched for.
class CellTriangles {
 public:
  virtual ~CellTriangles() = default;

  /// Returns the third vertex of the triangle to the left of ab, where the triangle is half a cell.
  std::optional<SectionVertex> beyond(Position a, Position b);
  /// Returns the triangles of all cells that meet a box, counterclockwise; none unless the box meets known cells alone.
  std::vector<std::array<SectionVertex, 3>> around(const GridBox& box);

 private:
  /// Returns a sheet on which the cell stands alone, valid until the next call; null where none is known.
  virtual const LatticeSheet* sheet_of(const LatticeCell& cell) = 0;
  /// Returns any cell of the lattice that the posts about a box lie on, if they seem to lie on one.
  virtual std::optional<LatticeCell> cell_about(const GridBox& box) = 0;
};

}  // namespace itin
