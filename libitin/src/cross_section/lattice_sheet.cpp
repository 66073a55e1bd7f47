#include "cross_section/lattice_sheet.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include <itin/precondition.hpp>

#include "geometry/whole_division.hpp"
#include "store/prevailing_lattice.hpp"

namespace itin {

namespace {

constexpr std::int32_t kNoPost = std::numeric_limits<std::int32_t>::min();

std::int32_t narrow(std::int64_t v) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(v, -kGridHalfSide, kGridHalfSide - 1));
}

/// Returns how far a cell's circle reaches beyond the cell: half the diagonal is 0.71 sides, of which 0.5 lie within
/// the square. Points lie on the grid, so that this is rounded down.
std::int64_t circle_margin(std::int64_t side) {
  return side / 4;
}

GridBox box_about(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height, std::int64_t margin) {
  return {narrow(x - margin), narrow(y - margin), narrow(x + width + margin), narrow(y + height + margin)};
}

}  // namespace

GridBox LatticeCell::box_of_circle() const {
  return box_about(x, y, side, side, circle_margin(side));
}

LatticeSheet::LatticeSheet(const LatticeCell& first, std::int64_t columns, std::int64_t rows)
    : first_(first),
      columns_(columns),
      rows_(rows),
      box_(box_about(first.x, first.y, columns * first.side, rows * first.side, circle_margin(first.side))),
      heights_(static_cast<std::size_t>((columns + 1) * (rows + 1)), kNoPost),
      disturbed_(heights_.size()) {
  ITIN_PRECONDITION(std::max(columns, rows) * first.side < std::int64_t{1} << 31);
}

bool LatticeSheet::has(const LatticeCell& cell) const {
  if (cell.side != first_.side) return false;
  const std::int64_t east = cell.x - first_.x, north = cell.y - first_.y;
  return east >= 0 && north >= 0 && east < columns_ * cell.side && north < rows_ * cell.side && east % cell.side == 0 &&
         north % cell.side == 0;
}

void LatticeSheet::add(const Leaf& leaf, const Block& block, const Selection& selection) {
  // Points to the west or south of the sheet wrap round to numbers that are far too large.
  const auto side = static_cast<std::uint32_t>(first_.side), west = static_cast<std::uint32_t>(first_.x),
             south = static_cast<std::uint32_t>(first_.y), last_column = static_cast<std::uint32_t>(columns_),
             last_row = static_cast<std::uint32_t>(rows_);
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    const GridPoint& p = block.points[k];
    if (!box_.contains(p.x, p.y) || !selection.selects(leaf, level_of(leaf, block, k), p.x, p.y)) continue;
    const std::uint32_t east = static_cast<std::uint32_t>(p.x) - west, north = static_cast<std::uint32_t>(p.y) - south;
    const std::uint32_t column = east / side, row = north / side;
    const bool is_post = column <= last_column && row <= last_row && column * side == east && row * side == north;
    if (is_post && block.theme(k) == 0) {
      heights_[std::size_t{row} * (last_column + 1) + column] = p.z;
      ++posts_;
    } else {
      disturb(box_about(p.x, p.y, 0, 0, circle_margin(first_.side)));
    }
  }
}

void LatticeSheet::add(const Segment& segment) {
  disturb(extent_of(segment));
}

/// Marks all cells that the box touches as disturbed.
void LatticeSheet::disturb(const GridBox& box) {
  if (!box_.meets(box)) return;
  const auto first_touched = [&](std::int64_t distance) {
    return std::max<std::int64_t>(floor_divide(distance - 1, first_.side), 0);
  };
  const auto last_touched = [&](std::int64_t distance, std::int64_t cells) {
    return std::min(floor_divide(distance, first_.side), cells - 1);
  };
  const std::int64_t west = first_touched(box.xmin - first_.x), east = last_touched(box.xmax - first_.x, columns_),
                     south = first_touched(box.ymin - first_.y), north = last_touched(box.ymax - first_.y, rows_);
  for (std::int64_t row = south; row <= north; ++row)
    for (std::int64_t column = west; column <= east; ++column)
      disturbed_[static_cast<std::size_t>(row * (columns_ + 1) + column)] = true;
}

bool LatticeSheet::stands_alone(const LatticeCell& cell) const {
  ITIN_PRECONDITION(has(cell));
  const std::size_t lower = place(cell.x, cell.y), upper = lower + static_cast<std::size_t>(columns_ + 1);
  return !disturbed_[lower] && heights_[lower] != kNoPost && heights_[lower + 1] != kNoPost &&
         heights_[upper] != kNoPost && heights_[upper + 1] != kNoPost;
}

std::size_t LatticeSheet::place(std::int64_t x, std::int64_t y) const {
  return static_cast<std::size_t>((y - first_.y) / first_.side * (columns_ + 1) + (x - first_.x) / first_.side);
}

GridPoint LatticeSheet::post(std::int64_t x, std::int64_t y) const {
  return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), heights_[place(x, y)]};
}

void add_segments(LatticeSheet& sheet, const PointIndex& index, const Selection& selection) {
  std::vector<Segment> segments;
  index.segments(sheet.box(), segments);
  for (const Segment& s : segments)
    if (selection.selects(s)) sheet.add(s);
}

std::optional<LatticeCell> cell_about(const GridBox& box, const PointIndex& index, const Selection& selection) {
  std::vector<Leaf> leaves;
  selected_leaves(index, selection, box, leaves);
  const std::optional<PostLattice> lattice = prevailing_lattice(index, leaves, index.bounds());
  return lattice ? std::optional(LatticeCell{lattice->x, lattice->y, lattice->side()}) : std::nullopt;
}

}  // namespace itin
