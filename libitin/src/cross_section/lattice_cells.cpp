#include "cross_section/lattice_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "lattice/lattice_frame.hpp"

namespace itin {

namespace {

/// Posts in a row of a sheet.
constexpr std::int64_t kSide = 64;
/// How far behind the middle of a sheet its first cell lies, in halves of its side.
constexpr double kSheetAhead = 0.7;
/// Where sheets tell few cells each, no more of them are laid.
constexpr std::uint64_t kFreeSheets = 3, kCellsPerSheet = 8;
/// So much that is not of the lattice, and searching is better.
constexpr std::size_t kMostOdd = 64;
/// Points of a block that the spacing is guessed by: neighbours, as a rule. A wrong guess is found out.
constexpr std::size_t kSamples = 16;
constexpr std::int32_t kNoPost = std::numeric_limits<std::int32_t>::min();

std::int32_t narrow(std::int64_t v) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(v, -kGridHalfSide, kGridHalfSide - 1));
}

/// The box of a square of the lattice, with a margin.
GridBox square(std::int64_t x, std::int64_t y, std::int64_t side, std::int64_t margin) {
  return {narrow(x - margin), narrow(y - margin), narrow(x + side + margin), narrow(y + side + margin)};
}

/// Half the diagonal is 0.71 sides, of which 0.5 lie within the square; and points lie on the grid.
std::int64_t circle_margin(std::int64_t spacing) {
  return spacing / 4;
}

/// The first and last cell that meet the interval from `low` to `high`, by their lower borders.
std::pair<std::int64_t, std::int64_t> cells_meeting(std::int64_t low, std::int64_t high, std::int64_t origin,
                                                    std::int64_t spacing) {
  const auto floored = [&](std::int64_t v) {
    const std::int64_t rest = (v - origin) % spacing;
    return v - (rest < 0 ? rest + spacing : rest);
  };
  return {floored(low - 1), floored(high)};
}

}  // namespace

LatticeCells::LatticeCells(const ReadOnce& index, const Selection& selection, Point2 heading)
    : index_(index), selection_(selection), heading_(heading) {}

std::optional<GridPoint> LatticeCells::beyond(Position a, Position b) {
  const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
  const bool diagonal = dx == -dy;
  if (dx != 0 && dy != 0 && !diagonal) return std::nullopt;
  const std::int64_t spacing = std::max(std::abs(dx), std::abs(dy));
  // The cell lies to the left of a side, and about a diagonal.
  Corner cell{std::min(a.x, b.x), std::min(a.y, b.y)};
  if (dx == 0 && dy > 0) cell.x -= spacing;
  if (dy == 0 && dx < 0) cell.y -= spacing;
  if (spacing == 0 || !known(cell, spacing)) return std::nullopt;
  if (diagonal) return dx > 0 ? point(cell.x + spacing, cell.y + spacing) : point(cell.x, cell.y);
  const auto has_upper_left = [&](Position p) { return p.x == cell.x && p.y == cell.y + spacing; };
  if (has_upper_left(a) || has_upper_left(b)) return point(cell.x + spacing, cell.y);
  return point(cell.x, cell.y + spacing);
}

std::vector<std::array<GridPoint, 3>> LatticeCells::around(const GridBox& box) {
  leaves_.clear();
  selected_leaves(index_, selection_, box, leaves_);
  PostSpacing posts;
  for (const Leaf& leaf : leaves_) {
    const auto block = index_.block(leaf);
    for (const GridPoint& p : std::span(block->points).first(std::min(kSamples, block->points.size()))) posts.add(p);
  }
  if (!posts.found()) return {};
  const std::int64_t spacing = posts.spacing();
  const auto [west, east] = cells_meeting(box.xmin, box.xmax, posts.origin().x, spacing);
  const auto [south, north] = cells_meeting(box.ymin, box.ymax, posts.origin().y, spacing);
  std::vector<std::array<GridPoint, 3>> triangles;
  for (std::int64_t y = south; y <= north; y += spacing) {
    for (std::int64_t x = west; x <= east; x += spacing) {
      if (!known({x, y}, spacing)) return {};
      const GridPoint lower_right = point(x + spacing, y), upper_left = point(x, y + spacing);
      triangles.push_back({point(x, y), lower_right, upper_left});
      triangles.push_back({lower_right, point(x + spacing, y + spacing), upper_left});
    }
  }
  return triangles;
}

