#include "store/codec/block_header.hpp"

#include <algorithm>
#include <limits>

#include "geometry/post_lattice.hpp"
#include "store/codec/block_codec.hpp"
#include "store/codec/store_format.hpp"

namespace itin {

void find_layout(const Cell& cell, std::span<const GridPoint> points, BlockHeader& header) {
  const GridBox box = cell.box();
  GridBox extent;
  WidestLattice widest;
  for (const GridPoint& p : points) {
    widest.add(p.x, p.y);
    extent.extend(p.x, p.y);
  }
  CellLattice lattice;
  lattice.step_x = static_cast<std::uint64_t>(widest.lattice().step_x);
  lattice.step_y = static_cast<std::uint64_t>(widest.lattice().step_y);
  lattice.x0 = static_cast<std::uint32_t>(extent.xmin - box.xmin);
  lattice.y0 = static_cast<std::uint32_t>(extent.ymin - box.ymin);
  lattice.columns = static_cast<std::uint64_t>(std::int64_t{extent.xmax} - extent.xmin) / lattice.step_x + 1;
  lattice.rows = static_cast<std::uint64_t>(std::int64_t{extent.ymax} - extent.ymin) / lattice.step_y + 1;
  const bool full = points.size() == lattice.columns * lattice.rows;
  if (!full && lattice.step_x == 1 && lattice.step_y == 1) return;
  header.layout = full ? PointLayout::kFullLattice : PointLayout::kLattice;
  header.lattice = lattice;
}

void put_header(std::vector<std::uint8_t>& out, const BlockHeader& header) {
  const CellLattice& lattice = header.lattice;
  put_varint(out, header.count);
  put_varint(out, static_cast<std::uint64_t>(header.coarsest));
  out.push_back(static_cast<std::uint8_t>(header.layout));
  if (header.layout != PointLayout::kScattered) {
    for (const std::uint64_t v :
         {lattice.step_x, lattice.step_y, std::uint64_t{lattice.x0}, std::uint64_t{lattice.y0}, lattice.columns})
      put_varint(out, v);
    if (header.layout == PointLayout::kLattice) put_varint(out, lattice.rows);
  }
  put_varint(out, header.step_z);
  put_varint(out, zigzag(header.first_z));
}

namespace {

CellLattice read_lattice(ByteReader& in, const Cell& cell) {
  const std::uint64_t side = std::uint64_t{1} << cell.log2_side;
  CellLattice lattice;
  lattice.step_x = in.varint(1, side);
  lattice.step_y = in.varint(1, side);
  lattice.x0 = static_cast<std::uint32_t>(in.varint(0, side - 1));
  lattice.y0 = static_cast<std::uint32_t>(in.varint(0, side - 1));
  lattice.columns = in.varint(1, (side - 1 - lattice.x0) / lattice.step_x + 1);
  return lattice;
}

}  // namespace

BlockHeader read_header(ByteReader& in, const Cell& cell) {
  BlockHeader header;
  header.count = static_cast<std::size_t>(in.varint(1, kMaxBlockPoints));
  header.coarsest = static_cast<int>(in.varint(0, format::kMaxLevels - 1));
  header.layout = static_cast<PointLayout>(in.varint(0, static_cast<std::uint64_t>(PointLayout::kFullLattice)));
  CellLattice& lattice = header.lattice;
  if (header.layout != PointLayout::kScattered) {
    lattice = read_lattice(in, cell);
    const std::uint64_t most = ((std::uint64_t{1} << cell.log2_side) - 1 - lattice.y0) / lattice.step_y + 1;
    lattice.rows = header.layout == PointLayout::kLattice ? in.varint(1, most) : header.count / lattice.columns;
    const std::uint64_t places = lattice.columns * lattice.rows;
    if (lattice.rows > most ||
        (header.layout == PointLayout::kLattice ? header.count > places : header.count != places))
      throw DecodeError("a lattice does not fit its cell");
  }
  header.step_z = in.varint(1, std::uint64_t{1} << 32);
  const std::int64_t z = in.signed_varint();
  if (z < std::numeric_limits<std::int32_t>::min() || z > std::numeric_limits<std::int32_t>::max())
    throw DecodeError("a height is out of range");
  header.first_z = static_cast<std::int32_t>(z);
  return header;
}

void put_sources(std::vector<std::uint8_t>& out, std::span<const std::uint16_t> sources) {
  for (std::size_t i = 0; i < sources.size();) {
    std::size_t end = i;
    while (end < sources.size() && sources[end] == sources[i]) ++end;
    const bool more = end < sources.size();
    put_varint(out, std::uint64_t{sources[i]} << 1 | (more ? 1 : 0));
    if (more) put_varint(out, end - i - 1);
    i = end;
  }
}

PointSources read_sources(ByteReader& in, std::size_t count) {
  PointSources sources;
  while (sources.size() < count) {
    const std::uint64_t v = in.varint(0, 0x1ffff);
    const std::size_t left = count - sources.size();
    if ((v & 1) && left < 2) throw DecodeError("more sources than points");
    const std::size_t run = (v & 1) ? in.varint(0, left - 2) + 1 : left;
    sources.add(static_cast<std::uint16_t>(v >> 1), run);
  }
  return sources;
}

}  // namespace itin
