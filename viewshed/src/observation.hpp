// What a mode keeps of the looks at a tile's cells.
//
//   const std::unique_ptr<Observation> observation = observation_for(request);     // of one tile
//   observation->enter(cell);                                                      // in some field of view
//   if (observation->open(look)) ... observation->see(look);                       // or nothing, where it is hidden
//   observation->store(tile, result);
//
// The result does not depend on the order of the looks.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <viewshed/viewshed.hpp>

#include "scene.hpp"
#include "sight_lines.hpp"
#include "surface_heights.hpp"

namespace itin::viewshed {

/// An observer's look at the target in a cell.
struct Look {
  std::size_t cell = 0;              ///< in the tile
  std::uint32_t observer = 0;        ///< from 0
  double dx = 0, dy = 0, dz = 0;     ///< metres from the eye to the target
  double squared_distance() const { return dx * dx + dy * dy; }
};

/// Looks whose lines are to be cast.
struct LookPacket {
  SightLines lines;
  std::array<Look, SightLines::kSize> looks;
};

class Observation {
 public:
  Observation() { values_.fill(kOutside); }
  virtual ~Observation() = default;
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

  /// The cell is in an observer's field of view.
  void enter(std::size_t cell) {
    if (values_[cell] == kOutside) values_[cell] = kHidden;
  }
  /// Whether it could matter that the target is seen.
  virtual bool open(const Look&) const { return true; }
  /// The target is seen.
  void see(const Look& look) {
    values_[look.cell] = kVisible;
    keep(look);
  }
  /// Sees what the scene does not hide.
  void judge(const LookPacket& packet, const Scene& scene, Occluder& occluder);
  /// Counts the cells, and writes them to their places in the result.
  void store(const Tile& tile, Result& result, CellCounts& cells) const;

  /// Makes room in the result for what store() writes.
  static void prepare(Result& result);

 protected:
  std::uint8_t value(std::size_t cell) const { return values_[cell]; }

 private:
  virtual void keep(const Look&) {}
  /// A row of `columns` cells, from `cell` in the tile to `place` in the grid.
  virtual void store_row(std::size_t, std::size_t, std::size_t, Result&) const {}

  TileValues<std::uint8_t> values_;  ///< kOutside, kHidden, kVisible
};

/// For the request's mode, which is not kCertified.
std::unique_ptr<Observation> observation_for(const Request& request);

}  // namespace itin::viewshed
