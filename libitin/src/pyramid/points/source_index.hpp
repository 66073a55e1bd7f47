// The points of some sources only, without any lines.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <vector>

#include "pyramid/points/working_index.hpp"

namespace itin {

using Sources = std::set<std::uint16_t>;

/// The sources of the points. Points of one source mostly follow each other.
template <class Points>
Sources sources_of(const Points& points) {
  Sources sources;
  auto latest = sources.end();
  for (const auto& p : points)
    if (latest == sources.end() || *latest != p.source) latest = sources.insert(p.source).first;
  return sources;
}

/// An index of the sources' points. It knows which leaves hold such points, so that searches pass over all others.
/// Making it takes O(points).
class SourceIndex final : public PointIndex {
 public:
  /// Both must outlive it. Points that the base drops later must not be looked up any more.
  SourceIndex(const WorkingIndex& base, const Sources& sources);
  const Sources& sources() const { return sources_; }

  int level_count() const override { return base_.level_count(); }
  GridBox bounds() const override { return bounds_; }
  void leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const override;
  std::shared_ptr<const Block> block(const Leaf& leaf) const override;
  void segments(const GridBox&, std::vector<Segment>&) const override {}

 private:
  const WorkingIndex& base_;
  const Sources& sources_;
  GridBox bounds_;
  std::vector<std::uint32_t> points_;  ///< by leaf of the base
};

}  // namespace itin
