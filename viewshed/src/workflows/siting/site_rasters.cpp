#include "workflows/siting/site_rasters.hpp"

#include <cmath>
#include <limits>

namespace itin::viewshed {

namespace {

/// Finds the best server of each cell: the nearest site, whose signal is the strongest in the open.
class BestServers {
 public:
  BestServers(const RasterGrid& grid, const DemandSet& in_reach)
      : grid_(grid), nearest_(grid.cell_count(), std::numeric_limits<double>::infinity()) {
    rasters_ = {grid,
                std::vector<std::uint16_t>(grid.cell_count(), SiteRasters::kOutside),
                std::vector<std::uint16_t>(grid.cell_count(), SiteRasters::kOutside),
                {}};
    rasters_.served.reserve(grid.cell_count());
    for_each_cell(in_reach, [&](std::size_t i, Point2) { rasters_.redundancy[i] = rasters_.best_server[i] = 0; });
  }

  void add(const SitePosition& place, std::uint16_t number, const DemandSet& served) {
    for_each_cell(served, [&](std::size_t i, Point2 centre) {
      if (rasters_.redundancy[i] == SiteRasters::kOutside) return;
      ++rasters_.redundancy[i];
      const double distance = std::hypot(centre.x - place.position.x, centre.y - place.position.y);
      if (distance < nearest_[i]) nearest_[i] = distance, rasters_.best_server[i] = number;
    });
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

SiteRasters site_rasters(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                         const Choice& choice, const JointCoverage& cells, Progress& progress) {
  const std::vector<std::size_t> sites = serving_sites(inputs, choice);
  BestServers best(*cells.targets.grid, cells_of_rasters(store, request, inputs, sites, cells.targets, progress));
  for (std::size_t i = 0; i < sites.size(); ++i)
    best.add(inputs.positions[sites[i]], static_cast<std::uint16_t>(i + 1), cells.certain[i]);
  return std::move(best).rasters(request.cover, cells.undecided);
}

}  // namespace itin::viewshed
