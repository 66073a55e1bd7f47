// The beginning of a block of points: what is known of all of them. See libitin/FORMAT.md, "Point block".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/cell.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/codec/point_sources.hpp"

namespace itin {

/// The lattice that all of a block's positions lie on: x = x0 + i * step_x with i < columns.
struct CellLattice {
  std::uint64_t step_x = 1, step_y = 1;
  std::uint32_t x0 = 0, y0 = 0;  ///< from the cell's corner
  std::uint64_t columns = 1, rows = 1;
};

/// How points lie, which decides how they are coded.
enum class PointLayout : std::uint8_t {
  kScattered,    ///< anywhere; coded along the Morton curve
  kLattice,      ///< on a lattice that has other places, too; coded row by row
  kFullLattice,  ///< on all places of a lattice; coded row by row
};

struct BlockHeader {
  std::size_t count = 0;
  int coarsest = 0;  ///< the coarsest level of a point; 0: the levels are not written
  PointLayout layout = PointLayout::kScattered;
  CellLattice lattice;  ///< steps of 1 from the cell's corner where points are scattered
  std::uint64_t step_z = 1;
  std::int32_t first_z = 0;  ///< height of the first point in order of coding
};

/// Finds how points lie, which must lie in the cell: fills in `layout` and `lattice`.
void find_layout(const Cell& cell, std::span<const GridPoint> points, BlockHeader& header);

void put_header(std::vector<std::uint8_t>& out, const BlockHeader& header);
/// Reads a header. Throws DecodeError unless it is one of a block of this cell.
BlockHeader read_header(ByteReader& in, const Cell& cell);

/// Writes the sources of a block's points, in curve order.
void put_sources(std::vector<std::uint8_t>& out, std::span<const std::uint16_t> sources);
PointSources read_sources(ByteReader& in, std::size_t count);

}  // namespace itin
