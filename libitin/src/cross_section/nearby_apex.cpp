#include "cross_section/nearby_apex.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "triangulate/apex/apex_frame.hpp"

namespace itin {

namespace {

/// The neighbourhood's half side, in lengths of the edge that it is made for: a compromise between making many and
/// filling large ones.
constexpr double kReach = 14;
/// The least part of its size to which the neighbourhood shrinks at once, as for a short edge among long ones.
constexpr double kShrink = 0.5;
/// How far ahead of the edge the neighbourhood's centre lies, in half sides.
constexpr double kAhead = 0.7;
/// The largest circles searched here, in half lengths of the edge; ApexSearch takes larger ones.
constexpr double kMostGrowth = 64;

}  // namespace

NearbyApex::NearbyApex(const ReadOnce& index, const Selection& selection, Point2 heading)
    : index_(index), selection_(selection), heading_(heading), fallback_(index, selection) {}

void NearbyApex::move_to(Position a, Position b, double lambda) {
  const double mx = (static_cast<double>(a.x) + b.x) / 2, my = (static_cast<double>(a.y) + b.y) / 2;
  const double length = std::max(1.0, std::hypot(static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y));
  half_side_ = std::max({kReach * length, 6 * lambda, kShrink * half_side_});
  const double ahead = std::clamp(half_side_ - 4 * lambda, 0.0, kAhead * half_side_);
  const double x = mx + heading_.x * ahead, y = my + heading_.y * ahead;
  box_ = rounded_outwards({x - half_side_, y - half_side_, x + half_side_, y + half_side_});
  leaves_.clear();
  selected_leaves(index_, selection_, box_, leaves_);
  segments_.clear();
  index_.segments(box_, segments_);
  std::erase_if(segments_, [&](const Segment& s) { return !selection_.selects(s); });

  bin_shift_ = std::bit_width(static_cast<std::uint32_t>(std::max(length / 2, half_side_ / 64)));
  columns_ = (static_cast<std::uint32_t>(box_.xmax - box_.xmin) >> bin_shift_) + 1;
  const std::uint32_t rows = (static_cast<std::uint32_t>(box_.ymax - box_.ymin) >> bin_shift_) + 1;
  first_.assign(std::size_t{columns_} * rows, kNone);
  next_.clear();
  points_.clear();
  unread_.clear();
  for (const Leaf& leaf : leaves_) {
    // A block that was read before costs nothing.
    if (index_.has_read(leaf)) {
      load(leaf);
    } else {
      unread_.push_back({leaf, leaf.cell.box()});
    }
  }
}

std::size_t NearbyApex::bin(std::int32_t x, std::int32_t y) const {
  return std::size_t{static_cast<std::uint32_t>(y - box_.ymin) >> bin_shift_} * columns_ +
         (static_cast<std::uint32_t>(x - box_.xmin) >> bin_shift_);
}

void NearbyApex::load(const Leaf& leaf) {
  const auto block = index_.unordered_block(leaf);
  for (std::size_t k = 0; k < block->points.size(); ++k) {
    const GridPoint& p = block->points[k];
    if (!box_.contains(p.x, p.y)) continue;
    if (!selection_.selects(leaf, level_of(leaf, *block, k), p.x, p.y)) continue;
    std::uint32_t& first = first_[bin(p.x, p.y)];
    next_.push_back(first);
    first = static_cast<std::uint32_t>(points_.size());
    points_.push_back({p, block->theme(k)});
  }
}

void NearbyApex::consider(const ApexFrame& frame, const SectionVertex& point, Candidate& candidate) const {
  const Position c{point.x, point.y};
  if (!frame.inside(candidate.reach, c.x, c.y) || orientation(frame.a, frame.b, c) <= 0) return;
  if (candidate.best) {
    const Position best{candidate.best->x, candidate.best->y};
    if (best == c || in_circle_perturbed(frame.a, frame.b, best, c) < 0) return;
  }
  const bool hidden = std::any_of(near_.begin(), near_.end(),
                                  [&](const Segment& s) { return crosses(s, frame.a, c) || crosses(s, frame.b, c); });
  if (hidden) return;
  candidate.best = point;
  candidate.reach = std::min(candidate.reach, frame.lambda(c));
}

void NearbyApex::search_bins(const ApexFrame& frame, const GridBox& box, Candidate& candidate) const {
  for (std::size_t row = bin(box_.xmin, box.ymin), last = bin(box_.xmin, box.ymax); row <= last; row += columns_) {
    const std::size_t end = row + (static_cast<std::uint32_t>(box.xmax - box_.xmin) >> bin_shift_);
    for (std::size_t i = row + (static_cast<std::uint32_t>(box.xmin - box_.xmin) >> bin_shift_); i <= end; ++i) {
      for (std::uint32_t p = first_[i]; p != kNone; p = next_[p]) consider(frame, points_[p], candidate);
    }
  }
}

/// Returns the vertex of the least circle up to lambda, which must fit into the neighbourhood.
std::optional<SectionVertex> NearbyApex::search(const ApexFrame& frame, double lambda, const GridBox& cap) {
  Candidate candidate{std::nullopt, lambda};
  // No other segments come between the edge and the places in the circle.
  near_.clear();
  std::copy_if(segments_.begin(), segments_.end(), std::back_inserter(near_),
               [&](const Segment& s) { return cap.meets(extent_of(s)); });
  search_bins(frame, cap, candidate);
  reached_.clear();
  for (const auto& [leaf, box] : unread_) {
    if (cap.meets(box) && frame.cap_meets(candidate.reach, box)) reached_.emplace_back(frame.key(box), leaf.key);
  }
  // Leaves that may hold the least circle come first: that circle may then leave out the others.
  std::sort(reached_.begin(), reached_.end());
  for (const auto& [circle, key] : reached_) {
    const auto at =
        std::find_if(unread_.begin(), unread_.end(), [key = key](const Unread& u) { return u.leaf.key == key; });
    const GridBox box = at->box;
    if (!frame.cap_meets(candidate.reach, box) || hide(near_, frame.a, frame.b, intersection(box, cap))) continue;
    const std::size_t before = points_.size();
    load(at->leaf);
    *at = unread_.back();
    unread_.pop_back();
    for (std::size_t p = before; p < points_.size(); ++p) consider(frame, points_[p], candidate);
  }
  // A point on the searched circle itself may have rivals that rounding left out.
  if (candidate.best && candidate.reach < 0.999 * lambda) return candidate.best;
  return std::nullopt;
}

std::optional<SectionVertex> NearbyApex::apex(Position a, Position b) {
  const ApexFrame frame(a, b);
  constexpr GridBox kEverywhere{-kGridHalfSide, -kGridHalfSide, kGridHalfSide - 1, kGridHalfSide - 1};
  const GridBox all = index_.bounds();
  for (double lambda = 1.5 * frame.r; lambda < kMostGrowth * frame.r; lambda *= 2) {
    const GridBox cap = frame.cap_box(lambda, kEverywhere);
    const auto fits = [&] {
      return !box_.empty() && box_.contains(a.x, a.y) && box_.contains(b.x, b.y) &&
             box_.contains(intersection(cap, all));
    };
    if (!fits()) move_to(a, b, lambda);
    if (!fits()) break;
    if (const auto found = search(frame, lambda, intersection(cap, box_))) return found;
  }
  const auto found = fallback_.apex(a, b);
  if (!found) return std::nullopt;
  return SectionVertex{found->point, found->theme};
}

}  // namespace itin
