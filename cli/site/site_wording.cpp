#include "site/site_wording.hpp"

#include <fmt/format.h>

#include "output/store_document.hpp"

namespace itin::cli {

namespace {

SiteWording of_sites() {
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
          .sufficient = "even the most that they may serve never came first"};
}

SiteWording of_turbines(const PlacementOptions& placement) {
  const bool hubs = placement.minimised() == Minimised::kHubs;
  const std::string part = hubs ? "hub" : "tip";
  return {.one = "turbine",
          .mark = "Turbine",
          .served = fmt::format("A {} is seen", part),
          .unserved = fmt::format("No {} is seen", part),
          .by = fmt::format("Where a {} is seen:", part),
          .how_many = fmt::format("How many {}s are seen", part),
          .count = fmt::format("turbines whose {} is seen from the cell", part),
          .nearest = fmt::format("nearest turbine whose {} is seen from the cell; 0 none", part),
          .coverage_curve = placement.sums_heights() ? "Share of the height that is seen in all, turbine by turbine"
                                                     : "Share of the demand that sees them, turbine by turbine",
          .order = "Turbines, in the order in which they add least",
          .count_heading = fmt::format("How many {}s are seen", part),
          .bound = "no choice has less than",
          .sufficient = "even the least that sees them was never the least"};
}

}  // namespace

SiteWording wording_of(const SiteOptions& options) {
  return options.placement.given() ? of_turbines(options.placement) : of_sites();
}

std::string certainly(const SiteResult& r) {
  return r.coverage.leaves_open() ? "certainly " : "";
}

std::string undecided_in_words(const SiteResult& r) {
  const PlacementOptions& placement = r.options.placement;
  return fmt::format("{:.10g}{} {}{}, across ground without data; {} decides that", r.undecided,
                     placement.sums_heights() ? " m" : "", placement.given() ? "of these" : "more",
                     placement.sums_heights() ? "" : fmt::format(" ({:.1f} % of the demand)", r.undecided_percent()),
                     kDecidesMissingGround);
}

std::string served_in_words(const SiteResult& r) {
  const std::size_t chosen = r.choice.chosen.size(), existing = r.inputs.existing();
  return fmt::format("which {}{}serve{} {:.10g} of a demand of {:.10g} ({:.1f} %)",
                     existing > 0 ? fmt::format("together with {} ", counted(existing, "existing site"))
                     : chosen > 1 ? "together "
                                  : "",
                     certainly(r), chosen == 1 ? "s" : "", r.served(), r.in_metric(r.inputs.total), r.served_percent());
}

std::string least_in_words(const SiteResult& r) {
  const PlacementOptions& placement = r.options.placement;
  const bool open = r.undecided > 0;
  const std::string proved = r.is_best() ? "proved to be the least there is"
                                         : fmt::format("no choice has less than {:.10g} (gap {:.1f} %)",
                                                       r.in_metric(r.choice.lower_bound), gap_percent(r.choice));
  if (placement.minimised() == Minimised::kHeight)
    return fmt::format("visible height, summed: {}{:.10g} m; {}", open ? "at most " : "", r.in_metric(r.choice.value),
                       proved);
  const std::string existing =
      r.choice.existing > 0
          ? fmt::format(", besides {:.10g} from which {} {}seen already", r.in_metric(r.choice.existing),
                        r.inputs.existing() == 1 ? "an existing one is" : "existing ones are", certainly(r))
          : "";
  return fmt::format(
      "{} of a turbine {} seen from {:.10g} of a demand of {:.10g} ({:.1f} %){}; {}", placement.minimised_part(),
      open ? "may be" : "is", r.in_metric(r.choice.value), r.in_metric(r.inputs.total),
      r.inputs.total == 0 ? 0 : 100 * static_cast<double>(r.choice.value) / static_cast<double>(r.inputs.total),
      existing, proved);
}

}  // namespace itin::cli
