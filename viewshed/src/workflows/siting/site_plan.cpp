#include <fmt/format.h>

#include <profile/budget_text.hpp>
#include <viewshed/site_plan.hpp>
#include <viewshed/site_wording.hpp>

#include "workflows/siting/request_rules.hpp"

namespace itin::viewshed {

namespace {

/// Tells which chosen one an option is too near to stand beside.
std::string too_near(const SitePlan& plan, std::size_t option) {
  const Point2 place = plan.inputs.positions[option].position;
  for (const ChosenSite& site : plan.choice.chosen)
    if (!may_both_stand(plan.request, place, plan.place_of(site).position))
      return "stood too near " + plan.place_of(site).name;
  return "stood too near one chosen before, which was replaced";
}

/// Tells what an option would have added, and what the one added that was taken instead.
std::string gains_in_words(const SitePlan& plan, std::size_t option, const Margin& margin) {
  const bool exact = plan.surveys[option].exact || plan.heights;
  const double unit = plan.in_metric(1);
  return fmt::format("would have added {} {:.10g}{}; the one taken added {:.10g}",
                     exact                   ? "exactly"
                     : plan.request.turbines ? "at least"
                                             : "at most",
                     margin.upper * unit,
                     plan.request.budget        ? " per unit of cost"
                     : plan.request.has_links() ? " per site, with the relays that it needs"
                                                : "",
                     margin.chosen * unit);
}

std::string meaning_of_served(const SitePlanRequest& request) {
  if (request.sums_heights())
    return "To be least: the part of a turbine from its tip down that is seen, in metres, summed over all turbines and "
           "over the demand with its weights; what one place sees of several turbines counts for each";
  if (request.turbines)
    return fmt::format("To be least: the demand that has a clear line of sight to {} of at least one turbine",
                       minimised_part(*request.turbines));
  if (request.by_level())
    return fmt::format(
        "A target is served if its receiver gets at least {:g} dBm from a site in clear air, the sensitivity of {:g} "
        "dBm "
        "and {:g} dB more, at {:g} GHz: {}, less free space, diffraction (ITU-R P.526, delta-Bullington) and gases "
        "(P.676)",
        request.least_dbm(), *request.link_budget.sensitivity_dbm, request.margin_db, *request.frequency_ghz,
        profile::radios_text(request.link_budget));
  if (!request.frequency_ghz) return "A target is served if it has a clear line of sight to a site";
  return fmt::format(
      "A target is served if it has a clear line of sight to a site that leaves at least {:g} of the first Fresnel "
      "zone's radius clear of the surface everywhere between, at {:g} GHz (wavelength {:.6g} m = 0.299792458 / f; F1 = "
      "sqrt(wavelength d1 d2 / (d1 + d2)))",
      request.fresnel, *request.frequency_ghz, wavelength_m(*request.frequency_ghz));
}

}  // namespace

double SitePlan::served() const {
  return in_metric(choice.value + choice.existing);
}

double SitePlan::served_percent() const {
  return inputs.total == 0 ? 0 : 100 * served() / in_metric(inputs.total);
}

double SitePlan::undecided_percent() const {
  return inputs.total == 0 ? 0 : 100 * undecided / in_metric(inputs.total);
}

std::size_t SitePlan::refined() const {
  return static_cast<std::size_t>(
      std::count_if(surveys.begin(), surveys.end(), [](const OptionSurvey& survey) { return survey.stage > 0; }));
}

bool SitePlan::is_chosen(std::size_t option) const {
  return std::any_of(choice.chosen.begin(), choice.chosen.end(),
                     [&](const ChosenSite& site) { return site.option == option; });
}

std::string SitePlan::reason(std::size_t option) const {
  if (is_chosen(option)) return "chosen";
  const std::optional<Margin>& margin = choice.closest[option];
  if (!margin)
    return request.turbines ? "ruled out at every step by the spacing"
                            : "ruled out at every step: by spacing, links, cost, or another mast at its place";
  using enum Margin::Outcome;
  if (margin->outcome == kTaken)
    return fmt::format("taken at step {} of the first selection, and replaced by a better choice", margin->step + 1);
  const std::string at_step = fmt::format("at step {} of the first selection it ", margin->step + 1),
                    gains = gains_in_words(*this, option, *margin);
  if (margin->outcome == kOutbid) return at_step + gains;
  return at_step +
         (margin->outcome == kTooNear ? too_near(*this, option) : "would have left too few places for the others") +
         "; it " + gains;
}

std::string SitePlan::meaning() const {
  const std::string served = meaning_of_served(request);
  if (!leaves_open) return served;
  return served + "; what only ground without data could hide is undecided, and " +
         (request.turbines ? "counts as seen" : "does not count");
}

}  // namespace itin::viewshed
