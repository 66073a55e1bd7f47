#include "features/plan/mask_index.hpp"

#include <algorithm>
#include <cmath>

#include <itin/box_of.hpp>

namespace itin {

namespace {

constexpr std::int64_t kOffset = std::int64_t{1} << 30;

}  // namespace

GridBox box_about(const GridPolygon& polygon) {
  return box_of(polygon.outline);
}

MaskIndex::MaskIndex(std::span<const GridPolygon> polygons) {
  double sum = 0, longest = 0;
  polygons_.reserve(polygons.size());
  for (const GridPolygon& polygon : polygons) {
    polygons_.emplace_back(polygon);
    const GridBox box = box_about(polygon);
    const double side = std::max(1.0 * box.xmax - box.xmin, 1.0 * box.ymax - box.ymin);
    sum += side;
    longest = std::max(longest, side);
  }
  if (!polygons.empty())
    side_ = std::max({side_, static_cast<std::int64_t>(sum / static_cast<double>(polygons.size())),
                      static_cast<std::int64_t>(longest) / 512});
  for (std::uint32_t i = 0; i < polygons.size(); ++i) add(i, box_about(polygons[i]));
}

std::uint64_t MaskIndex::bucket(std::int64_t x, std::int64_t y) const {
  return static_cast<std::uint64_t>((x + kOffset) / side_) << 32 | static_cast<std::uint64_t>((y + kOffset) / side_);
}

void MaskIndex::add(std::uint32_t number, const GridBox& box) {
  for (std::int64_t i = (box.xmin + kOffset) / side_; i <= (box.xmax + kOffset) / side_; ++i)
    for (std::int64_t j = (box.ymin + kOffset) / side_; j <= (box.ymax + kOffset) / side_; ++j)
      buckets_[static_cast<std::uint64_t>(i) << 32 | static_cast<std::uint64_t>(j)].push_back(number);
}

template <class Test>
std::optional<std::uint32_t> MaskIndex::first_near(std::int64_t x, std::int64_t y, const Test& test) const {
  const auto found = buckets_.find(bucket(x, y));
  if (found == buckets_.end()) return std::nullopt;
  const std::vector<std::uint32_t>& near = found->second;
  const auto first = std::find_if(near.begin(), near.end(), [&](std::uint32_t i) { return test(polygons_[i]); });
  return first == near.end() ? std::nullopt : std::optional(*first);
}

std::optional<std::uint32_t> MaskIndex::at(Position p) const {
  return first_near(p.x, p.y, [&](const PolygonSides& polygon) { return polygon.at(p) != Side::outside; });
}

bool MaskIndex::strictly_inside(Position p) const {
  return first_near(p.x, p.y, [&](const PolygonSides& polygon) { return polygon.at(p) == Side::inside; }).has_value();
}

bool MaskIndex::encloses(Point2 p) const {
  return first_near(static_cast<std::int64_t>(std::floor(p.x)), static_cast<std::int64_t>(std::floor(p.y)),
                    [&](const PolygonSides& polygon) { return polygon.encloses(p); })
      .has_value();
}

std::optional<std::uint32_t> MaskIndex::about_middle(Position a, Position b) const {
  const std::int64_t x = std::int64_t{a.x} + b.x, y = std::int64_t{a.y} + b.y;
  return first_near(x >> 1, y >> 1, [&](const PolygonSides& polygon) { return polygon.encloses_middle(a, b); });
}

}  // namespace itin
