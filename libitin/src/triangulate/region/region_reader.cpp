#include "triangulate/region/region_reader.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "base/stoppable.hpp"
#include "triangulate/apex/merge_runs.hpp"

namespace itin {

double area(const GridBox& b) {
  return b.empty() ? 0 : (1.0 + b.xmax - b.xmin) * (1.0 + b.ymax - b.ymin);
}

bool meets(Position p, Position q, const GridBox& box) {
  if (box.contains(p.x, p.y) || box.contains(q.x, q.y)) return true;
  if (!box.meets({std::min(p.x, q.x), std::min(p.y, q.y), std::max(p.x, q.x), std::max(p.y, q.y)})) return false;
  bool left = false, right = false;
  for (const Position c : {Position{box.xmin, box.ymin}, Position{box.xmax, box.ymin}, Position{box.xmin, box.ymax},
                           Position{box.xmax, box.ymax}}) {
    const int side = orientation(p, q, c);
    left |= side >= 0;
    right |= side <= 0;
  }
  return left && right;
}

std::vector<Leaf> RegionReader::leaves_in(const GridBox& box) const {
  std::vector<Leaf> leaves;
  selected_leaves(index_, selection_, box, leaves);
  return leaves;
}

double RegionReader::points_of(const std::vector<Leaf>& leaves, const GridBox& box) {
  return std::accumulate(leaves.begin(), leaves.end(), 0.0, [&](double sum, const Leaf& leaf) {
    return sum + leaf.asked * area(intersection(leaf.cell.box(), box)) / area(leaf.cell.box());
  });
}

void RegionReader::start(const GridBox& box, std::span<const Leaf> leaves, const GridBox& box_of_leaves) {
  std::vector<Coded> found = points(box);
  for (const Leaf& leaf : leaves) read_block(leaf, box_of_leaves, found);
  merge_runs(found, [](const Coded& a, const Coded& b) { return a.first < b.first; });
  // Themes may share a vertex, and a leaf may be read twice.
  found.erase(
      std::unique(found.begin(), found.end(), [](const Coded& a, const Coded& b) { return a.first == b.first; }),
      found.end());
  vertices_.clear();
  vertices_.reserve(found.size());
  codes_.clear();
  codes_.reserve(found.size());
  for (const auto& [code, vertex] : found) {
    vertices_.push_back(vertex);
    codes_.push_back(code);
  }
  others_.clear();
  bare_.clear();
  segments_.clear();
}

std::vector<RegionReader::Coded> RegionReader::points(const GridBox& box) {
  std::vector<Coded> found;
  for (const Leaf& leaf : leaves_in(box)) read_block(leaf, box, found);
  return found;
}

void RegionReader::read_block(const Leaf& leaf, const GridBox& box, std::vector<Coded>& found) {
  stop_if_asked();
  const auto block = index_.block(leaf);
  statistics_.points_read += block->points.size();
  statistics_.blocks_read += 1;
  for (std::size_t k = 0; k < block->points.size(); ++k) {
    const GridPoint& p = block->points[k];
    if (!box.contains(p.x, p.y)) continue;
    const std::uint8_t level = level_of(leaf, *block, k);
    if (selection_.selects(leaf, level, p.x, p.y))
      found.push_back({code_of(p), {p, block->sources[k], level, block->theme(k)}});
  }
}

std::vector<Segment> RegionReader::fresh_segments(const GridBox& box) {
  std::vector<Segment> found, fresh;
  index_.segments(box, found);
  for (const Segment& s : found) {
    if (meets(s.a(), s.b(), box) && selection_.selects(s) && segments_.insert(s).second) fresh.push_back(s);
  }
  return fresh;
}

RegionReader::Numbered RegionReader::number_of(const SelectedVertex& vertex) {
  return number_of(vertex, true);
}
RegionReader::Numbered RegionReader::number_of(Position end) {
  return number_of({{end.x, end.y, 0}, 0, 0, 0}, false);
}

RegionReader::Numbered RegionReader::number_of(const SelectedVertex& vertex, bool whole) {
  const std::uint64_t code = code_of(vertex);
  const auto at = std::lower_bound(codes_.begin(), codes_.end(), code);
  if (at != codes_.end() && *at == code) return {static_cast<std::uint32_t>(at - codes_.begin()), false};
  const auto [other, fresh] = others_.try_emplace(code, static_cast<std::uint32_t>(vertices_.size()));
  const std::uint32_t number = other->second;
  if (fresh) vertices_.push_back(vertex);
  if (whole) {
    vertices_[number] = vertex;
    bare_.erase(number);
  } else if (fresh) {
    bare_.insert(number);
  }
  return {number, fresh};
}

void RegionReader::complete(std::uint32_t vertex, ApexSearch& search) {
  if (vertex < in_order() || !bare_.contains(vertex)) return;
  const Position p = vertices_[vertex].position();
  const auto found = search.at(p);
  if (!found) {
    throw Error(fmt::format(
        "an end of a constraint line at grid position {}, {} is not among the vertices; run itin check on the store",
        p.x, p.y));
  }
  vertices_[vertex] = *found;
  bare_.erase(vertex);
}

}  // namespace itin
