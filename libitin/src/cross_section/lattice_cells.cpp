#include "cross_section/lattice_cells.hpp"

#include <cmath>

namespace itin {

namespace {

constexpr std::int64_t kCellsPerSide = 63;
/// How far behind the middle of a sheet its first cell lies, in halves of its side.
constexpr double kSheetAhead = 0.7;
/// The number of sheets laid in any case, and the cells that sheets must have found for each further one.
constexpr std::uint64_t kFreeSheets = 3, kCellsPerSheet = 8;

}  // namespace

LatticeCells::LatticeCells(const ReadOnce& index, const Selection& selection, Point2 heading)
    : index_(index), selection_(selection), heading_(heading) {}

const LatticeSheet* LatticeCells::sheet_of(const LatticeCell& cell) {
  if (!sheet_.has(cell) && !lay(cell)) return nullptr;
  const GridBox about = cell.box_of_circle();
  for (std::size_t i = 0; i < unread_.size();) {
    if (!unread_[i].box.meets(about)) {
      ++i;
      continue;
    }
    sheet_.add(unread_[i].leaf, *index_.unordered_block(unread_[i].leaf), selection_);
    unread_[i] = unread_.back();
    unread_.pop_back();
  }
  if (!sheet_.stands_alone(cell)) return nullptr;
  ++cells_;
  return &sheet_;
}

std::optional<LatticeCell> LatticeCells::cell_about(const GridBox& box) {
  return itin::cell_about(box, index_, selection_);
}

/// Lays a sheet that has the cell near its border, with most of the sheet ahead. Returns false where that does not pay.
bool LatticeCells::lay(const LatticeCell& cell) {
  if (cell.side > kGridHalfSide / (kCellsPerSide + 1) || sheets_ >= kFreeSheets + cells_ / kCellsPerSheet) return false;
  ++sheets_;
  const auto behind = [&](double heading) {
    return cell.side * std::lround((1 - kSheetAhead * heading) * static_cast<double>(kCellsPerSide - 1) / 2);
  };
  sheet_ = {{cell.x - behind(heading_.x), cell.y - behind(heading_.y), cell.side}, kCellsPerSide, kCellsPerSide};
  unread_.clear(), leaves_.clear();
  selected_leaves(index_, selection_, sheet_.box(), leaves_);
  for (const Leaf& leaf : leaves_) unread_.push_back({leaf, leaf.cell.box()});
  add_segments(sheet_, index_, selection_);
  return true;
}

}  // namespace itin
