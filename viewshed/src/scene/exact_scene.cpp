#include "scene/exact_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <itin/grazing.hpp>
#include <itin/grid_units.hpp>
#include <itin/lattice_tin.hpp>
#include <itin/precondition.hpp>
#include <itin/sort_unique.hpp>

#include "line/infinity.hpp"
#include "line/set_bits.hpp"
#include "request/cells_in_view.hpp"

namespace itin::viewshed {

ExactScene::ExactScene(const Tin& surface, const Tin* bare_ground, const Earth& earth, const RasterGrid& grid,
                       const RasterGrid& tiles)
    : ExactScene(std::make_shared<BinnedHeights>(surface, grid.cell_area()), &surface, bare_ground, nullptr, earth,
                 grid, tiles) {}

ExactScene::ExactScene(const LatticeTin& surface, const Earth& earth, const RasterGrid& grid, const RasterGrid& tiles)
    : ExactScene(std::make_shared<BinnedHeights>(surface), nullptr, nullptr, nullptr, earth, grid, tiles) {}

ExactScene::ExactScene(std::shared_ptr<BinnedHeights> heights, const Tin* surface, const Tin* bare_ground,
                       const KeptGround* kept, const Earth& earth, const RasterGrid& grid, const RasterGrid& tiles)
    : surface_(surface),
      targets_on_(bare_ground != nullptr ? bare_ground : surface),
      kept_(kept),
      grid_(grid),
      tiles_(tiles),
      heights_(std::move(heights)),
      sweep_(earth, *heights_) {
  if (surface == nullptr || kept != nullptr) return;
  // Cells much smaller than triangles are filled triangle by triangle.
  const bool small = 2 * grid.cell_width() < heights_->bin_size() * units().resolution;
  if (bare_ground != nullptr || small || !heights_->partition()) of_tiles_.emplace(*targets_on_, tiles);
}

std::vector<BinBox> ExactScene::boxes_of_tiles() const {
  std::vector<BinBox> boxes(tiles_.cell_count());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    boxes[i] = heights_->in_bins(box_of_centres(grid_, tile_at(grid_, tiles_, i)));
  return boxes;
}

RadialSweep::View ExactScene::view_of_cells(const Eye& eye, const Progress& progress) const {
  if (rays_) return view_from(eye);
  RadialSweep::Axis axis = axis_of(eye);
  double farthest = 0;
  const Box cells = grid_.bounds();
  for (const Point2 corner : {Point2{cells.xmin, cells.ymin}, Point2{cells.xmax, cells.ymin},
                              Point2{cells.xmin, cells.ymax}, Point2{cells.xmax, cells.ymax}})
    farthest = std::max(farthest, std::hypot(corner.x - eye.position.x, corner.y - eye.position.y));
  axis.radius = std::min(axis.radius, farthest / units().resolution + 1);
  RadialSweep::View view = sweep_.beginning(axis);
  std::vector<BinBox> reached;
  for (const BinBox& box : boxes_of_tiles())
    if (view.reaches(box)) reached.push_back(box);
  view.narrow(reached);
  view.advance(kInfinity, progress);
  return view;
}

std::optional<double> ExactScene::height(Point2 position) const {
  const auto height =
      heights_->height_at({easting_in_units(units(), position.x), northing_in_units(units(), position.y)});
  return height ? std::optional(*height * units().resolution) : std::nullopt;
}

std::unique_ptr<ExactScene::TileCells> ExactScene::begin(std::size_t tile) const {
  const Tile whole = tile_at(grid_, tiles_, tile);
  return begin(whole, {&whole, 1});
}

std::unique_ptr<ExactScene::TileCells> ExactScene::begin(const Tile& tile, std::span<const Tile> parts) const {
  auto work = std::make_unique<TileCells>(units(), grid_, tile);
  if (kept_ != nullptr) {
    kept_->find(grid_, tile, work->centres, work->ground);
  } else if (of_tiles_) {
    std::vector<std::uint32_t> gathered;
    scan_convert(*targets_on_, triangles_about(tile, gathered), tile, work->centres, work->ground);
  } else {
    find_ground(parts, *work);
  }
  return work;
}

/// Lists the triangles that may hold cells of a tile, ascending; `gathered` is memory for those of several tiles.
std::span<const std::uint32_t> ExactScene::triangles_about(const Tile& tile,
                                                           std::vector<std::uint32_t>& gathered) const {
  const auto number = [](std::int64_t cell) { return cell / Tile::kSide; };
  if (tile.step == 1) return of_tiles_->triangles(tiles_.index({number(tile.column), number(tile.row)}));
  const std::int64_t east = number(tile.column + (tile.columns - 1) * tile.step),
                     south = number(tile.row + (tile.rows - 1) * tile.step);
  for (std::int64_t row = number(tile.row); row <= south; ++row) {
    for (std::int64_t column = number(tile.column); column <= east; ++column) {
      const auto triangles = of_tiles_->triangles(tiles_.index({column, row}));
      gathered.insert(gathered.end(), triangles.begin(), triangles.end());
    }
  }
  sort_unique(gathered);
  return gathered;
}

bool ExactScene::hides(const Eye& eye, const RadialSweep::View& view, const Tile& tile) const {
  // Targets on the ground below another surface may not lie below its bounds.
  if (targets_on_ != surface_ || rays_) return false;
  const Box centres = box_of_centres(grid_, tile);
  if (!MapView{eye.position, eye.view}.holds(centres)) return false;
  const BinBox box = heights_->in_bins(centres);
  const auto highest = heights_->highest_where_covered(box);
  return highest && view.hides(box, eye.target(*highest * units().resolution) / units().resolution);
}

std::uint64_t ExactScene::judge(const Eye& eye, const RadialSweep::View& view, TileValues<Verdict>& values,
                                TileCells& work) const {
  raise_targets(eye, values, work);
  if (rays_) {
    cast_rays_to_targets(eye, work);
  } else {
    sweep_.decide(view, {work.tile, work.centres, work.targets}, work.scratch, work.seen);
  }
  std::uint64_t lines = 0;
  for_each_cell(work.tile, [&](std::size_t cell, RasterGrid::Cell) {
    if (std::isnan(work.targets[cell])) return;
    ++lines;
    values[cell] = std::isnan(work.seen[cell]) ? Verdict::kHidden : Verdict::kVisible;
  });
  return lines;
}

/// Sets `work.seen` as RadialSweep::decide() does: to the eye's height for a target that is seen, and to NaN where it
/// is hidden.
void ExactScene::cast_rays_to_targets(const Eye& eye, TileCells& work) const {
  const auto rows = static_cast<std::size_t>(work.tile.rows), columns = static_cast<std::size_t>(work.tile.columns);
  SightLines lines;
  lines.start_at(eye.units);
  std::array<std::size_t, SightLines::kSize> cells{};
  for (std::size_t row = 0; row < rows; row += kPacketSide) {
    for (std::size_t column = 0; column < columns; column += kPacketSide) {
      lines.active = 0;
      for (unsigned i = 0; i < SightLines::kSize; ++i) {
        const std::size_t cell = (row + i / kPacketSide) * Tile::kSide + column + i % kPacketSide;
        if (std::isnan(work.targets[cell])) continue;
        const Point3 target = work.target(cell);
        lines.to_x[i] = target.x, lines.to_y[i] = target.y, lines.to_z[i] = target.z;
        lines.active |= 1U << i;
        cells[i] = cell;
      }
      if (lines.active == 0) continue;
      const unsigned hidden = rays_->hidden(lines);
      for_each_bit(lines.active,
                   [&](unsigned i) { work.seen[cells[i]] = (hidden >> i & 1) != 0 ? kNoSurface : eye.units.z; });
    }
  }
}

void ExactScene::cast_rays(const Earth& earth) {
  ITIN_PRECONDITION(surface_ != nullptr);
  rays_ = std::make_unique<const Scene>(*surface_, earth);
}

double ExactScene::raise_from(const RadialSweep::View& view, Point2 position, double lowest, double highest) const {
  const RasterGrid around({position.x - 0.5, position.y + 0.5}, 1, 1, 1, 1);
  const auto work = std::make_unique<TileCells>(units(), around, Tile{0, 0, 1, 1});
  work->centres.x[0] = easting_in_units(units(), position.x);
  work->centres.y[0] = northing_in_units(units(), position.y);
  work->ground[0] = lowest, work->targets[0] = highest;
  raise_from(view, {work->ground, work->ground}, *work);
  return work->seen[0];
}

void ExactScene::find_ground(std::span<const Tile> parts, TileCells& work) const {
  const TileCentres& at = work.centres;
  work.ground.fill(kNoSurface);
  work.unread = true;
  for (const Tile& part : parts) {
    const std::size_t first = work.tile.cell({part.column, part.row}), west = first % Tile::kSide,
                      north = first / Tile::kSide;
    const std::size_t east = west + static_cast<std::size_t>(part.columns),
                      south = north + static_cast<std::size_t>(part.rows);
    using Expanse = BinnedHeights::Expanse;
    const Expanse expanse = heights_->expanse({at.x[west], at.y[north]}, {at.x[east - 1], at.y[south - 1]});
    work.unread = work.unread && expanse == Expanse::kAllUnread;
    if (expanse == Expanse::kAllBare) continue;
    for (std::size_t r = north; r < south; ++r) {
      for (std::size_t c = west; c < east; ++c) {
        const auto height = expanse == Expanse::kAllUnread ? kUnread : heights_->height_at({at.x[c], at.y[r]});
        if (height) work.ground[r * Tile::kSide + c] = *height;
      }
    }
  }
}

/// Computes where undecided cells have their targets, and decides the cells that need no line.
void ExactScene::raise_targets(const Eye& eye, TileValues<Verdict>& values, TileCells& work) const {
  const double resolution = units().resolution, metre = 1 / resolution, grazing = kGrazing / resolution;
  work.targets.fill(kNoSurface);
  for_each_offset(eye, grid_, work.tile, work.centres, [&](std::size_t cell, const Point2& offset) {
    Verdict& value = values[cell];
    if (value != Verdict::kUndecided) return;
    value = Verdict::kOutside;
    const double ground = work.ground[cell];
    if (std::isnan(ground)) return;
    const double target = eye.target(ground * resolution);
    if (!eye.view.contains(offset.x, offset.y, target - eye.elevation)) return;
    const bool below = ground == kUnread || target * metre < ground - grazing;
    value = below ? Verdict::kHidden : Verdict::kVisible;
    if (!below && offset != Point2{}) work.targets[cell] = target * metre;
  });
}

}  // namespace itin::viewshed
