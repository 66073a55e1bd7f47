// The part of an index that has been read for one region: vertices by number, and segments, each once.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <itin/tin.hpp>

#include "store/codec/point_index.hpp"
#include "triangulate/apex/apex.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

class RegionReader {
 public:
  /// Refers to both arguments, which must outlive it.
  RegionReader(const PointIndex& index, const Selection& selection) : index_(index), selection_(selection) {}

  std::vector<Leaf> leaves_in(const GridBox& box) const;
  /// Estimates how many of the leaves' points lie in a box: strips a few points wide meet many leaves.
  static double points_of(const std::vector<Leaf>& leaves, const GridBox& box);
  double points_in(const GridBox& box) const { return points_of(leaves_in(box), box); }

  /// Forgets everything, and reads the points of one box, and those of some leaves in another. They get the first
  /// numbers, in Morton order.
  void start(const GridBox& box, std::span<const Leaf> leaves, const GridBox& box_of_leaves);
  /// The points of a box, with their Morton codes.
  using Coded = std::pair<std::uint64_t, SelectedVertex>;
  std::vector<Coded> points(const GridBox& box);
  /// Reads the segments that meet the box and have not been read before.
  std::vector<Segment> fresh_segments(const GridBox& box);

  struct Numbered {
    std::uint32_t vertex;
    bool fresh;  ///< the vertex was not there before
  };
  Numbered number_of(const SelectedVertex& vertex);
  /// Returns the number of a segment's end, which is known by position only.
  Numbered number_of(Position end);
  /// Gives a segment's end its height. Throws Error where there is no vertex.
  void complete(std::uint32_t vertex, ApexSearch& search);

  const std::vector<SelectedVertex>& vertices() const { return vertices_; }
  /// Returns the number of vertices in Morton order; those after them came one by one.
  std::uint32_t in_order() const { return static_cast<std::uint32_t>(codes_.size()); }
  const RetrievalStatistics& statistics() const { return statistics_; }

 private:
  struct HashOfEnds {
    std::size_t operator()(const Segment& s) const {
      return code_of(s.a()) * 0x9e3779b97f4a7c15 ^ code_of(s.b()) * 0xc2b2ae3d27d4eb4f;
    }
  };

  void read_block(const Leaf& leaf, const GridBox& box, std::vector<Coded>& found);
  Numbered number_of(const SelectedVertex& vertex, bool whole);

  const PointIndex& index_;
  const Selection& selection_;
  std::vector<SelectedVertex> vertices_;
  std::vector<std::uint64_t> codes_;                         ///< Morton codes of the vertices in order
  std::unordered_map<std::uint64_t, std::uint32_t> others_;  ///< numbers of vertices that came later, by Morton code
  std::set<std::uint32_t> bare_;                             ///< numbers in others_ of vertices known by position only
  std::unordered_set<Segment, HashOfEnds> segments_;         ///< segments that have been read
  RetrievalStatistics statistics_;
};

/// Tells whether a closed segment meets a closed box, exactly.
bool meets(Position p, Position q, const GridBox& box);

double area(const GridBox& box);

}  // namespace itin
