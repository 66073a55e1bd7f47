#include <atomic>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/verify.hpp>

#include "verify/certificates.hpp"
#include "verify/feature_heights.hpp"
#include "verify/tiling.hpp"

namespace itin {

namespace {

/// The points of a tile: enough to keep borders few, and few enough that a surface fits into the processor's cache.
constexpr double kPointsPerVerifiedTile = 1 << 15;

class Verifying {
 public:
  Verifying(const Store& store, const VerifyOptions& options, Progress& progress)
      : store_(store), options_(options), progress_(progress) {}

  Verification run() {
    const StoreMetadata& metadata = store_.metadata();
    result_.damage = false_levels(file_of(store_));
    const std::vector<Selection> levels = selections_of_levels(metadata);
    const std::size_t parts = metadata.parts.size();
    progress_.step(parts > 0 ? 0.7 : 1);
    verify(
        "verifying certificates", "the terrain", tiles_of_ground(),
        [&](const Cell& tile) { return false_certificates(file_of(store_), levels, tile); },
        [&](const FalseCell& cell) { return false_certificate(cell, metadata.grid); });
    for (std::size_t p = 0; p < parts; ++p) {
      progress_.step(1 / static_cast<double>(parts - p));
      const PartHeights part(store_, p);
      verify(
          "verifying heights of features",
          fmt::format("theme '{}'", metadata.themes[metadata.parts[p].theme - std::size_t{1}].name), part.tiles(),
          [&](const Cell& tile) { return part.higher_in(tile); },
          [&](const FalseCell& cell) { return part.higher(cell); });
    }
    progress_.finish();
    return std::move(result_);
  }

 private:
  std::vector<Cell> tiles_of_ground() const {
    const Grid& grid = store_.metadata().grid;
    const GridBox bounds = store_.metadata().bounds;
    const auto points = [&](const Cell& cell) {
      const GridBox box = intersection(cell.box(), bounds);
      return box.empty() ? 0.0 : static_cast<double>(store_.points_about(0, grid.box(box)));
    };
    std::vector<Cell> tiles = tiles_of(points, kPointsPerVerifiedTile);
    std::erase_if(tiles, [&](const Cell& cell) { return !cell.box().meets(bounds); });
    return tiles;
  }

  void verify(const std::string& stage, const std::string& what, const std::vector<Cell>& all,
              const std::function<std::vector<FalseCell>(const Cell&)>& in_tile,
              const std::function<Damage(const FalseCell&)>& described) {
    const std::vector<Cell> tiles = sample_of(all, options_.sample);
    result_.tiles += all.size(), result_.tiles_verified += tiles.size();
    std::vector<std::vector<FalseCell>> found(tiles.size());
    std::vector<std::string> without_surface(tiles.size());
    std::atomic<std::size_t> done = 0;
    parallel_for(tiles.size(), [&](std::size_t i) {
      progress_.throw_if_cancelled();
      try {
        found[i] = in_tile(tiles[i]);
      } catch (const FileError&) {
        throw;
      } catch (const Error& error) {  // a store may be too broken for a surface
        without_surface[i] = error.what();
      }
      progress_.report(stage, static_cast<double>(++done) / static_cast<double>(tiles.size()));
    });
    std::vector<FalseCell> together;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      together.insert(together.end(), found[i].begin(), found[i].end());
      if (!without_surface[i].empty()) result_.damage.push_back({what, "has no surface: " + without_surface[i]});
    }
    for (const FalseCell& cell : merged(together)) result_.damage.push_back(described(cell));
  }

  const Store& store_;
  const VerifyOptions& options_;
  CallProgress progress_;
  Verification result_;
};

}  // namespace

Verification verify(const Store& store, const VerifyOptions& options, Progress& progress) {
  return Verifying(store, options, progress).run();
}

}  // namespace itin
