#include "features/mask_index.hpp"

#include <algorithm>
#include <unordered_set>

namespace itin {

namespace {

constexpr std::int64_t kOffset = std::int64_t{1} << 30;

/// By the even-odd rule about a position in doubled coordinates, which must not lie on the border.
bool encloses(const GridPolygon& polygon, std::int64_t x, std::int64_t y) {
  bool inside = false;
  for_each_edge(polygon, [&](Position a, Position b) {
    const std::int64_t ax = 2 * std::int64_t{a.x}, ay = 2 * std::int64_t{a.y}, bx = 2 * std::int64_t{b.x},
                       by = 2 * std::int64_t{b.y};
    if ((ay > y) == (by > y)) return;
    const double at = static_cast<double>(ax) +
                      static_cast<double>(y - ay) * static_cast<double>(bx - ax) / static_cast<double>(by - ay);
    if (static_cast<double>(x) < at) inside = !inside;
  });
  return inside;
}

}  // namespace

GridBox box_about(const GridPolygon& polygon) {
  GridBox box;
  for (const Position& p : polygon.outline) box.extend(p.x, p.y);
  return box;
}

MaskIndex::MaskIndex(std::span<const GridPolygon> polygons) : polygons_(polygons) {
  double sum = 0, longest = 0;
  for (const GridPolygon& polygon : polygons) {
    const GridBox box = box_about(polygon);
    const double side = std::max(1.0 * box.xmax - box.xmin, 1.0 * box.ymax - box.ymin);
    sum += side;
    longest = std::max(longest, side);
  }
  if (!polygons.empty())
    side_ = std::max({side_, static_cast<std::int64_t>(sum / static_cast<double>(polygons.size())) / 4,
                      static_cast<std::int64_t>(longest) / 512});
  for (std::uint32_t i = 0; i < polygons.size(); ++i) add(i);
}

std::uint64_t MaskIndex::bucket(std::int64_t x, std::int64_t y) const {
  return static_cast<std::uint64_t>((x + kOffset) / side_) << 32 | static_cast<std::uint64_t>((y + kOffset) / side_);
}

void MaskIndex::add(std::uint32_t number) {
  const GridPolygon& polygon = polygons_[number];
  std::unordered_set<std::uint64_t> mixed;
  for_each_edge(polygon, [&](Position a, Position b) {
    const auto [xmin, xmax] = std::minmax(a.x, b.x);
    const auto [ymin, ymax] = std::minmax(a.y, b.y);
    for (std::int64_t i = (xmin + kOffset) / side_; i <= (xmax + kOffset) / side_; ++i)
      for (std::int64_t j = (ymin + kOffset) / side_; j <= (ymax + kOffset) / side_; ++j)
        mixed.insert(static_cast<std::uint64_t>(i) << 32 | static_cast<std::uint64_t>(j));
  });
  const GridBox box = box_about(polygon);
  for (std::int64_t i = (box.xmin + kOffset) / side_; i <= (box.xmax + kOffset) / side_; ++i) {
    for (std::int64_t j = (box.ymin + kOffset) / side_; j <= (box.ymax + kOffset) / side_; ++j) {
      const std::uint64_t key = static_cast<std::uint64_t>(i) << 32 | static_cast<std::uint64_t>(j);
      if (mixed.contains(key)) {
        buckets_[key].push_back({number, false});
      } else if (encloses(polygon, 2 * (i * side_ - kOffset) + 1, 2 * (j * side_ - kOffset) + 1)) {
        buckets_[key].push_back({number, true});
      }
    }
  }
}

const std::vector<MaskIndex::Entry>* MaskIndex::entries(std::int64_t x, std::int64_t y) const {
  const auto found = buckets_.find(bucket(x, y));
  return found == buckets_.end() ? nullptr : &found->second;
}

std::optional<std::uint32_t> MaskIndex::at(Position p) const {
  if (const auto* near = entries(p.x, p.y)) {
    for (const Entry& e : *near)
      if (e.whole || side_of(polygons_[e.polygon], p) != Side::outside) return e.polygon;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> MaskIndex::about_middle(Position a, Position b) const {
  const std::int64_t x = std::int64_t{a.x} + b.x, y = std::int64_t{a.y} + b.y;
  if (const auto* near = entries(x >> 1, y >> 1)) {
    for (const Entry& e : *near)
      if (e.whole || encloses(polygons_[e.polygon], x, y)) return e.polygon;
  }
  return std::nullopt;
}

}  // namespace itin
