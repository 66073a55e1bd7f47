// What a mode keeps of the looks at a tile's cells.
//
//   const Observations observations(request, eyes, tin, scene);
//   const std::unique_ptr<Observation> observation = observations.of_tile();
//   observation->enter(cell);                                                      // in some field of view
//   if (observation->open(look)) ... observation->see(look);                       // or nothing, where it is hidden
//   observation->store(tile, result, cells);
//
// The result does not depend on the order of the looks.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <viewshed/viewshed.hpp>

#include "eye.hpp"
#include "first_blocker.hpp"
#include "least_height.hpp"
#include "scene.hpp"
#include "sight_lines.hpp"
#include "surface_heights.hpp"
#include "vertical_odds.hpp"

namespace itin::viewshed {

/// An observer's look at the target in a cell.
struct Look {
  std::size_t cell = 0;           ///< in the tile
  std::uint32_t observer = 0;     ///< from 0
  double dx = 0, dy = 0, dz = 0;  ///< metres from the eye to the target
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
  /// The elevation of what is looked at, over ground of this one, metres.
  virtual double target(const Eye& eye, double ground) const { return eye.target(ground); }
  /// Whether the target is in the eye's field of view.
  virtual bool in_view(const Eye& eye, const Look& look) const { return eye.view.contains(look.dx, look.dy, look.dz); }
  /// Whether it could matter that the target is seen.
  virtual bool open(const Look&) const { return true; }
  /// The target is seen.
  void see(const Look& look) {
    mark_visible(look.cell);
    keep(look);
  }
  /// Sees what the scene does not hide.
  virtual void judge(const LookPacket& packet, const Scene& scene, Occluder& occluder);
  /// Counts the cells, and writes them to their places in the result.
  void store(const Tile& tile, Result& result, CellCounts& cells) const;

  /// Makes room in the result for what store() writes.
  static void prepare(Result& result);

 protected:
  std::uint8_t value(std::size_t cell) const { return values_[cell]; }
  void mark_visible(std::size_t cell) { values_[cell] = kVisible; }

 private:
  virtual void keep(const Look&) {}
  /// A row of `columns` cells, from `cell` in the tile to `place` in the grid.
  virtual void store_row(std::size_t, std::size_t, std::size_t, Result&) const {}

  TileValues<std::uint8_t> values_;  ///< kOutside, kHidden, kVisible
};

/// Makes the Observations of a request's mode, which is not kCertified. All that it is given must outlive it and them.
class Observations {
 public:
  /// For modes that need no more than verdicts: kVisible, kCount, kWhich, kNearest.
  explicit Observations(const Request& request) : request_(request) {}
  /// For every mode; the scene is of that Tin.
  Observations(const Request& request, const std::vector<Eye>& eyes, const Tin& tin, const Scene& scene);

  std::unique_ptr<Observation> of_tile() const;

 private:
  const Request& request_;
  const std::vector<Eye>* eyes_ = nullptr;
  double resolution_ = 0;
  std::optional<LeastHeights> heights_;
  std::optional<FirstBlocker> blockers_;
  std::optional<VerticalOdds> odds_;
};

}  // namespace itin::viewshed
