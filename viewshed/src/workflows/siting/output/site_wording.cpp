#include <fmt/format.h>

#include <viewshed/site_wording.hpp>

namespace itin::viewshed {

namespace {

SiteWording words_of_sites() {
  return {.one = "site",
          .mark = "Site",
          .served = "Served",
          .unserved = "Not served",
          .by = "Served by",
          .how_many = "Sites that serve a place",
          .count = "sites that serve the cell",
          .nearest = "nearest site that serves the cell; 0 none",
          .coverage_curve = "Share of the demand served, by number of sites",
          .order = "Chosen sites, in the order in which they add most",
          .count_heading = "How many sites serve each place",
          .bound = "no choice serves more than",
          .sufficient = "their upper bound never ranked first"};
}

SiteWording words_of_turbines(const TurbinePlacement& placement) {
  const bool hubs = placement.minimised == Minimised::kHubs;
  const std::string part = hubs ? "hub" : "tip";
  return {.one = "turbine",
          .mark = "Turbine",
          .served = fmt::format("A {} is seen", part),
          .unserved = fmt::format("No {} is seen", part),
          .by = fmt::format("Where a {} is seen:", part),
          .how_many = fmt::format("How many {}s are seen", part),
          .count = fmt::format("turbines whose {} is seen from the cell", part),
          .nearest = fmt::format("nearest turbine whose {} is seen from the cell; 0 none", part),
          .coverage_curve = placement.minimised == Minimised::kHeight
                                ? "Share of the height that is seen in all, turbine by turbine"
                                : "Share of the demand that sees them, turbine by turbine",
          .order = "Turbines, in the order in which they add least",
          .count_heading = fmt::format("How many {}s are seen", part),
          .bound = "no choice has less than",
          .sufficient = "even the least that sees them was never the least"};
}

}  // namespace

const char* minimised_part(const TurbinePlacement& placement) {
  return placement.minimised == Minimised::kHubs ? "the hub" : "the tip";
}

SiteWording wording_of(const SitePlanRequest& request) {
  return request.turbines ? words_of_turbines(*request.turbines) : words_of_sites();
}

}  // namespace itin::viewshed