bool LatticeCells::known(const Corner& cell, std::int64_t spacing) {
  if (!on_sheet(cell, spacing) && !lay(cell, spacing)) return false;
  const GridBox about = square(cell.x, cell.y, spacing, circle_margin(spacing));
  for (std::size_t i = 0; i < unread_.size();) {
    if (!unread_[i].box.meets(about)) {
      ++i;
      continue;
    }
    load(unread_[i].leaf);
    unread_[i] = unread_.back();
    unread_.pop_back();
  }
  if (std::max(odd_.size(), segments_.size()) > kMostOdd) return false;
  if (std::any_of(odd_.begin(), odd_.end(), [&](Position p) { return about.contains(p.x, p.y); })) return false;
  const GridBox closed = square(cell.x, cell.y, spacing, 0);
  if (std::any_of(segments_.begin(), segments_.end(), [&](const GridBox& s) { return s.meets(closed); })) return false;
  const std::size_t lower = post(cell.x, cell.y), upper = lower + kSide;
  if (heights_[lower] == kNoPost || heights_[lower + 1] == kNoPost || heights_[upper] == kNoPost ||
      heights_[upper + 1] == kNoPost)
    return false;
  ++cells_;
  return true;
}

bool LatticeCells::on_sheet(const Corner& cell, std::int64_t spacing) const {
  const std::int64_t east = cell.x - first_.x, north = cell.y - first_.y, last = (kSide - 2) * spacing_;
  return spacing == spacing_ && east >= 0 && north >= 0 && east <= last && north <= last && east % spacing == 0 &&
         north % spacing == 0;
}

/// Lays a sheet that a cell is near the border of, with most of it ahead. False where that does not pay.
bool LatticeCells::lay(const Corner& cell, std::int64_t spacing) {
  if (spacing > kGridHalfSide / kSide || sheets_ >= kFreeSheets + cells_ / kCellsPerSheet) return false;
  ++sheets_;
  spacing_ = spacing;
  const auto behind = [&](double heading) {
    return spacing * std::lround((1 - kSheetAhead * heading) * static_cast<double>(kSide - 2) / 2);
  };
  first_ = {cell.x - behind(heading_.x), cell.y - behind(heading_.y)};
  box_ = square(first_.x, first_.y, (kSide - 1) * spacing, circle_margin(spacing));
  heights_.assign(kSide * kSide, kNoPost);
  odd_.clear(), segments_.clear(), unread_.clear(), leaves_.clear(), edges_.clear();
  selected_leaves(index_, selection_, box_, leaves_);
  for (const Leaf& leaf : leaves_) {
    const GridBox box = leaf.cell.box();
    if (leaf.level >= selection_.finest_in(box)) unread_.push_back({leaf, box});
  }
  index_.segments(box_, edges_);
  for (const Segment& s : edges_)
    if (selection_.selects(s)) segments_.push_back(extent_of(s));
  return true;
}

void LatticeCells::load(const Leaf& leaf) {
  const auto block = index_.block(leaf);
  // What lies to the west or south of the sheet wraps round to numbers that are far too large.
  const auto spacing = static_cast<std::uint32_t>(spacing_), west = static_cast<std::uint32_t>(first_.x),
             south = static_cast<std::uint32_t>(first_.y);
  for (std::size_t k = 0; k < block->points.size(); ++k) {
    const GridPoint& p = block->points[k];
    if (!box_.contains(p.x, p.y) || !selection_.selects(level_of(leaf, *block, k), p.x, p.y)) continue;
    const std::uint32_t east = static_cast<std::uint32_t>(p.x) - west, north = static_cast<std::uint32_t>(p.y) - south;
    const std::uint32_t column = east / spacing, row = north / spacing;
    const bool post = column < kSide && row < kSide && column * spacing == east && row * spacing == north;
    if (post && block->theme(k) == 0) {
      heights_[row * kSide + column] = p.z;
    } else {
      odd_.push_back({p.x, p.y});
    }
  }
}

std::size_t LatticeCells::post(std::int64_t x, std::int64_t y) const {
  return static_cast<std::size_t>((y - first_.y) / spacing_ * kSide + (x - first_.x) / spacing_);
}

/// Precondition: a cell of it is known.
GridPoint LatticeCells::point(std::int64_t x, std::int64_t y) const {
  return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), heights_[post(x, y)]};
}

}  // namespace itin
