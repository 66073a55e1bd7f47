// Writes one level's quadtree into a store: that of the ground, with the points of all levels, or that of the points of
// one level.
//
//   LevelWriter level(index, bounds, k, writer);
//   for (const RawPoint& p : points) level.add(p);   // in Morton order; of all levels where k is 0, else of level k
//   level.finish();
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <itin/geometry.hpp>

#include "pyramid/levels/certify.hpp"
#include "pyramid/points/working_index.hpp"
#include "store/file/leaf_cutter.hpp"
#include "store/store_writer.hpp"

namespace itin {

/// Writes a level. Its leaves take the bounds of the working leaves in them.
class LevelWriter {
 public:
  /// All arguments must outlive it.
  LevelWriter(const WorkingIndex& index, const LeafBounds& bounds, int level, StoreWriter& writer);
  LevelWriter(const LevelWriter&) = delete;
  LevelWriter& operator=(const LevelWriter&) = delete;

  void add(const RawPoint& p);
  void finish() { cutter_.finish(); }

 private:
  void write(const Cell& cell, std::uint32_t count);

  const WorkingIndex& index_;
  const LeafBounds& bounds_;
  int level_;
  StoreWriter& writer_;
  std::vector<GridPoint> points_;
  std::vector<std::uint16_t> sources_;
  std::vector<std::uint8_t> levels_;
  std::uint32_t leaf_ = 0;
  LeafCutter<std::function<void(const Cell&, std::uint32_t)>> cutter_;
};

}  // namespace itin
