#include "workflows/siting/site_rasters.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <itin/sort_unique.hpp>
#include <viewshed/viewshed.hpp>

#include "modes/observation.hpp"
#include "siting/coverage/group_survey.hpp"

namespace itin::viewshed {

namespace {

/// Finds how many sites serve each cell, and the nearest of them, whose signal is the strongest in the open.
class ServedCells {
 public:
  ServedCells(const RasterGrid& grid, const DemandSet& in_reach)
      : grid_(grid), nearest_(grid.cell_count(), std::numeric_limits<double>::infinity()) {
    rasters_.grid = grid;
    rasters_.redundancy.assign(grid.cell_count(), SiteRasters::kOutside);
    rasters_.best_server.assign(grid.cell_count(), SiteRasters::kOutside);
    rasters_.served.reserve(grid.cell_count());
    for_each_cell(in_reach, [&](std::size_t i, Point2) { rasters_.redundancy[i] = rasters_.best_server[i] = 0; });
  }

  void add(const SitePosition& site, const std::string& name, const DemandSet& served) {
    const auto number = static_cast<std::uint16_t>(rasters_.servers.size() + 1);
    if (site.sectors.empty()) rasters_.servers.push_back(name);
    for (const SiteSector& sector : site.sectors) rasters_.servers.push_back(sector.name);
    for_each_cell(served, [&](std::size_t i, Point2 centre) {
      if (rasters_.redundancy[i] == SiteRasters::kOutside) return;
      ++rasters_.redundancy[i];
      const double distance = std::hypot(centre.x - site.position.x, centre.y - site.position.y);
      if (distance < nearest_[i]) nearest_[i] = distance, rasters_.best_server[i] = number;
    });
  }
  /// Puts the servers that give the greatest level in place of the nearest.
  void take_strongest(const Levels& levels) {
    for (std::size_t i = 0; i < rasters_.best_server.size(); ++i)
      if (nearest_[i] < std::numeric_limits<double>::infinity() && levels.observer[i] > 0)
        rasters_.best_server[i] = static_cast<std::uint16_t>(levels.observer[i]);
  }
  /// Returns the rasters. `undecided` holds the undecided ones of the cells that fewer than `cover` sites serve.
  SiteRasters rasters(int cover, const DemandSet& undecided) && {
    for (const std::uint16_t n : rasters_.redundancy)
      rasters_.served.push_back(n == SiteRasters::kOutside ? Verdict::kOutside
                                : n >= cover               ? Verdict::kVisible
                                                           : Verdict::kHidden);
    for_each_cell(undecided, [&](std::size_t i, Point2) {
      if (rasters_.served[i] == Verdict::kHidden) rasters_.served[i] = Verdict::kUndecided;
    });
    return std::move(rasters_);
  }

 private:
  void for_each_cell(const DemandSet& set, const auto& visit) const {
    for_each_element(set, [&](std::size_t element) {
      const RasterGrid::Cell cell = cell_of(grid_, element);
      visit(grid_.index(cell), grid_.centre(cell.column, cell.row));
    });
  }

  const RasterGrid& grid_;
  std::vector<double> nearest_;
  SiteRasters rasters_;
};

/// Returns the levels that no site gives.
Result no_levels(const RasterGrid& grid, Request request) {
  Result result;
  result.grid = grid, result.request = std::move(request);
  Observation::prepare(result);
  return result;
}

/// Returns the cells of the rasters that are not outside.
DemandSet cells_of_rasters(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                           const std::vector<std::size_t>& serving, const SiteTargets& cells, Progress& progress) {
  if (!inputs.cells.empty()) return inputs.cells;
  std::vector<SitePosition> sites;
  for (const std::size_t site : serving) sites.push_back(inputs.positions[site]);
  if (inputs.targets.grid || sites.empty()) sites = inputs.positions;
  return intersection(with_ground(store, cells, progress), within_reach(cells, sites, request.radius));
}

}  // namespace

Result site_levels(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs, const Choice& choice,
                   const JointCoverage& cells, Progress& progress) {
  SiteSurvey survey = survey_of_all(request, inputs);
  survey.targets = cells.targets;
  std::vector<SitePosition> sites;
  for (const std::size_t site : serving_sites(inputs, choice)) sites.push_back(inputs.positions[site]);
  if (sites.empty()) return no_levels(*cells.targets.grid, request_of_levels(survey, sites));
  Request look = request_of_levels(survey, sites);
  look.grid = *cells.targets.grid;
  look.margins_db = {0, request.margin_db};
  sort_unique(look.margins_db);
  ComputeOptions options;
  options.memory_bytes = request.memory_bytes, options.whole_surface = false;
  return compute_with_surface(store, look, options, progress).result;
}

SiteRasters site_rasters(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                         const Choice& choice, const JointCoverage& cells, const Result* levels, Progress& progress) {
  const std::vector<std::size_t> sites = serving_sites(inputs, choice);
  ServedCells served(*cells.targets.grid, cells_of_rasters(store, request, inputs, sites, cells.targets, progress));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const SitePosition& site = inputs.positions[sites[i]];
    served.add(site, (sites[i] < inputs.options.size() ? "" : "existing ") + site.name, cells.certain[i]);
  }
  if (levels) served.take_strongest(levels->get<Levels>());
  return std::move(served).rasters(request.cover, cells.undecided);
}

}  // namespace itin::viewshed
