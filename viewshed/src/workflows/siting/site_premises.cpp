#include "workflows/siting/site_premises.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/building_outlines.hpp>
#include <itin/error.hpp>

#include "line/cell_tiles.hpp"
#include "workflows/premises/highest_antennas.hpp"
#include "workflows/premises/premises_rules.hpp"

namespace itin::viewshed {

namespace {

/// Returns the request for premises, without masts.
PremisesRequest premises_request(const SitePlanRequest& request) {
  PremisesRequest premises;
  static_cast<AntennaPlaces&>(premises) = *request.demand.premises;
  complete_antennas(premises, request.frequency_ghz);
  premises.masts_on_surface = request.on_surface;
  premises.radius = request.radius;
  premises.frequency_ghz = request.frequency_ghz, premises.fresnel = request.fresnel;
  premises.earth = request.earth;
  premises.themes = request.themes;
  premises.nodata = request.nodata;
  premises.memory_bytes = request.memory_bytes;
  return premises;
}

bool reaches_any(const std::vector<SitePosition>& sites, const Box& box, double radius) {
  return std::any_of(sites.begin(), sites.end(),
                     [&](const SitePosition& site) { return squared_distance(site.position, box) <= radius * radius; });
}

}  // namespace

void add_premises(const Store& store, const SitePlanRequest& request, SiteInputs& inputs,
                  std::vector<std::string>& warnings, Progress& progress) {
  const StoreMetadata& metadata = store.metadata();
  const PremisesRequest premises = premises_request(request);
  require_buildings(metadata, request.themes, warnings);
  std::vector<BuildingFoot> feet = building_feet(store, request.themes, metadata.grid.box(metadata.bounds));
  std::erase_if(feet, [&](const BuildingFoot& foot) {
    return !reaches_any(inputs.positions, box_about(premises, foot), request.radius);
  });
  std::uint32_t buildings = 0;
  for (const std::vector<HighestAntenna>& antennas : highest_antennas(store, premises, feet, progress)) {
    for (const HighestAntenna& antenna : antennas) {
      inputs.targets.points.push_back(antenna.position);
      inputs.targets.heights.push_back(antenna.height_m);
      inputs.targets.elements.push_back(buildings);
    }
    buildings += antennas.empty() ? 0 : 1;
  }
  if (buildings == 0)
    throw InputError(fmt::format("no building is within the `radius` of {:g} m of a site", request.radius), "radius");
  inputs.demand = Demand(buildings);
  inputs.total = inputs.demand.total();
}

std::shared_ptr<const PremisesSurvey> survey_of_choice(const Store& store, const SitePlanRequest& request,
                                                       const SiteInputs& inputs, const Choice& choice,
                                                       const JointCoverage& coverage, Progress& progress) {
  PremisesRequest premises = premises_request(request);
  const std::vector<std::size_t> sites = serving_sites(inputs, choice);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (coverage.certain[i].empty()) continue;  // it may lie beneath a roof
    const SitePosition& site = inputs.positions[sites[i]];
    premises.masts.places.push_back({.name = site.name, .position = site.position, .height = site.height});
  }
  if (premises.masts.places.empty()) throw Error("no site serves any of the premises within its radius");
  return std::make_shared<const PremisesSurvey>(survey_premises(store, std::move(premises), progress));
}

}  // namespace itin::viewshed
