// The third vertices of triangles along a line, from as few blocks as possible.
//
// ApexSearch (triangulate/apex/apex.hpp) asks the index again for every edge. Here the answers are kept for a whole
// neighbourhood: the list of its leaves, the points read so far, in a lattice of bins, and the segments. A leaf is read
// only when the current circle reaches it. Where a circle outgrows the neighbourhood, ApexSearch takes over.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cross_section/section_walk.hpp"
#include "store/codec/point_index.hpp"
#include "triangulate/apex/apex.hpp"
#include "triangulate/apex/read_once.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

struct ApexFrame;

/// Finds third vertices along a line. Serves one thread and one line.
class NearbyApex {
 public:
  /// Takes the direction `heading` in which, about, edges will come one after another.
  NearbyApex(const ReadOnce& index, const Selection& selection, Point2 heading);

  /// Returns what ApexSearch::apex() does.
  std::optional<SectionVertex> apex(Position a, Position b);

 private:
  struct Candidate {
    std::optional<SectionVertex> best;
    double reach = 0;  ///< lambda of `best`, or else the greatest one searched
  };

  struct Unread {
    Leaf leaf;
    GridBox box;  ///< the box of the leaf's cell
  };

  /// Makes a neighbourhood of edge ab that circles up to lambda fit into.
  void move_to(Position a, Position b, double lambda);
  /// Searches circles up to lambda. `cap` is the box of the circle's part left of ab, within the neighbourhood.
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
  std::vector<std::uint32_t> first_;  ///< per bin: its first point's index in points_
  std::vector<std::uint32_t> next_;   ///< per point: the next point of its bin
  std::vector<SectionVertex> points_;
};

}  // namespace itin
