// Levels that sites give to cells or points, by link budgets.
#include <algorithm>
#include <cmath>
#include <map>

#include <itin/call_progress.hpp>
#include <profile/links.hpp>
#include <viewshed/viewshed.hpp>

#include "siting/coverage/group_survey.hpp"

namespace itin::viewshed {

namespace {

/// The elements, in ascending order, as a coverage that is known.
CoverageBounds exactly(const std::map<std::uint32_t, std::uint64_t>& blocks) {
  CoverageBounds bounds;
  for (const auto& [number, members] : blocks) bounds.certain.add(number, members);
  bounds.possible = bounds.certain, bounds.exact = true;
  return bounds;
}

class LevelSurvey final : public GroupSurvey {
 public:
  LevelSurvey(const Store& store, const SiteSurvey& survey) : store_(store), survey_(survey), level_(*survey.level) {}

  std::vector<CoverageBounds> judge(const SitesToJudge& sites, Progress& progress,
                                    Statistics& statistics) const override {
    std::vector<CoverageBounds> result;
    CallProgress call(progress);
    for (std::size_t i = 0; i < sites.options.size(); ++i) {
      Progress& of_site = call.step(1.0 / static_cast<double>(sites.options.size() - i));
      const SitePosition& site = survey_.positions[sites.options[i]];
      result.push_back(survey_.targets.grid ? of_cells(site, of_site, statistics)
                                            : of_points(site, sites.bounds[i]->possible, of_site, statistics));
    }
    return result;
  }

 private:
  using Blocks = std::map<std::uint32_t, std::uint64_t>;

  static void add(std::size_t element, Blocks& blocks) {
    blocks[static_cast<std::uint32_t>(element / 64)] |= std::uint64_t{1} << element % 64;
  }

  CoverageBounds of_cells(const SitePosition& site, Progress& progress, Statistics& statistics) const {
    const RasterGrid& grid = *survey_.targets.grid;
    const Box reach = intersection(square_about(site.position, survey_.radius), grid.bounds());
    if (reach.empty()) return exactly({});
    const RasterGrid::Cell first = cell_within(grid, {reach.xmin, reach.ymax});
    const RasterGrid::Cell last = cell_within(grid, {reach.xmax, reach.ymin});
    Request request = request_of_levels(survey_, {&site, 1});
    request.grid = grid.part(first, last.column - first.column + 1, last.row - first.row + 1);
    ComputeOptions options;
    options.memory_bytes = survey_.memory_bytes, options.whole_surface = false;
    const Result found = compute_with_surface(store_, request, options, progress).result;
    statistics += found.statistics;
    Blocks blocks;
    const std::vector<float>& levels = found.get<Levels>().level_dbm;
    for (std::int64_t row = 0; row < found.grid.rows(); ++row) {
      for (std::int64_t column = 0; column < found.grid.columns(); ++column) {
        const std::size_t cell = found.grid.index({column, row});
        const bool own = found.visible[cell] == Verdict::kVisible && found.grid.centre(column, row) == site.position;
        if (own || levels[cell] >= level_.least_dbm)
          add(element_of(grid, {first.column + column, first.row + row}), blocks);
      }
    }
    return exactly(blocks);
  }

  /// The cell at a place on the grid or on its rim.
  static RasterGrid::Cell cell_within(const RasterGrid& grid, Point2 at) {
    const Point2 corner = grid.north_west();
    const auto number = [](double cells, std::int64_t count) {
      return std::clamp(static_cast<std::int64_t>(std::floor(cells)), std::int64_t{0}, count - 1);
    };
    return {number((at.x - corner.x) / grid.cell_width(), grid.columns()),
            number((corner.y - at.y) / grid.cell_height(), grid.rows())};
  }

  CoverageBounds of_points(const SitePosition& site, const DemandSet& within_reach, Progress& progress,
                           Statistics& statistics) const {
    std::vector<std::size_t> points;
    std::vector<profile::Link> links;
    for_each_element(within_reach, [&](std::size_t point) {
      points.push_back(point);
      links.push_back(
          {{}, site.position, site.height, survey_.targets.points[point], survey_.targets.height_of(point)});
    });
    const std::vector<profile::LinkResult> lines = survey_links(store_, links, query(), progress);
    Blocks blocks;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      statistics.add_retrieval(lines[i].statistics, lines[i].triangles, 0);
      if (serves(site, links[i], lines[i])) add(points[i], blocks);
    }
    statistics.lines += lines.size();
    return exactly(blocks);
  }

  profile::LinkQuery query() const {
    return {.earth = survey_.earth,
            .themes = survey_.themes,
            .from_on_surface = level_.sites_on_surface,
            .to_on_surface = survey_.targets.on_surface,
            .radio = level_.radio,
            .budget = level_.budget,
            .nodata = survey_.nodata};
  }

  bool serves(const SitePosition& site, profile::Link& link, const profile::LinkResult& line) const {
    if (line.found && line.distance_m == 0) return true;
    const auto enough = [&] {
      const auto budget = link_budget_of(link, line, query());
      return budget && budget->level_dbm >= level_.least_dbm;
    };
    if (site.sectors.empty()) return enough();
    return std::any_of(site.sectors.begin(), site.sectors.end(), [&](const SiteSector& sector) {
      link.budget.from_antenna = sector.antenna;
      return enough();
    });
  }

  const Store& store_;
  const SiteSurvey& survey_;
  const ServingLevel& level_;
};

}  // namespace

Request request_of_levels(const SiteSurvey& survey, std::span<const SitePosition> sites) {
  Request request;
  for (const SitePosition& site : sites) {
    const Observer mast{site.name, site.position, site.elevation(), true};
    if (site.sectors.empty()) request.observers.push_back(mast);
    for (const SiteSector& sector : site.sectors) {
      request.observers.push_back(mast);
      request.observers.back().name = sector.name, request.observers.back().antenna = sector.antenna;
    }
  }
  request.target_height = survey.targets.height;
  request.targets_on_surface = survey.targets.on_surface;
  request.radius = survey.radius;
  request.earth = survey.earth;
  request.themes = survey.themes;
  request.nodata = survey.nodata;
  request.engine = survey.engine;
  request.mode = Mode::kLevel;
  request.radio = survey.level->radio;
  request.budget = survey.level->budget;
  return request;
}

std::unique_ptr<GroupSurvey> survey_levels(const Store& store, const SiteSurvey& survey) {
  return std::make_unique<LevelSurvey>(store, survey);
}

}  // namespace itin::viewshed
