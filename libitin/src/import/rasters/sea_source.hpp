// The sea as a source of terrain: level posts wherever rasters have none, on the lattice of the coarsest of them.
//
//   SeaFill sea(level, {}, box, grid);
//   for (auto& source : sources) source = sea.watch(std::move(source));
//   sources.push_back(std::move(sea).source());  // read last
//
// The sea leaves out only posts that the watched sources have. Any other ground takes the place of the sea within its
// own coverage, whenever it is imported (pyramid/replacement.hpp); so the order of imports does not matter.
#pragma once

#include <memory>
#include <optional>

#include <itin/geometry.hpp>
#include <itin/window.hpp>

#include "import/source/terrain_source.hpp"

namespace itin {

class SeaFill {
 public:
  /// `level` is in metres. The sea lies within `area` or, if there is none, within `box`, in metres; it holds all that
  /// is to be filled.
  SeaFill(double level, const std::optional<Window>& area, const Box& box, const Grid& grid);
  ~SeaFill();

  /// Passes the source through. The source's posts are left out of the sea.
  std::unique_ptr<TerrainSource> watch(std::unique_ptr<TerrainSource> source);
  /// Returns the sea as a source. Reading it throws InputError where the sea would have more posts than a store can
  /// hold.
  std::unique_ptr<TerrainSource> source() &&;

 private:
  class Lattices;
  std::shared_ptr<Lattices> lattices_;
};

/// Returns the name that stands for the file of such a source: "sea at 0 m".
std::string sea_name(double level);

}  // namespace itin
