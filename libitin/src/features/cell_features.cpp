#include "features/cell_features.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>

#include "features/cell_patches.hpp"
#include "features/ground_coverage.hpp"
#include "features/mesh/terrain_heights.hpp"

namespace itin {

namespace {

constexpr double kMillimetres = 1000;  ///< per metre
/// Bytes that raising patches takes for each of their corners; measured, rounded up.
constexpr std::uint64_t kBytesPerCorner = 2000;
constexpr std::size_t kPortion = 64;  ///< parts of rasters that are cut at once

/// A part of a raster on the ground about it.
class CellsOnGround {
 public:
  CellsOnGround(const Store& ground, const HeightCells& cells, const Progress& progress)
      : cells_(cells), grid_(ground.metadata().grid) {
    GridBox box;
    for (const GridPolygon& cell : {square(0, 0), square(cells.columns - 1, cells.rows - 1),
                                    square(cells.columns - 1, 0), square(0, cells.rows - 1)})
      for (const Position& p : cell.outline) box.extend(p.x - 1, p.y - 1), box.extend(p.x + 1, p.y + 1);
    SilentProgress quiet(progress);
    tin_ = triangulate(ground, Window::box(grid_.box(box)), Detail::tolerance(0), quiet, ThemeChoice::none());
    terrain_.emplace(tin_);
    outline_ = outline_near(ground, box);
    whole_ = outline_.empty() && terrain_->height_at(square(0, 0).outline.front());
  }

  /// Returns the number of steps of each cell, row by row.
  std::vector<std::int32_t> steps() {
    std::vector<std::int32_t> steps;
    steps.reserve(cells_.heights.size());
    for (std::int32_t row = 0; row < cells_.rows; ++row)
      for (std::int32_t column = 0; column < cells_.columns; ++column) steps.push_back(steps_at(column, row));
    return steps;
  }
  std::uint64_t beyond() const { return beyond_; }

 private:
  Position at(double column, double row) const {
    const Point2 p = cells_.corner_at(column, row);
    const GridPoint q = grid_.quantise({p.x, p.y, 0});
    return {q.x, q.y};
  }
  GridPolygon square(std::int32_t column, std::int32_t row) const {
    GridRing ring{at(column, row), at(column, row + 1), at(column + 1, row + 1), at(column + 1, row)};
    if (orientation(ring[0], ring[1], ring[2]) < 0) std::reverse(ring.begin(), ring.end());
    return {std::move(ring), {}};
  }

  std::int32_t steps_at(std::int32_t column, std::int32_t row) {
    const std::int32_t height =
        cells_.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_.columns) +
                       static_cast<std::size_t>(column)];
    if (height == kNoHeight) return 0;
    const std::optional<double> ground =
        cells_.absolute ? terrain_->height_at(at(column + 0.5, row + 0.5)) : std::optional<double>(0);
    const std::int32_t steps = ground ? steps_of(height - std::llround(*ground * kMillimetres), cells_) : 0;
    const bool stands = whole_ || (ground && steps > 0 && lies_on_ground(square(column, row), outline_, *terrain_));
    if (!stands && (!ground || steps > 0)) ++beyond_;
    return stands ? steps : 0;
  }

  const HeightCells& cells_;
  Grid grid_;
  Tin tin_;
  std::optional<TerrainHeights> terrain_;
  std::vector<Segment> outline_;
  bool whole_ = false;  ///< all of it is ground
  std::uint64_t beyond_ = 0;
};

/// What became of a part of a raster.
struct CutPart {
  std::vector<StoredFootprint> footprints;
  std::uint64_t corners = 0, beyond = 0;
};

CutPart cut(const Store& ground, const StoredFootprint& part, const Progress& progress) {
  const HeightCells& cells = *part.feature.cells;
  CellsOnGround on_ground(ground, cells, progress);
  CutPart result;
  for (CellPatch& patch : patches_of(cells, on_ground.steps())) {
    StoredFootprint& made = result.footprints.emplace_back();
    made.source = part.source;
    const Point2 place = patch.rings.front().front();
    made.feature.name = fmt::format("{} at {:.1f} {:.1f}", part.feature.name, place.x, place.y);
    made.feature.kind = FeatureKind::vegetation;
    made.feature.rings = std::move(patch.rings);
    made.feature.height = patch.steps * (cells.step / kMillimetres);
    result.corners += vertex_count(made.feature);
  }
  result.beyond = on_ground.beyond();
  return result;
}

std::string metres(std::int32_t millimetres) {
  return fmt::format("{:g} m", millimetres / kMillimetres);
}

void require_room_for(const StoredFootprint& part, std::uint64_t patches, std::uint64_t corners,
                      std::uint64_t memory_bytes) {
  if (corners <= memory_bytes / kBytesPerCorner) return;
  throw InputError(
      fmt::format(
          "{}: its cells make more than {} patches of equal height with {} corners, for which {} MB of memory are too "
          "little; raise `height_step` (it is {}) or `height_threshold` ({}), give more `memory_bytes`, or import a "
          "part "
          "of it",
          part.feature.name, patches, corners, memory_bytes >> 20, metres(part.feature.cells->step),
          metres(part.feature.cells->threshold)),
      "memory_bytes");
}

}  // namespace

CellFeatures with_patches(const Store& ground, std::span<const StoredFootprint> footprints, std::uint64_t memory_bytes,
                          const Progress& progress) {
  CellFeatures result;
  result.any = std::any_of(footprints.begin(), footprints.end(),
                           [](const StoredFootprint& f) { return f.feature.cells.has_value(); });
  if (!result.any) return result;
  std::map<std::pair<std::uint16_t, std::string>, std::uint64_t> beyond;
  std::uint64_t patches = 0, corners = 0;
  // Rasters are cut in portions, so that one which makes too many patches is refused before it has made them all.
  for (std::size_t first = 0; first < footprints.size(); first += kPortion) {
    const auto some = footprints.subspan(first, std::min(kPortion, footprints.size() - first));
    std::vector<CutPart> parts(some.size());
    parallel_for(some.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      if (some[i].feature.cells)
        parts[i] = cut(ground, some[i], progress);
      else
        parts[i].footprints.push_back(some[i]);
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      patches += parts[i].footprints.size(), corners += parts[i].corners;
      if (some[i].feature.cells) require_room_for(some[i], patches, corners, memory_bytes);
      if (parts[i].beyond > 0) beyond[{some[i].source, some[i].feature.name}] += parts[i].beyond;
      result.is_patch.resize(result.footprints.size() + parts[i].footprints.size(), some[i].feature.cells.has_value());
      std::move(parts[i].footprints.begin(), parts[i].footprints.end(), std::back_inserter(result.footprints));
    }
  }
  for (const auto& [of, count] : beyond)
    result.reports.push_back(
        {of.first, fmt::format("{}: {} left out: beyond the ground", of.second, counted(count, "cell"))});
  return result;
}

}  // namespace itin
