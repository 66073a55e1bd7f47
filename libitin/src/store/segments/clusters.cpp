#include "store/segments/clusters.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <tuple>

#include <itin/sort_unique.hpp>

#include "store/codec/bit_stream.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/codec/rice_parameter.hpp"

namespace itin {

namespace {

/// The step of boxes, grid units: finer steps would leave out more features, but not enough to be worth their bytes.
constexpr int kStepBits = 6;
constexpr std::int64_t kSteps = std::int64_t{2} * kGridHalfSide >> kStepBits;  // steps across the grid

/// The numbers of a box, as they are written.
enum BoxNumber { kAcross, kUp, kWidth, kHeight, kNumbers };
using Written = std::array<std::uint64_t, kNumbers>;

struct Steps {
  std::int64_t x, y;  // steps
};

Steps steps_to(const Cell& cell) {
  return {morton_x(cell.code) >> kStepBits, morton_y(cell.code) >> kStepBits};
}

auto ordered_sides(const GridBox& b) {
  return std::tie(b.xmin, b.ymin, b.xmax, b.ymax);
}
bool box_before(const GridBox& a, const GridBox& b) {
  return ordered_sides(a) < ordered_sides(b);
}

/// Returns the least y of all boxes, and the x that the first gap counts from.
Steps origin_of(std::span<const GridBox> boxes) {
  std::int32_t lowest = boxes.front().ymin;
  for (const GridBox& b : boxes) lowest = std::min(lowest, b.ymin);
  return {boxes.front().xmin >> kStepBits, lowest >> kStepBits};
}

std::vector<Written> written(std::span<const GridBox> boxes) {
  const auto [first, lowest] = origin_of(boxes);
  std::vector<Written> all;
  std::int64_t x = first;
  const auto whole = [](std::int64_t v) { return static_cast<std::uint64_t>(v); };
  for (const GridBox& b : boxes) {
    const std::int64_t left = b.xmin >> kStepBits, bottom = b.ymin >> kStepBits;
    all.push_back({whole(left - x), whole(bottom - lowest), whole((b.xmax >> kStepBits) - left),
                   whole((b.ymax >> kStepBits) - bottom)});
    x = left;
  }
  return all;
}

/// The clusters of a leaf that an item may belong to, by the boxes.
class Candidates {
 public:
  using Numbers = std::vector<std::uint32_t>;

  explicit Candidates(std::span<const GridBox> boxes) : boxes_(boxes) {}

  const Numbers& of(const GridBox& item) {
    met_.clear();
    for (std::uint32_t b = 0; b < boxes_.size() && boxes_[b].xmin <= item.xmax; ++b)
      if (boxes_[b].meets(item)) met_.push_back(b);
    return met_;
  }
  /// Tells whether the item may belong to just these clusters.
  bool allow(const Numbers& others) const {
    return !others.empty() && std::includes(met_.begin(), met_.end(), others.begin(), others.end());
  }

 private:
  std::span<const GridBox> boxes_;
  Numbers met_;
};

template <class Item, class Clusters>
LeafClusters clusters_of(std::span<const Item> items, const std::vector<GridBox>& all, const Clusters& of) {
  LeafClusters result;
  std::vector<std::pair<std::uint32_t, GridBox>> boxes;  // the boxes of each item's clusters
  for (std::uint32_t i = 0; i < items.size(); ++i)
    of(items[i], [&](std::uint32_t cluster) { boxes.emplace_back(i, all[cluster]); });
  for (const auto& [item, box] : boxes) result.boxes.push_back(box);
  std::sort(result.boxes.begin(), result.boxes.end(), box_before);
  result.boxes.erase(std::unique(result.boxes.begin(), result.boxes.end()), result.boxes.end());
  for (const auto& [item, box] : boxes) {
    const auto at = std::lower_bound(result.boxes.begin(), result.boxes.end(), box, box_before);
    result.items.push_back({item, static_cast<std::uint32_t>(at - result.boxes.begin())});
  }
  sort_unique(result.items);
  return result;
}

class ClusterReader {
 public:
  ClusterReader(const Cell& cell, std::span<const std::uint8_t> bytes) {
    ByteReader header(bytes);
    count_ = header.varint(1, 8 * std::uint64_t{bytes.size()});
    const Steps corner = steps_to(cell);
    first_ = corner.x + header.signed_varint(), lowest_ = corner.y + header.signed_varint();
    for (int& k : parameters_) k = static_cast<int>(header.varint(0, kMaxRiceParameter));
    padded_.assign(header.rest().begin(), header.rest().end());
    padded_.resize(padded_.size() + BitReader::kPadding);
  }

  LeafClusters read(std::span<const GridBox> extents) {
    BitReader bits(padded_);
    read_boxes(bits);
    Candidates candidates(result_.boxes);
    Candidates::Numbers own;
    for (std::uint32_t i = 0; i < extents.size(); ++i) {
      const Candidates::Numbers& met = candidates.of(extents[i]);
      if (met.empty()) throw DecodeError("an item lies outside of all clusters");
      if (met.size() == 1) {
        own = met;
      } else if (bits.bits(1) == 1) {
        if (!candidates.allow(own)) throw DecodeError("an item lies outside of its cluster");
      } else {
        own.clear();
        for (const std::uint32_t b : met)
          if (bits.bits(1) == 1) own.push_back(b);
        if (own.empty()) throw DecodeError("an item is of no cluster");
      }
      for (const std::uint32_t b : own) result_.items.push_back({i, b});
    }
    if (!bits.finished_cleanly()) throw DecodeError("clusters end too early or too late");
    return std::move(result_);
  }

