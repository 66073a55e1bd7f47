#include "pyramid/level_writer.hpp"

#include <span>

namespace itin {

LevelWriter::LevelWriter(const WorkingIndex& index, const LeafBounds& bounds, int level, StoreWriter& writer)
    : index_(index),
      bounds_(bounds),
      level_(level),
      writer_(writer),
      cutter_(level == 0 ? kGroundCapacity : kLeafCapacity,
              [this](const Cell& cell, std::uint32_t count) { write(cell, count); }) {}

void LevelWriter::add(const RawPoint& p) {
  points_.push_back({morton_x(p.code), morton_y(p.code), p.z});
  sources_.push_back(p.source);
  levels_.push_back(static_cast<std::uint8_t>(p.level));
  cutter_.add(p.code);
}

void LevelWriter::write(const Cell& cell, std::uint32_t count) {
  // The working tree is the finer one: it holds every level's points, and its capacity is no greater.
  DifferenceRange range;
  for (; leaf_ < index_.ranges().size() && index_.ranges()[leaf_].cell.code < cell.end(); ++leaf_)
    range.add(bounds_.at(leaf_, level_));
  if (count == 0 && range.empty()) return;
  if (range.empty()) range = {0, 0};
  const auto points = std::span(points_).first(count);
  const auto sources = std::span(sources_).first(count);
  if (level_ == 0) {
    writer_.add_ground(cell, points, sources, std::span(levels_).first(count));
  } else {
    writer_.add_leaf(level_, cell, points, sources, range.lo, range.hi);
  }
  points_.erase(points_.begin(), points_.begin() + count);
  sources_.erase(sources_.begin(), sources_.begin() + count);
  levels_.erase(levels_.begin(), levels_.begin() + count);
}

}  // namespace itin
