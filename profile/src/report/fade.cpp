#include "report/fade.hpp"

#include <fmt/format.h>

#include <profile/report_text.hpp>

#include "lines/findings.hpp"

namespace itin::profile {

const CriterionResult* worst_fade(const LosReport& report) {
  const CriterionResult* worst = nullptr;
  for (const CriterionResult& c : report.criteria) {
    const bool bulges_more =
        1 / (2 * c.criterion.k * report.query.earth.radius) > report.query.earth.drop_coefficient();
    if (bulges_more && (worst == nullptr || c.criterion.k < worst->criterion.k)) worst = &c;
  }
  return worst;
}

std::string fade_line(const CriterionResult& fade) {
  return fmt::format("At K = {:.4g}, where {:g} F1 is wanted: {}.", fade.criterion.k, fade.criterion.fraction,
                     outcome_text(fade));
}

LosReport over_earth_of(const LosReport& report, const CriterionResult& fade) {
  LosReport there = report;
  there.query.earth = earth_of(fade.criterion, report.query.earth);
  there.query.criteria.clear();
  there.losses.reset(), there.reflection.reset();
  static_cast<LineFindings&>(there) = findings({there.profile, there.antennas, there.stands_on}, there.query);
  return there;
}

}  // namespace itin::profile
