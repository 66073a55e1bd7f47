#include "verify/certificates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <itin/box_of.hpp>
#include <itin/grid_units.hpp>

#include "pyramid/difference/overlay.hpp"
#include "store/codec/store_format.hpp"
#include "verify/leaf_cover.hpp"

namespace itin {

namespace {

/// The greatest error of the slow comparison, grid units.
constexpr double kErrorRounding = 1e-3;

class TileVerification {
 public:
  TileVerification(const StoreFile& file, const std::vector<Selection>& levels, const Cell& tile)
      : file_(file), levels_(levels), fine_(triangulate_region(file, levels.front(), square_of(tile))), edges_(fine_) {}

  std::vector<FalseCell> run() {
    if (fine_.mesh.triangles.empty()) return {};
    compare(0, fine_, std::vector<DifferenceRange>(fine_.mesh.triangles.size(), {0, 0}));
    for (std::size_t k = 1; k < levels_.size(); ++k) {
      const RegionMesh coarse = triangulate_region(file_, levels_[k], box_of(fine_.vertices, &SelectedVertex::point));
      const Difference d = difference(fine_, edges_, coarse, std::numeric_limits<std::int32_t>::max());
      compare(static_cast<int>(k), coarse, over_triangles(fine_, edges_, d));
    }
    return std::move(found_);
  }

 private:
  /// Compares the fast way first: a certificate holds where it has room for the whole of each triangle that lies in its
  /// cell in part.
  void compare(int level, const RegionMesh& coarse, const std::vector<DifferenceRange>& of_triangles) {
    std::vector<Leaf> leaves;
    file_.leaves_of(level, box_of(fine_.vertices, &SelectedVertex::point), leaves);
    const LeafCover cover(std::move(leaves));
    std::vector<DifferenceRange> of_leaves(cover.leaves().size());
    std::optional<Cell> gap;
    for (std::uint32_t t = 0; t < of_triangles.size(); ++t) {
      cover.visit(
          fine_.corners(t), [&](std::size_t leaf) { of_leaves[leaf].add(of_triangles[t]); },
          [&](const Cell& cell) { gap = cell; });
    }
    if (gap) found_.push_back({level, std::nullopt, somewhere_in(*gap)});
    std::vector<std::uint8_t> in_doubt(of_leaves.size());
    for (std::size_t i = 0; i < of_leaves.size(); ++i)
      in_doubt[i] = of_leaves[i].lo < cover.leaves()[i].lo || of_leaves[i].hi > cover.leaves()[i].hi ? 1 : 0;
    if (std::find(in_doubt.begin(), in_doubt.end(), 1) != in_doubt.end()) refine(level, coarse, cover, in_doubt);
  }

  /// Checks certificates in doubt again, now only over those parts of triangles that lie in the cell.
  void refine(int level, const RegionMesh& coarse, const LeafCover& cover, const std::vector<std::uint8_t>& in_doubt) {
    const HeightDifference difference(coarse);
    std::vector<Extremes> of_leaves(in_doubt.size());
    const auto compare_in = [&](std::uint32_t t, std::size_t leaf) {
      if (in_doubt[leaf] != 0) difference.add(fine_, t, square_of(cover.leaves()[leaf].cell), of_leaves[leaf]);
    };
    for (std::uint32_t t = 0; t < fine_.mesh.triangles.size(); ++t)
      cover.visit(
          fine_.corners(t), [&](std::size_t leaf) { compare_in(t, leaf); }, [](const Cell&) {});
    for (std::size_t i = 0; i < of_leaves.size(); ++i) {
      const Leaf& leaf = cover.leaves()[i];
      if (of_leaves[i].lo < leaf.lo - kErrorRounding || of_leaves[i].hi > leaf.hi + kErrorRounding)
        found_.push_back({level, leaf, of_leaves[i]});
    }
  }

  static Extremes somewhere_in(const Cell& cell) {
    Extremes e;
    e.add(0, {static_cast<double>(cell.box().xmin), static_cast<double>(cell.box().ymin)});
    return e;
  }

  const StoreFile& file_;
  const std::vector<Selection>& levels_;
  RegionMesh fine_;
  FineEdges edges_;
  std::vector<FalseCell> found_;
};

}  // namespace

std::vector<Selection> selections_of_levels(const StoreMetadata& metadata) {
  std::vector<Selection> levels;
  for (const LevelInfo& level : metadata.levels)
    levels.push_back(selection_of(metadata, Detail::tolerance(level.tolerance), ThemeChoice::none()));
  return levels;
}

std::vector<FalseCell> false_certificates(const StoreFile& file, const std::vector<Selection>& levels,
                                          const Cell& tile) {
  return TileVerification(file, levels, tile).run();
}

Damage false_certificate(const FalseCell& cell, const Grid& grid) {
  if (!cell.leaf) {
    const Point2 at = place_in_metres(grid, cell.differs.highest);
    return {fmt::format("level {}", cell.tree),
            fmt::format("there is ground without a certificate at {:.2f},{:.2f}", at.x, at.y)};
  }
  const Leaf& leaf = *cell.leaf;
  const Point2 corner = grid.position(leaf.cell.box().xmin, leaf.cell.box().ymin);
  const double lo = std::min<double>(leaf.lo, std::floor(cell.differs.lo + kErrorRounding)),
               hi = std::max<double>(leaf.hi, std::ceil(cell.differs.hi - kErrorRounding));
  return {
      format::place("directory", leaf.key),
      fmt::format("the certificate of level {} for the {:.10g} m north-east of {:.2f},{:.2f} is {:.10g} to {:.10g} "
                  "m, and must be at least {:.10g} to {:.10g} m",
                  cell.tree, std::ldexp(grid.resolution, leaf.cell.log2_side), corner.x, corner.y,
                  leaf.lo * grid.resolution, leaf.hi * grid.resolution, lo * grid.resolution, hi * grid.resolution)};
}

std::vector<Damage> false_levels(const StoreFile& file) {
  std::vector<Damage> damage;
  const StoreMetadata& metadata = file.metadata();
  for (std::size_t k = 0; k < metadata.levels.size(); ++k) {
    const LevelInfo& level = metadata.levels[k];
    const double half = metadata.grid.resolution / 2;
    CertifiedError of_cells;
    file.for_each_leaf_of(static_cast<int>(k), [&](const Leaf& leaf) {
      of_cells.lo = std::min(of_cells.lo, leaf.lo * metadata.grid.resolution);
      of_cells.hi = std::max(of_cells.hi, leaf.hi * metadata.grid.resolution);
    });
    if (of_cells.lo < level.certified_error.lo - half || of_cells.hi > level.certified_error.hi + half)
      damage.push_back(
          {"metadata", fmt::format("the certified error of level {} is {:.10g} to {:.10g} m, and its "
                                   "cells say {:.10g} to {:.10g} m",
                                   k, level.certified_error.lo, level.certified_error.hi, of_cells.lo, of_cells.hi)});
    if (-level.certified_error.lo > level.tolerance + half || level.certified_error.hi > level.tolerance + half)
      damage.push_back(
          {"metadata", fmt::format("the certified error of level {}, {:.10g} to {:.10g} m, exceeds its "
                                   "tolerance of {:.10g} m",
                                   k, level.certified_error.lo, level.certified_error.hi, level.tolerance)});
  }
  return damage;
}

}  // namespace itin
