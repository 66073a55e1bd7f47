#include "pyramid/points/working_index.hpp"

#include <algorithm>

#include <itin/sort_unique.hpp>

#include "geometry/cell_about.hpp"
#include "geometry/morton_range.hpp"
#include "store/file/leaf_cutter.hpp"

namespace itin {

namespace {

constexpr std::size_t kReadAhead = 1 << 16;
/// Room for the blocks of coarse points. Over smooth ground a tenth of all points has a coarse level; those of 20
/// million points fit.
constexpr std::uint64_t kCoarseBlockBytes = 32 << 20;
/// A mended cell has no more points of the level that does not hold, unless it has few points at all: the full surface
/// under it has to be made anew.
constexpr std::uint64_t kMendedOfLevel = 512, kLeastMended = 1 << 11, kMostMended = 1 << 15;
/// Marks the key of a leaf's points of level 1 and coarser.
constexpr std::uint64_t kCoarse = std::uint64_t{1} << 32;

}  // namespace

WorkingIndex::WorkingIndex(SortedPoints& points, int level_count, std::uint32_t leaf_capacity)
    : points_(points), level_count_(level_count), coarse_blocks_(kCoarseBlockBytes) {
  std::uint64_t first = 0;
  LeafCutter cutter(leaf_capacity, [&](const Cell& cell, std::uint32_t count) {
    ranges_.push_back({cell, first, count});
    first += count;
  });
  std::vector<RawPoint> buffer;
  for (std::uint64_t at = 0; at < points.size(); at += buffer.size()) {
    buffer.resize(std::min<std::uint64_t>(kReadAhead, points.size() - at));
    points.read(at, buffer);
    for (const RawPoint& p : buffer) {
      cutter.add(p.code);
      bounds_.extend(morton_x(p.code), morton_y(p.code));
    }
  }
  cutter.finish();
  // At first all points are of the finest level.
  selected_ = std::vector<std::atomic<std::uint32_t>>(ranges_.size() * static_cast<std::size_t>(level_count));
  for (std::size_t i = 0; i < ranges_.size(); ++i)
    selected_[i * static_cast<std::size_t>(level_count)] = ranges_[i].count;
  segment_start_.assign(ranges_.size() + 1, 0);
}

std::uint32_t WorkingIndex::leaf_of(std::uint64_t code) const {
  const auto after = std::upper_bound(ranges_.begin(), ranges_.end(), code,
                                      [](std::uint64_t c, const CurveRange& r) { return c < r.cell.code; });
  return static_cast<std::uint32_t>(after - ranges_.begin()) - 1;
}

void WorkingIndex::visit(Cell cell, std::uint32_t first, std::uint32_t last, const GridBox& box,
                         std::vector<std::uint32_t>& out) const {
  if (!square_of(cell).meets(box)) return;
  if (last - first == 1) {
    out.push_back(first);
    return;
  }
  for (int i = 0; i < 4; ++i) {
    const Cell child = cell.child(i);
    const auto end = i == 3
                         ? last
                         : static_cast<std::uint32_t>(
                               std::lower_bound(ranges_.begin() + first, ranges_.begin() + last, child.end(),
                                                [](const CurveRange& r, std::uint64_t c) { return r.cell.code < c; }) -
                               ranges_.begin());
    visit(child, first, end, box, out);
    first = end;
  }
}

void WorkingIndex::leaves_at(const GridBox& box, std::vector<std::uint32_t>& out) const {
  if (box.empty()) return;
  // Enter the tree at the smallest cell whose square may hold the box.
  const Cell cell = cell_about({box.xmin - 1, box.ymin - 1, box.xmax, box.ymax});
  const std::uint32_t first = leaf_of(cell.code);
  if (ranges_[first].cell.contains(cell)) return visit(ranges_[first].cell, first, first + 1, box, out);
  visit(cell, first, leaf_of(cell.end() - 1) + 1, box, out);
}

const std::vector<std::uint32_t>& WorkingIndex::occupied(int level) const {
  if (!occupied_known_.load(std::memory_order_acquire)) {
    const std::scoped_lock lock(occupied_mutex_);
    if (!occupied_known_.load(std::memory_order_relaxed)) {
      occupied_.assign(static_cast<std::size_t>(level_count_), {});
      for (int k = 1; k < level_count_; ++k) {
        for (std::uint32_t leaf = 0; leaf < ranges_.size(); ++leaf) {
          if (selected(leaf, k) > 0) occupied_[static_cast<std::size_t>(k)].push_back(leaf);
        }
      }
      occupied_known_.store(true, std::memory_order_release);
    }
  }
  return occupied_[static_cast<std::size_t>(level)];
}

template <class Visit>
void WorkingIndex::visit_those_at(const std::vector<std::uint32_t>& leaves, const GridBox& box,
                                  const Visit& visit) const {
  if (!MortonRange::exists(box)) return;
  const MortonRange range(box);
  std::optional<std::uint64_t> code = range.next(0);
  for (auto leaf = leaves.begin(); code;) {
    // Invariant: *code is in the box, and no leaf below it is left to visit.
    leaf = std::partition_point(leaf, leaves.end(), [&](std::uint32_t i) { return ranges_[i].cell.end() <= *code; });
    // Leaves in the box mostly follow each other.
    while (leaf != leaves.end() && ranges_[*leaf].cell.box().meets(box)) visit(*leaf++);
    if (leaf == leaves.end()) return;
    code = range.next(ranges_[*leaf].cell.code);
  }
}

void WorkingIndex::leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const {
  const int finest = asked.finest;
  std::vector<std::uint32_t> found;
  if (finest == 0) {
    leaves_at(box, found);
  } else {
    visit_those_at(occupied(finest), box, [&](std::uint32_t leaf) { found.push_back(leaf); });
  }
  for (const std::uint32_t i : found) {
    const CurveRange& range = ranges_[i];
    Leaf leaf;
    leaf.points = leaf.asked = selected(i, finest);
    if (leaf.points == 0 || !range.cell.box().meets(box)) continue;
    leaf.cell = range.cell;
    leaf.level = level_count_ - 1;
    leaf.key = keeps_coarse_points_ && finest > 0 ? i | kCoarse : i;
    out.push_back(leaf);
  }
}

std::shared_ptr<const Block> WorkingIndex::block(const Leaf& leaf) const {
  if (leaf.key < kCoarse) return read_block(static_cast<std::uint32_t>(leaf.key), 0);
  if (auto cached = coarse_blocks_.find(leaf.key)) return std::static_pointer_cast<const Block>(std::move(cached));
  auto block = read_block(static_cast<std::uint32_t>(leaf.key - kCoarse), 1);
  coarse_blocks_.insert(leaf.key, block, block->bytes());
  return block;
}

/// The leaf's points of level `finest` and coarser.
std::shared_ptr<const Block> WorkingIndex::read_block(std::uint32_t leaf, int finest) const {
  const std::vector<RawPoint> raw = read(ranges_[leaf]);
  auto block = std::make_shared<Block>();
  const std::size_t count = selected(leaf, finest);
  block->points.reserve(count);
  block->levels.reserve(count);
  for (const RawPoint& p : raw) {
    if (p.level == kDropped || p.level < finest) continue;
    block->points.push_back({morton_x(p.code), morton_y(p.code), p.z});
    block->sources.add(p.source);
    block->levels.push_back(static_cast<std::uint8_t>(p.level));
  }
  return block;
}

void WorkingIndex::segments(const GridBox& box, std::vector<Segment>& out) const {
  visit_those_at(segment_leaves_, box, [&](std::uint32_t leaf) {
    for (std::uint32_t k = segment_start_[leaf]; k < segment_start_[leaf + 1]; ++k)
      out.push_back(segments_[segment_list_[k]]);
  });
}

std::uint64_t WorkingIndex::selected_points(int level) const {
  std::uint64_t points = 0;
  for (std::uint32_t leaf = 0; leaf < ranges_.size(); ++leaf) points += selected(leaf, level);
  return points;
}

template <class Fits>
std::vector<CurveRange> WorkingIndex::largest_cells(int level, const Fits& fits) const {
  std::vector<CurveRange> result;
  for (std::uint32_t i = 0; i < ranges_.size();) {
    // Cells grow from the leaf to the largest aligned ancestor that is not too full: siblings follow on the curve.
    CurveRange tile = ranges_[i];
    std::uint64_t of_level = selected(i, level);
    std::uint32_t end = i + 1;
    while (tile.cell.log2_side < kRootLog2Side) {
      const Cell larger = tile.cell.parent();
      if (larger.code != tile.cell.code) break;
      std::uint64_t count = tile.count, selected_points = of_level;
      std::uint32_t j = end;
      for (; j < ranges_.size() && ranges_[j].cell.code < larger.end() && fits(count, selected_points); ++j)
        count += ranges_[j].count, selected_points += selected(j, level);
      if (!fits(count, selected_points)) break;
      tile = {larger, tile.first, static_cast<std::uint32_t>(count)};
      of_level = selected_points;
      end = j;
    }
    if (square_of(tile.cell).meets(bounds_)) result.push_back(tile);
    i = end;
  }
  return result;
}

std::vector<CurveRange> WorkingIndex::tiles(std::uint32_t capacity) const {
  return largest_cells(0, [&](std::uint64_t points, std::uint64_t) { return points <= capacity; });
}

std::vector<CurveRange> WorkingIndex::mending_cells(int level) const {
  return largest_cells(level, [&](std::uint64_t points, std::uint64_t of_level) {
    return points <= kLeastMended || (points <= kMostMended && of_level <= kMendedOfLevel);
  });
}

std::vector<RawPoint> WorkingIndex::read(const CurveRange& range) const {
  std::vector<RawPoint> result(range.count);
  points_.read(range.first, result);
  return result;
}

void WorkingIndex::write(const CurveRange& range, std::span<const RawPoint> points) {
  points_.write(range.first, points);
  occupied_known_.store(false, std::memory_order_relaxed);
  for (std::uint32_t leaf = leaf_of(range.cell.code);
       leaf < ranges_.size() && ranges_[leaf].cell.code < range.cell.end(); ++leaf) {
    const CurveRange& r = ranges_[leaf];
    coarse_blocks_.erase(leaf | kCoarse);
    count_levels(leaf, points.subspan(r.first - range.first, r.count));
  }
}

void WorkingIndex::count_levels(std::uint32_t leaf, std::span<const RawPoint> points) {
  std::vector<std::uint32_t> count(static_cast<std::size_t>(level_count_) + 1, 0);
  for (const RawPoint& p : points) {
    if (p.level != kDropped) count[p.level] += 1;
  }
  for (std::size_t k = static_cast<std::size_t>(level_count_); k-- > 0;) {
    count[k] += count[k + 1];
    selected_[std::size_t{leaf} * static_cast<std::size_t>(level_count_) + k].store(count[k],
                                                                                    std::memory_order_relaxed);
  }
}

std::uint64_t WorkingIndex::drop(std::vector<std::uint64_t> codes) {
  sort_unique(codes);
  for (auto at = codes.begin(); at != codes.end();) {
    const CurveRange& leaf = ranges_[leaf_of(*at)];
    const auto end = std::lower_bound(at, codes.end(), leaf.cell.end());
    std::vector<RawPoint> points = read(leaf);
    for (RawPoint& p : points) {
      if (std::binary_search(at, end, p.code)) p.level = kDropped;
    }
    write(leaf, points);
    at = end;
  }
  return codes.size();
}

std::vector<RaisedPoint> WorkingIndex::promote(std::vector<LevelRaise> raises) {
  std::vector<RaisedPoint> raised;
  std::sort(raises.begin(), raises.end(), [](const LevelRaise& a, const LevelRaise& b) { return a.code < b.code; });
  for (auto at = raises.begin(); at != raises.end();) {
    const CurveRange& leaf = ranges_[leaf_of(at->code)];
    std::vector<RawPoint> points = read(leaf);
    for (auto p = points.begin(); at != raises.end() && at->code < leaf.cell.end(); ++at) {
      while (p != points.end() && p->code < at->code) ++p;
      if (p == points.end() || p->code != at->code || p->level == kDropped) continue;
      if (p->level >= at->level) continue;
      raised.push_back({p->code, p->level, at->level});
      p->level = static_cast<std::uint16_t>(at->level);
    }
    write(leaf, points);
  }
  return raised;
}

void WorkingIndex::leaves_along(Point2 p, Point2 q, std::vector<std::uint32_t>& out) const {
  const GridBox box{static_cast<std::int32_t>(std::floor(std::min(p.x, q.x))),
                    static_cast<std::int32_t>(std::floor(std::min(p.y, q.y))),
                    static_cast<std::int32_t>(std::ceil(std::max(p.x, q.x))),
                    static_cast<std::int32_t>(std::ceil(std::max(p.y, q.y)))};
  const std::size_t before = out.size();
  leaves_at(box, out);
  // A box this small or thin, or with this few leaves, claims hardly more than the segment does.
  if (out.size() - before <= 4 || box.xmax - box.xmin <= 2 || box.ymax - box.ymin <= 2) return;
  out.resize(before);
  const Point2 middle{(p.x + q.x) / 2, (p.y + q.y) / 2};
  leaves_along(p, middle, out);
  leaves_along(middle, q, out);
}

void WorkingIndex::set_segments(std::vector<Segment> segments) {
  segments_ = std::move(segments);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings;
  std::vector<std::uint32_t> found;
  for (std::uint32_t s = 0; s < segments_.size(); ++s) {
    const Segment& segment = segments_[s];
    found.clear();
    leaves_along({double(segment.ax), double(segment.ay)}, {double(segment.bx), double(segment.by)}, found);
    sort_unique(found);
    for (const std::uint32_t leaf : found) crossings.emplace_back(leaf, s);
  }
  std::sort(crossings.begin(), crossings.end());
  segment_start_.assign(ranges_.size() + 1, 0);
  segment_list_.clear();
  segment_leaves_.clear();
  for (const auto& [leaf, s] : crossings) {
    if (segment_leaves_.empty() || segment_leaves_.back() != leaf) segment_leaves_.push_back(leaf);
    segment_start_[leaf + 1] += 1;
    segment_list_.push_back(s);
  }
  for (std::size_t i = 1; i < segment_start_.size(); ++i) segment_start_[i] += segment_start_[i - 1];
}

}  // namespace itin
