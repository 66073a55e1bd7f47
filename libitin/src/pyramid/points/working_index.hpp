// The importer's points as a PointIndex: one quadtree over the sorted temporary file, every point with its level.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "pyramid/points/sorted_points.hpp"
#include "store/codec/point_index.hpp"
#include "store/file/block_cache.hpp"

namespace itin {

/// The level of a point that is left out of the surface.
inline constexpr std::uint16_t kDropped = 0xffff;

/// A contiguous piece of the curve: a quadtree cell and its points' place in the sorted file.
struct CurveRange {
  Cell cell;
  std::uint64_t first = 0;
  std::uint32_t count = 0;
};

/// A point, by its Morton code, that should have this level or a coarser one.
struct LevelRaise {
  std::uint64_t code;
  int level;
};

/// A point, by its Morton code, that has been raised from one level to a coarser one.
struct RaisedPoint {
  std::uint64_t code;
  int from, to;
};

/// Any thread may read. Several threads may call write() at once, each for ranges of its own. Meanwhile nobody may read
/// those ranges, and only level 0 of other ranges.
class WorkingIndex final : public PointIndex {
 public:
  WorkingIndex(SortedPoints& points, int level_count, std::uint32_t leaf_capacity);

  int level_count() const override { return level_count_; }
  GridBox bounds() const override { return bounds_; }
  void leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const override;
  std::shared_ptr<const Block> block(const Leaf& leaf) const override;
  void segments(const GridBox& box, std::vector<Segment>& out) const override;

  /// All leaves of the quadtree, empty ones included, in Morton order: they tile the root.
  const std::vector<CurveRange>& ranges() const { return ranges_; }
  /// Appends the numbers, in ranges(), of the leaves whose square meets `box`, empty ones included.
  void leaves_at(const GridBox& box, std::vector<std::uint32_t>& out) const;
  /// The number of the leaf that holds this code.
  std::uint32_t leaf_of(std::uint64_t code) const;
  /// How many points have this level or a coarser one.
  std::uint64_t selected_points(int level) const;
  /// Coarser cells with at most `capacity` points each, perhaps none, that together cover bounds().
  std::vector<CurveRange> tiles(std::uint32_t capacity) const;
  /// The cells that levels are chosen in. They follow from the points near by, however many there are elsewhere.
  std::vector<CurveRange> work_cells() const { return tiles(kWorkCell); }
  /// The cells that a level is mended in: with few points of the level, or few points at all. They follow from the
  /// points near by, too.
  std::vector<CurveRange> mending_cells(int level) const;

  std::vector<RawPoint> read(const CurveRange& range) const;
  void write(const CurveRange& range, std::span<const RawPoint> points);
  /// Leaves these points out of the surface; codes may come in any order and may repeat. Returns the number of points
  /// left out. Not thread-safe.
  std::uint64_t drop(std::vector<std::uint64_t> codes);
  /// Raises these points' levels; they may come in any order and may repeat, and need not exist. Returns those that had
  /// finer ones. Not thread-safe.
  std::vector<RaisedPoint> promote(std::vector<LevelRaise> raises);

  /// Makes a block of its own of a leaf's points of level 1 and coarser, from now on, for where coarse levels are read.
  /// These blocks are kept in memory: coarse surfaces need few points of each of many leaves. Not thread-safe.
  void keep_coarse_points() { keeps_coarse_points_ = true; }

  /// Sets the outline of the coverage, once it is known.
  void set_segments(std::vector<Segment> segments);
  const std::vector<Segment>& all_segments() const { return segments_; }

 private:
  /// The most points of a work cell. Larger ones have fewer borders; smaller ones change less where points are added.
  static constexpr std::uint32_t kWorkCell = 1 << 16;

  /// The largest cells, or leaves, for which fits(points, points of the level) holds, which must hold for their parts.
  template <class Fits>
  std::vector<CurveRange> largest_cells(int level, const Fits& fits) const;
  std::shared_ptr<const Block> read_block(std::uint32_t leaf, int finest) const;
  /// Appends the leaves that segment pq meets, and perhaps some beside it or twice.
  void leaves_along(Point2 p, Point2 q, std::vector<std::uint32_t>& out) const;
  std::uint32_t selected(std::uint32_t leaf, int level) const {
    return selected_[std::size_t{leaf} * static_cast<std::size_t>(level_count_) + static_cast<std::size_t>(level)].load(
        std::memory_order_relaxed);
  }
  /// The leaves with points of this level (not 0) or a coarser one; there are few of them for coarse levels.
  const std::vector<std::uint32_t>& occupied(int level) const;
  /// Calls visit(leaf) for each of these leaves, in ascending order, that holds a position of the box.
  template <class Visit>
  void visit_those_at(const std::vector<std::uint32_t>& leaves, const GridBox& box, const Visit& visit) const;
  void count_levels(std::uint32_t leaf, std::span<const RawPoint> points);
  void visit(Cell cell, std::uint32_t first, std::uint32_t last, const GridBox& box,
             std::vector<std::uint32_t>& out) const;

  SortedPoints& points_;
  int level_count_;
  GridBox bounds_;
  std::vector<CurveRange> ranges_;
  /// The number of points that have a level or a coarser one, per range and level.
  std::vector<std::atomic<std::uint32_t>> selected_;
  bool keeps_coarse_points_ = false;
  mutable BlockCache coarse_blocks_;
  mutable std::vector<std::vector<std::uint32_t>> occupied_;  ///< by level, made when first asked for after a write
  mutable std::atomic<bool> occupied_known_ = false;
  mutable std::mutex occupied_mutex_;
  std::vector<Segment> segments_;
  std::vector<std::uint32_t> segment_start_;   ///< per range, into segment_list_
  std::vector<std::uint32_t> segment_leaves_;  ///< the ranges that segments meet, ascending
  std::vector<std::uint32_t> segment_list_;    ///< numbers of the segments that meet the range's cell
};

}  // namespace itin