 private:
  void read_boxes(BitReader& bits) {
    std::int64_t x = first_;
    for (std::uint64_t i = 0; i < count_; ++i) {
      Written w{};
      for (std::size_t n = 0; n < kNumbers; ++n) {
        w[n] = bits.rice(parameters_[n]);
        if (w[n] >= static_cast<std::uint64_t>(kSteps)) throw DecodeError("a cluster leaves the grid");
      }
      x += static_cast<std::int64_t>(w[kAcross]);
      const std::int64_t y = lowest_ + static_cast<std::int64_t>(w[kUp]);
      const GridBox box{first_of(x), first_of(y), last_of(x + static_cast<std::int64_t>(w[kWidth])),
                        last_of(y + static_cast<std::int64_t>(w[kHeight]))};
      if (i > 0 && !box_before(result_.boxes.back(), box)) throw DecodeError("clusters are out of order");
      result_.boxes.push_back(box);
    }
  }

  static std::int32_t first_of(std::int64_t step) {
    if (step < -kSteps / 2 || step >= kSteps / 2) throw DecodeError("a cluster leaves the grid");
    return static_cast<std::int32_t>(step * (1 << kStepBits));
  }
  static std::int32_t last_of(std::int64_t step) { return first_of(step) + (1 << kStepBits) - 1; }

  std::uint64_t count_ = 0;
  std::int64_t first_ = 0, lowest_ = 0;
  std::array<int, kNumbers> parameters_{};
  std::vector<std::uint8_t> padded_;
  LeafClusters result_;
};

}  // namespace

LeafClusters PartClusters::of(std::span<const GridPoint> points) const {
  return clusters_of(points, boxes, [&](const GridPoint& p, const auto& visit) {
    const std::uint64_t code = code_of(p);
    auto at = std::lower_bound(of_places.begin(), of_places.end(), std::pair{code, std::uint32_t{0}});
    for (; at != of_places.end() && at->first == code; ++at) visit(at->second);
  });
}

LeafClusters PartClusters::of(std::span<const Segment> segments) const {
  return clusters_of(segments, boxes, [&](const Segment& s, const auto& visit) {
    for (const SegmentFeature& f : of_segment(of_segments, s)) visit(f.feature);
  });
}

GridBox box_about_cluster(const GridBox& box) {
  const auto first = [](std::int32_t v) { return v >> kStepBits << kStepBits; };
  const auto last = [&](std::int32_t v) { return first(v) + (1 << kStepBits) - 1; };
  return {first(box.xmin), first(box.ymin), last(box.xmax), last(box.ymax)};
}

std::vector<GridBox> extents_of(std::span<const GridPoint> points) {
  std::vector<GridBox> boxes;
  boxes.reserve(points.size());
  for (const GridPoint& p : points) boxes.push_back({p.x, p.y, p.x, p.y});
  return boxes;
}

std::vector<GridBox> extents_of(std::span<const Segment> segments) {
  std::vector<GridBox> boxes;
  boxes.reserve(segments.size());
  for (const Segment& s : segments) boxes.push_back(extent_of(s));
  return boxes;
}

std::vector<std::uint8_t> encode_clusters(const Cell& cell, std::span<const GridBox> extents,
                                          const LeafClusters& clusters) {
  const std::vector<Written> boxes = written(clusters.boxes);
  const Steps corner = steps_to(cell), origin = origin_of(clusters.boxes);
  std::vector<std::uint8_t> out;
  put_varint(out, boxes.size());
  put_varint(out, zigzag(origin.x - corner.x));
  put_varint(out, zigzag(origin.y - corner.y));
  std::array<int, kNumbers> parameters{};
  for (std::size_t n = 0; n < kNumbers; ++n) {
    std::vector<std::uint64_t> values;
    for (const Written& w : boxes) values.push_back(w[n]);
    parameters[n] = best_rice_parameter(values);
    put_varint(out, static_cast<std::uint64_t>(parameters[n]));
  }
  BitWriter bits(out);
  for (const Written& w : boxes)
    for (std::size_t n = 0; n < kNumbers; ++n) bits.rice(w[n], parameters[n]);
  Candidates candidates(clusters.boxes);
  Candidates::Numbers own, latest;
  auto next = clusters.items.begin();
  for (std::uint32_t i = 0; i < extents.size(); ++i, latest = own) {
    own.clear();
    for (; next != clusters.items.end() && next->item == i; ++next) own.push_back(next->cluster);
    const Candidates::Numbers& met = candidates.of(extents[i]);
    if (!candidates.allow(own)) throw std::invalid_argument("an item lies outside of its cluster");
    if (met.size() == 1) continue;
    bits.bits(own == latest ? 1 : 0, 1);
    if (own == latest) continue;
    for (const std::uint32_t b : met) bits.bits(std::binary_search(own.begin(), own.end(), b) ? 1 : 0, 1);
  }
  bits.finish();
  return out;
}

LeafClusters decode_clusters(const Cell& cell, std::span<const GridBox> extents, std::span<const std::uint8_t> bytes) {
  return ClusterReader(cell, bytes).read(extents);
}

}  // namespace itin
