#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <itin/triangulate.hpp>

#include "../request.hpp"
#include "cell_blocks.hpp"
#include "group_survey.hpp"

namespace itin::viewshed {

namespace {

/// The part of the grid about a position, its cells in the same blocks.
struct SubGrid {
  RasterGrid grid;
  RasterGrid::Cell first;  ///< of the whole, a block's

  SubGrid(const RasterGrid& whole, Point2 p, double radius) {
    const auto clamp = [](double v, std::int64_t count) {
      return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(v)), 0, count - 1);
    };
    constexpr std::int64_t kSide = CellBlocks::kSide;
    first = {clamp(whole.column_at(p.x - radius) - 1, whole.columns()) / kSide * kSide,
             clamp(whole.row_at(p.y + radius) - 1, whole.rows()) / kSide * kSide};
    const RasterGrid::Cell last{clamp(whole.column_at(p.x + radius) + 1, whole.columns()),
                                clamp(whole.row_at(p.y - radius) + 1, whole.rows())};
    grid = {{whole.north_west().x + static_cast<double>(first.column) * whole.cell_width(),
             whole.north_west().y - static_cast<double>(first.row) * whole.cell_height()},
            whole.cell_width(),
            whole.cell_height(),
            last.column - first.column + 1,
            last.row - first.row + 1};
  }
};

DemandSet kept(const DemandSet& set, const auto& keep) {
  DemandSet result;
  for (const DemandSet::Block& block : set.blocks()) {
    std::uint64_t members = 0;
    for (std::uint64_t rest = block.members; rest != 0; rest &= rest - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(rest));
      if (keep(std::size_t{64} * block.number + bit)) members |= std::uint64_t{1} << bit;
    }
    result.add(block.number, members);
  }
  return result;
}

DemandSet themed_cells(const Tin& tin, const Tin& ground, const SiteSurvey& survey, Request request,
                       const DemandSet& bare, Progress& progress, Statistics& statistics) {
  const RasterGrid& whole = *survey.targets.grid;
  const SubGrid sub(whole, request.observers.front().position, survey.radius);
  request.grid = sub.grid;
  const Result result = compute(tin, ground, request, progress);
  statistics.rays += result.statistics.rays;
  const CellBlocks blocks(whole);
  return kept(bare, [&](std::size_t element) {
    const RasterGrid::Cell cell = blocks.cell(element);
    return result.visible[sub.grid.index({cell.column - sub.first.column, cell.row - sub.first.row})] == kVisible;
  });
}

std::optional<double> height_on(const Tin& tin, Point2 position) {
  std::vector<std::uint32_t> all(tin.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return surface_height(tin, all, position);
}

DemandSet themed_points(const Tin& tin, const Tin& ground, const SiteSurvey& survey, const Request& request,
                        const DemandSet& bare, Statistics& statistics) {
  const Scene scene(tin, request.earth, request.nodata, ceiling_of(tin, request));
  const Tin& base = survey.targets.on_surface ? tin : ground;
  const double metre = 1 / tin.grid.resolution;
  const Eye eye = eye_of(tin.grid, request.observers.front(), request.observers.front().height);
  Occluder occluder;
  return kept(bare, [&](std::size_t element) {
    const Point2 p = survey.targets.points[element];
    const std::optional<double> under = height_on(base, p);
    if (!under) return false;
    SightLines lines;
    lines.from_x[0] = eye.units.x, lines.from_y[0] = eye.units.y, lines.from_z[0] = eye.units.z;
    lines.to_x[0] = easting_in_units(tin.grid, p.x), lines.to_y[0] = northing_in_units(tin.grid, p.y);
    lines.to_z[0] = (*under * tin.grid.resolution + survey.targets.height) * metre;
    lines.active = lines.to_x[0] != eye.units.x || lines.to_y[0] != eye.units.y;
    ++statistics.rays;
    return lines.active == 0 || scene.hidden(lines, occluder) == 0;
  });
}

}  // namespace

DemandSet judge_with_themes(const Store& store, const SiteSurvey& survey, std::size_t option, const DemandSet& bare,
                            Progress& progress, Statistics& statistics) {
  Request request = request_of(survey, {&option, 1});
  request.target_height = survey.targets.height;
  request.targets_on_surface = survey.targets.on_surface;
  const Window window = Window::disc(survey.stands[option].position, survey.radius);
  const Tin tin = triangulate(store, window, Detail::tolerance(0), progress, survey.themes);
  const Tin ground = triangulate(store, window, Detail::tolerance(0), progress, ThemeChoice::none());
  statistics.retrieval += tin.statistics;
  statistics.triangles += tin.triangles.size();
  return survey.targets.grid ? themed_cells(tin, ground, survey, std::move(request), bare, progress, statistics)
                             : themed_points(tin, ground, survey, request, bare, statistics);
}

}  // namespace itin::viewshed
