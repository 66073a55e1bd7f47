#include "plan/sight_sectors.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <itin/error.hpp>

#include "line/hulls.hpp"
#include "plan/azimuth_order.hpp"
#include "plan/partition.hpp"

namespace itin::viewshed {

namespace {

/// How many cells the boxes have along their side at first: the sectors of wider boxes overlap more, and each smaller
/// box is looked at with many others anyway.
constexpr std::int64_t kFirstSide = 16;
static_assert(Tile::kSide % kFirstSide == 0);

}  // namespace

/// Sorts the boxes by rings of doubling distances, since nearer cells span wide sectors.
SightSectors::SightSectors(const RasterGrid& cells, const Eye& eye) : cells_(cells), eye_(eye) {
  struct Place {
    int ring;
    double azimuth;
    Tile part;
  };
  std::vector<Place> places;
  for (std::int64_t row = 0; row < cells.rows(); row += kFirstSide) {
    for (std::int64_t column = 0; column < cells.columns(); column += kFirstSide) {
      const Tile part{column, row, std::min(kFirstSide, cells.columns() - column),
                      std::min(kFirstSide, cells.rows() - row)};
      const Box box = box_of(cells, part);
      const double squared = squared_distance(eye.position, box);
      if (!eye.view.reaches(squared)) continue;
      const int ring = std::ilogb(std::max(1.0, std::sqrt(squared) / (Tile::kSide * cells.cell_width())));
      places.push_back({ring, azimuth(eye.position, middle_of(box)), part});
    }
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.ring, a.azimuth, a.part.row, a.part.column) >
           std::tie(b.ring, b.azimuth, b.part.row, b.part.column);
  });
  for (const Place& place : places) parts_.push_back(place.part);
  most_ = parts_.size();
}

SightSectors::Sector SightSectors::next(const Fits& fits) const {
  const auto with = [&](std::vector<Point2> hull, std::size_t i) {
    add_corners(box_of(cells_, parts_[parts_.size() - i - 1]), hull);
    return hull_of(std::move(hull));
  };
  auto run = longest_run(most_, std::vector<Point2>{eye_.position}, with, fits);
  return {std::span(parts_).last(run.count), std::move(run.sum)};
}

bool SightSectors::within(double reach, const Tile& part) const {
  const Box box = box_of(cells_, part);
  return std::max({box.xmax - eye_.position.x, eye_.position.x - box.xmin, box.ymax - eye_.position.y,
                   eye_.position.y - box.ymin}) < reach;
}

void SightSectors::remove_decided(const Sector& sector, double reach) {
  const std::size_t count = sector.parts.size(), after = parts_.size() - count;
  const auto decided = [&](const Tile& part) { return within(reach, part); };
  parts_.erase(std::remove_if(parts_.begin() + static_cast<std::ptrdiff_t>(after), parts_.end(), decided),
               parts_.end());
  const std::size_t left = parts_.size() - after;
  if (count == 1 && left == 1) divide_next();
  most_ = left == 0 ? parts_.size() : std::max<std::size_t>(1, left / 2);
}

void SightSectors::divide_next() {
  if (parts_.back().columns * parts_.back().rows == 1)
    throw InputError("the sight line to a single cell does not fit into the memory: give more `memory_bytes`",
                     "memory_bytes");
  const auto [first, rest] = halves(parts_.back());
  parts_.back() = rest;
  parts_.push_back(first);
}

}  // namespace itin::viewshed
