#include "workflows/siting/plan_checks.hpp"

#include <cmath>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <viewshed/site_maps.hpp>

#include "request/request.hpp"
#include "workflows/siting/joint_coverage.hpp"

namespace itin::viewshed {

namespace {

void require_that(bool holds, const char* field, const char* what) {
  if (!holds) throw InputError(what, field);
}

/// The antennas of sites, each completed by that of the budget, must point somewhere.
void check_antennas(const SitePlanRequest& r) {
  profile::BudgetQuery budget = r.link_budget;
  bool all = r.search_area == std::nullopt;
  for (const SitePlaces* places : {&r.candidates, &r.existing})
    for (const SitePlace& place : places->places) {
      all = all && !place.sectors.empty();
      for (const SiteSector& sector : place.sectors) {
        budget.from_antenna = completed(sector.antenna, r.link_budget.from_antenna);
        try {
          validate_budget_of_area(budget);
        } catch (const InputError& error) {
          throw InputError(fmt::format("sector '{}' of '{}': {}", sector.name, place.name, error.what()),
                           error.field());
        }
      }
    }
  if (!all) validate_budget_of_area(r.link_budget);
}

void check_budget(const SitePlanRequest& r) {
  check_antennas(r);
  require_that(r.frequency_ghz.has_value(), "frequency_ghz", "a link budget needs `frequency_ghz`");
  require_that(r.link_budget.sensitivity_dbm.has_value(), "sensitivity_dbm",
               "a link budget needs `sensitivity_dbm`: it says what level serves");
  require_that(std::isfinite(r.margin_db), "margin_db", "`margin_db`: give a finite number");
  require_that(!r.turbines && !r.demand.premises, "power_dbm",
               "a link budget is for masts that serve cells or points, not for `turbines` or premises");
}

}  // namespace

void check(const SitePlanRequest& r) {
  const SiteDemand& demand = r.demand;
  require_that(r.search_area.has_value() != !r.candidates.places.empty() || !r.candidates.left_out.empty(),
               "candidates", "give either `candidates` or a `search_area`");
  require_that(r.spacing > 0, "spacing", "`spacing` must be positive");
  require_that(r.turbines || !r.masts.empty(), "masts", "`masts` is empty: give at least one");
  require_that(demand.points.has_value() + demand.grid.has_value() + demand.premises.has_value() <= 1, "demand",
               "the demand is either `points`, a `grid` or `premises`");
  require_that(!demand.premises || !r.turbines, "demand",
               "`turbines` are not placed for `premises`: give cells or points");
  require_that(!demand.grid || demand.weights.size() == demand.grid->cell_count(), "weights",
               "`weights` needs `grid` and one value for each cell");
  require_that(r.radius > 0, "radius", "`radius` must be positive");
  require_that(r.cell_size > 0, "cell_size", "`cell_size` must be positive");
  require_that(!r.frequency_ghz || *r.frequency_ghz > 0, "frequency_ghz", "`frequency_ghz` must be positive");
  if (r.by_level() || r.link_budget.sensitivity_dbm) check_budget(r);
  require_that(!r.share || (*r.share > 0 && *r.share <= 1), "share", "`share` must be above 0 and at most 1");
  require_that(r.cover >= 1 && r.cover <= 255, "cover", "`cover` must be 1 to 255");
  require_that(!r.turbines || (r.turbines->hub_height > 0 && r.turbines->tip_height >= r.turbines->hub_height),
               "turbines", "`turbines` need a hub above the ground, and a tip that is no lower");
  require_that(!r.turbines || !(r.has_links() || r.frequency_ghz || r.budget || r.share || r.cover > 1), "turbines",
               "`turbines` have no links, radio, budget, share or k-coverage: leave these out");
}

void require_memory(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs) {
  const RasterGrid grid = inputs.targets.grid
                              ? *inputs.targets.grid
                              : grid_of_reach(store, inputs.positions, request.radius, request.cell_size);
  const std::uint64_t needed =
      bytes_of_site_maps(store, request, grid) + bytes_of_coverage(survey_of_all(request, inputs));
  if (needed <= request.memory_bytes) return;
  throw InputError(
      fmt::format("maps of {} cells, and what {} may serve of them, take some {:.2g} GB, more than the {:.2g} GB of "
                  "`memory_bytes`: give a greater `cell_size`, a smaller `radius`, fewer sites, or more memory",
                  grouped(grid.cell_count()), counted(inputs.positions.size(), "site"),
                  static_cast<double>(needed) / 1e9, static_cast<double>(request.memory_bytes) / 1e9),
      "memory_bytes");
}

void require_enough(const SitePlanRequest& request, const SiteInputs& inputs) {
  if (!request.turbines || !request.count || inputs.candidates.size() >= *request.count) return;
  std::string why;
  for (const BarredCandidates& barred : inputs.barred)
    why += fmt::format("{} each of {} {}", why.empty() ? ":" : ",", counted(barred.count, "other"), barred.why);
  throw Error(
      fmt::format("`count`: {} asked for, but only {} may carry a turbine{}; ask for fewer, or give more places",
                  counted(*request.count, "turbine"), counted(inputs.candidates.size(), "candidate"), why));
}

}  // namespace itin::viewshed
