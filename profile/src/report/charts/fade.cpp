#include "report/charts/fade.hpp"

#include <fmt/format.h>

#include <profile/radio_text.hpp>
#include <profile/report_text.hpp>

#include "lines/findings.hpp"

namespace itin::profile {

const CriterionResult* worst_fade(const LosReport& report) {
  const CriterionResult* worst = nullptr;
  for (const CriterionResult& c : report.criteria) {
    const Earth& earth = report.query.earth;
    const bool bulges_more = with_factor(c.k, earth).drop_coefficient() > earth.drop_coefficient();
    if (bulges_more && (worst == nullptr || c.k < worst->k)) worst = &c;
  }
  return worst;
}

std::string fade_line(const CriterionResult& fade, DistanceUnit unit) {
  return fmt::format("At K = {}, where {:g} F1 is wanted: {}{}.", factor_text(fade.criterion, fade.k),
                     fade.criterion.fraction, outcome_text(fade, unit), least_fraction_text(fade, unit));
}

LosReport over_earth_of(const LosReport& report, const CriterionResult& fade) {
  LosReport there = report;
  there.query.earth = with_factor(fade.k, report.query.earth);
  there.query.criteria.clear();
  there.losses.reset(), there.reflection.reset();
  const Sight sight{there.profile, there.antennas, there.stands_on};
  static_cast<LineFindings&>(there) = findings(sight, there.query);
  add_obstructions(sight, there.query, there);
  return there;
}

}  // namespace itin::profile
