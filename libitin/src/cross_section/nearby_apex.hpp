// The third vertices of triangles along a line, from as few blocks as can be.
//
// ApexSearch (triangulate/apex.hpp) asks the index again for every edge. Here the answers are kept for a whole
// neighbourhood: the list of its leaves, the points of those read so far in a lattice of bins, the segments. A leaf is
// read when the circle at hand reaches it, not before. Where a circle outgrows the neighbourhood, ApexSearch takes
// over.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cross_section/section_walk.hpp"
#include "store/point_index.hpp"
#include "triangulate/apex.hpp"
#include "triangulate/read_once.hpp"
#include "triangulate/selection.hpp"

namespace itin {

struct ApexFrame;

/// Serves one thread and one line.
class NearbyApex {
 public:
  /// Edges will come one after another in about the direction `heading`.
  NearbyApex(const ReadOnce& index, const Selection& selection, Point2 heading);

  /// As ApexSearch::apex.
  std::optional<SectionVertex> apex(Position a, Position b);

 private:
  struct Candidate {
    std::optional<SectionVertex> best;
    double reach = 0;  ///< its lambda, or the one searched
  };

  struct Unread {
    Leaf leaf;
    GridBox box;  ///< its cell's
  };

  /// Makes a neighbourhood of edge ab that circles up to lambda fit into.
  void move_to(Position a, Position b, double lambda);
  /// `cap`: the box of the circle's part left of ab, within the neighbourhood.
  std::optional<SectionVertex> search(const ApexFrame& frame, double lambda, const GridBox& cap);
  void search_bins(const ApexFrame& frame, const GridBox& box, Candidate& candidate) const;
  void consider(const ApexFrame& frame, const SectionVertex& point, Candidate& candidate) const;
  void load(const Leaf& leaf);
  std::size_t bin(std::int32_t x, std::int32_t y) const;

  const ReadOnce& index_;
  const Selection& selection_;
  Point2 heading_;
  ApexSearch fallback_;

  GridBox box_;                 ///< the neighbourhood
  double half_side_ = 0;        ///< half the neighbourhood's side, grid units; 0 before the first one
  std::vector<Leaf> leaves_;    ///< kept to reuse its memory
  std::vector<Unread> unread_;  ///< leaves in the neighbourhood that are still to be read
  std::vector<std::pair<double, std::uint64_t>> reached_;  ///< unread leaves met by a search's circle: circle and key
  std::vector<Segment> segments_;
  std::vector<Segment> near_;  ///< segments_ that meet the box of one search's circle

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  int bin_shift_ = 0;
  std::uint32_t columns_ = 0;
  std::vector<std::uint32_t> first_;  ///< per bin, into points_
  std::vector<std::uint32_t> next_;   ///< per point
  std::vector<SectionVertex> points_;
};

}  // namespace itin
