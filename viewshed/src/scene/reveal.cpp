#include "scene/reveal.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <itin/grid_units.hpp>
#include <itin/lattice_reader.hpp>
#include <itin/parallel.hpp>

#include "line/infinity.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

namespace {

using Tiles = std::vector<std::uint32_t>;

constexpr std::size_t kManyObservers = 8;
/// Tiles among so few posts are too coarse to be hidden: that costs a quarter more than it saves.
constexpr std::uint64_t kPostsWorthRevealing = 6000000;

/// A tile of the lattice, in bins.
BinBox box_of(const LatticeTin& lattice, std::uint32_t tile) {
  const std::uint32_t column = tile % lattice.tile_columns() * LatticeTin::kSide,
                      row = tile / lattice.tile_columns() * LatticeTin::kSide;
  const double west = column, north = row;
  return {west, north, west + LatticeTin::kSide, north + LatticeTin::kSide};
}

bool unread(const LatticeTin::Tile& tile) {
  return tile.ground != LatticeTin::Ground::kNone && !tile.heights;
}

void read(const Tiles& tiles, LatticeReader& reader, ExactScene& surface, Progress& progress) {
  if (tiles.empty()) return;
  reader.read(tiles, progress);
  surface.add(tiles);
}

}  // namespace

Revealed reveal(const Eye& eye, LatticeReader& reader, ExactScene& surface, std::uint64_t most_tiles,
                Progress& progress) {
  const LatticeTin& lattice = reader.lattice();
  RadialSweep::View view = surface.begin_view(eye);
  std::vector<std::pair<double, std::uint32_t>> left;  // the nearest last
  std::vector<BinBox> boxes;
  for (std::uint32_t t = 0; t < lattice.tiles.size(); ++t) {
    const BinBox box = box_of(lattice, t);
    if (lattice.tiles[t].ground == LatticeTin::Ground::kNone || !view.reaches(box)) continue;
    boxes.push_back(box);
    if (unread(lattice.tiles[t])) left.emplace_back(view.distance(box), t);
  }
  std::sort(left.begin(), left.end(), std::greater<>());
  view.narrow(boxes);
  const double resolution = lattice.grid.resolution;
  // Each tile comes after the tiles before it.
  for (double reach = 0; !left.empty(); reach += LatticeTin::kSide) {
    progress.throw_if_cancelled();
    view.advance(reach, progress);
    Tiles near;
    for (; !left.empty() && left.back().first < reach + LatticeTin::kSide; left.pop_back())
      near.push_back(left.back().second);
    std::vector<std::uint8_t> hidden(near.size());
    parallel_for(near.size(), [&](std::size_t i) {
      // Ground that is not hidden itself may hide what lies beyond, however low its targets are.
      const double ground = reader.highest(near[i]) * resolution;
      const double highest = std::max(ground, eye.target(ground)) / resolution;
      hidden[i] = view.hides(box_of(lattice, near[i]), highest) ? 1 : 0;
    });
    Tiles wanted;
    for (std::size_t i = 0; i < near.size(); ++i)
      if (hidden[i] == 0) wanted.push_back(near[i]);
    if (wanted.size() > most_tiles) return {std::move(view), reach};
    most_tiles -= wanted.size();
    read(wanted, reader, surface, progress);
  }
  constexpr double kAll = kInfinity;
  view.advance(kAll, progress);
  return {std::move(view), kAll};
}

bool asks_for_all_heights(const Request& request) {
  return request.mode == Mode::kHeight || bounds_elevations(request);
}

LatticeReader::Heights heights_for(const Request& request, std::uint64_t posts) {
  const bool all =
      asks_for_all_heights(request) || request.observers.size() >= kManyObservers || posts < kPostsWorthRevealing;
  return all ? LatticeReader::Heights::kAll : LatticeReader::Heights::kNone;
}

bool all_read(const LatticeReader& reader) {
  return std::none_of(reader.lattice().tiles.begin(), reader.lattice().tiles.end(), unread);
}

void reveal_place(Point2 position, LatticeReader& reader, ExactScene& surface, Progress& progress) {
  const LatticeTin& lattice = reader.lattice();
  const double column = (easting_in_units(lattice.grid, position.x) - lattice.west) / lattice.spacing,
               row = (lattice.north - northing_in_units(lattice.grid, position.y)) / lattice.spacing;
  Tiles about;
  for (std::uint32_t t = 0; t < lattice.tiles.size(); ++t) {
    const BinBox box = box_of(lattice, t);
    if (unread(lattice.tiles[t]) && column > box.west - 1 && column < box.east + 1 && row > box.north - 1 &&
        row < box.south + 1)
      about.push_back(t);
  }
  read(about, reader, surface, progress);
}

}  // namespace itin::viewshed
