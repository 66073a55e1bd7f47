#include "site/site_wording.hpp"

#include <cmath>

#include <fmt/format.h>

#include <viewshed/site_wording.hpp>

#include "options/nodata_option.hpp"
#include "output/store_document.hpp"

namespace itin::cli {

std::string amount(double quantity) {
  const bool is_whole = quantity == std::floor(quantity) && quantity < 1e15;
  return is_whole ? grouped(static_cast<std::uint64_t>(quantity)) : fmt::format("{:.6g}", quantity);
}

const char* unit_of_demand(const viewshed::SitePlan& r) {
  const viewshed::SiteDemand& demand = r.request.demand;
  return demand.is_cells_in_reach() ? " cells" : demand.premises ? " premises" : "";
}

std::string certainly(const viewshed::SitePlan& r) {
  return r.leaves_open ? "certainly " : "";
}

std::string undecided_in_words(const viewshed::SitePlan& r) {
  const bool heights = r.request.sums_heights();
  return fmt::format("{:.10g}{} {}{}, across ground without data; {} decides that", r.undecided, heights ? " m" : "",
                     r.request.turbines ? "of these" : "more",
                     heights ? "" : fmt::format(" ({:.1f} % of the demand)", r.undecided_percent()),
                     kDecidesMissingGround);
}

std::string amount_served_in_words(const viewshed::SitePlan& r) {
  return fmt::format("{} of a demand of {}{} ({:.1f} %)", amount(r.served()), amount(r.in_metric(r.inputs.total)),
                     unit_of_demand(r), r.served_percent());
}

std::string served_in_words(const viewshed::SitePlan& r) {
  const std::size_t chosen = r.choice.chosen.size(), existing = r.inputs.existing();
  return fmt::format("which {}{}serve{} {}",
                     existing > 0 ? fmt::format("together with {} ", counted(existing, "existing site"))
                     : chosen > 1 ? "together "
                                  : "",
                     certainly(r), chosen == 1 ? "s" : "", amount_served_in_words(r));
}

std::string cost_in_words(const viewshed::SitePlan& r) {
  const viewshed::Choice& choice = r.choice;
  if (!r.request.share && !r.request.budget) return {};
  std::string text = fmt::format("the sites cost {:.10g} in all", choice.cost);
  if (r.request.budget) text += fmt::format(", of a budget of {:.10g}", *r.request.budget);
  if (choice.least_cost)
    text += fmt::format("; no choice that serves {:.10g} % of the demand costs less than {:.10g}",
                        100 * *r.request.share, std::floor(*choice.least_cost * 1000) / 1000);
  return text;
}

std::string least_in_words(const viewshed::SitePlan& r) {
  const bool open = r.undecided > 0;
  const std::string proved = r.is_best()
                                 ? "proved to be the least there is"
                                 : fmt::format("no choice has less than {} (gap {:.1f} %)",
                                               amount(r.in_metric(r.choice.lower_bound)), gap_percent(r.choice));
  if (r.request.sums_heights())
    return fmt::format("visible height, summed: {}{:.10g} m; {}", open ? "at most " : "", r.in_metric(r.choice.value),
                       proved);
  const std::string existing =
      r.choice.existing > 0
          ? fmt::format(", besides {} from which {} {}seen already", amount(r.in_metric(r.choice.existing)),
                        r.inputs.existing() == 1 ? "an existing one is" : "existing ones are", certainly(r))
          : "";
  return fmt::format(
      "{} of a turbine {} seen from {} of a demand of {}{} ({:.1f} %){}; {}", minimised_part(*r.request.turbines),
      open ? "may be" : "is", amount(r.in_metric(r.choice.value)), amount(r.in_metric(r.inputs.total)),
      unit_of_demand(r),
      r.inputs.total == 0 ? 0 : 100 * static_cast<double>(r.choice.value) / static_cast<double>(r.inputs.total),
      existing, proved);
}

}  // namespace itin::cli
