// Points to be stored: sorted along the Morton curve in a temporary file, never all in memory.
//
//   PointSorter sorter(directory, memory_bytes);
//   sorter.add({code_of(p), p.z, source});           // any order
//   SortedPoints points = sorter.finish(ranks_of_sources, progress);   // sorted, one point per position
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <itin/progress.hpp>

namespace itin {

struct RawPoint {
  std::uint64_t code = 0;  ///< Morton code of the grid position
  std::int32_t z = 0;      ///< grid units
  std::uint16_t source = 0;
  std::uint16_t level = 0;  ///< set by the pyramid
};
static_assert(sizeof(RawPoint) == 16);

/// A point of the ground as imported, and the source of the line whose vertex takes its place.
struct CoveredPoint {
  RawPoint point;
  std::uint16_t line = 0;
};

/// A temporary file of points in ascending order of code, all codes distinct; it is removed with the object. Reading is
/// safe from any thread; writing is safe for disjoint ranges.
class SortedPoints {
 public:
  SortedPoints(SortedPoints&&) noexcept;
  SortedPoints& operator=(SortedPoints&&) noexcept;
  ~SortedPoints();

  std::uint64_t size() const;
  /// Reads points [first, first + out.size()). Throws FileError.
  void read(std::uint64_t first, std::span<RawPoint> out) const;
  /// Overwrites points [first, first + points.size()); their codes must not change.
  void write(std::uint64_t first, std::span<const RawPoint> points);
  /// Puts vertices of lines (ascending by code) in the place of points at their positions, which they cover. A point's
  /// source remains, or there would be a hole in its ground. `of_lines` tells of each source whether its points are
  /// vertices of lines themselves. Returns the vertices at positions without a point. Throws FileError.
  std::vector<RawPoint> cover(std::span<const RawPoint> vertices, const std::vector<bool>& of_lines);
  /// The number of points whose code is below `code`. Costs one small read, thanks to a sparse index in memory.
  std::uint64_t lower_bound(std::uint64_t code) const;
  /// The points that are not among these because a line has a vertex at their positions; ascending by code.
  const std::vector<CoveredPoint>& covered() const;
  /// Makes a new file of these points, without points whose level is `dropped`, and with the points of `more`
  /// (ascending by code) at positions that have no point yet. Throws FileError.
  SortedPoints with(std::span<const RawPoint> more, std::uint16_t dropped) const;

 private:
  friend class PointSorter;
  class Impl;
  explicit SortedPoints(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The rank of a source's points where several lie at one position.
struct SourceRank {
  double spacing = 0;       ///< metres
  bool ground = true;       ///< its points are ground by themselves, not only where others are
  bool line = false;        ///< whether its points are vertices of lines, which come before all others
  std::uint32_t order = 0;  ///< the source with the least comes first, where nothing else decides
  bool replaces = false;    ///< whether it comes before others of its spacing
};

/// An external merge sort. Temporary files are unlinked at once where the system allows, so that none outlives a kill.
class PointSorter {
 public:
  /// Uses at most about `memory_bytes` for its buffers.
  PointSorter(std::string directory, std::uint64_t memory_bytes);
  ~PointSorter();
  /// Adds points; not thread-safe.
  void add(const RawPoint& point);
  void add(std::span<const RawPoint> points);
  /// Gives sources other numbers: source s becomes `numbers[s]` in what finish() returns.
  void renumber(std::vector<std::uint16_t> numbers);
  /// Sorts the points, and keeps one at each position. A point of a line goes first, then one whose source has the
  /// finest spacing. Among equal spacings a source that replaces others goes first, then the highest point, and then
  /// the point whose source comes first. So the rule is one on the points alone.
  /// If the point kept is not ground but another one there is, the kept one takes that one's source, or there would be
  /// a hole. `duplicates`, if given, receives the number dropped and not covered. Throws FileError, Cancelled.
  SortedPoints finish(std::span<const SourceRank> sources, Progress& progress, std::uint64_t* duplicates = nullptr);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin
