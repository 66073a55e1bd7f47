// What a link budget can be asked.
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/antenna_loss.hpp>
#include <profile/diffraction.hpp>

namespace itin::profile {

namespace {

using BudgetField = std::pair<const char*, std::optional<double> BudgetQuery::*>;

constexpr BudgetField kPowers[] = {{"power_dbm", &BudgetQuery::power_dbm}, {"eirp_dbm", &BudgetQuery::eirp_dbm}};
/// The fields that say nothing without one of these.
constexpr BudgetField kWithPower[] = {{"gain_dbi", &BudgetQuery::from_gain_dbi},
                                      {"gain_dbi", &BudgetQuery::to_gain_dbi},
                                      {"feeder_loss_db", &BudgetQuery::from_feeder_db},
                                      {"feeder_loss_db", &BudgetQuery::to_feeder_db},
                                      {"sensitivity_dbm", &BudgetQuery::sensitivity_dbm},
                                      {"rain_rate_mm_h", &BudgetQuery::rain_rate_mm_h},
                                      {"geoclimatic_factor", &BudgetQuery::geoclimatic_factor},
                                      {"refractivity_gradient", &BudgetQuery::refractivity_gradient}};

[[noreturn]] void refuse(const char* field, const std::string& why) {
  throw InputError(fmt::format("`{}`{}", field, why), field);
}

void require_finite(const BudgetQuery& query, std::span<const BudgetField> fields) {
  for (const auto& [name, member] : fields)
    if (const auto value = query.*member; value && !std::isfinite(*value)) refuse(name, ": give a finite number");
}

void require_power(const BudgetQuery& query) {
  if (query.power_dbm && query.eirp_dbm)
    refuse("eirp_dbm", " and `power_dbm`: give one; the EIRP is the power with the first end's gain and feeder");
  if (query.asks()) return;
  for (const auto& [name, member] : kWithPower)
    if (query.*member) refuse(name, " works only with `power_dbm` or `eirp_dbm`");
  for (const auto& [name, antenna] :
       {std::pair("from_antenna", &query.from_antenna), {"to_antenna", &query.to_antenna}})
    if (antenna->pattern) refuse(name, " works only with `power_dbm` or `eirp_dbm`");
}

void require_one_first_end(const BudgetQuery& query) {
  if (!query.eirp_dbm) return;
  if (query.from_gain_dbi)
    refuse("gain_dbi", ": the first end's gain is in `eirp_dbm` already; give the second end's alone");
  if (query.from_feeder_db)
    refuse("feeder_loss_db", ": the first end's loss is in `eirp_dbm` already; give the second end's alone");
}

void require_patterns(const BudgetQuery& query) {
  for (const auto& [name, antenna] :
       {std::pair("from_antenna", &query.from_antenna), {"to_antenna", &query.to_antenna}}) {
    for (const auto& [aim, value] :
         {std::pair("antenna_azimuth", antenna->azimuth_deg), {"antenna_tilt", antenna->tilt_deg}}) {
      if (!value) continue;
      if (!antenna->pattern) refuse(aim, fmt::format(" needs `{}`, the pattern of that end's antenna", name));
      if (!std::isfinite(*value)) refuse(aim, ": give a finite number");
    }
    if (const auto tilt = antenna->tilt_deg; tilt && !is_tilt(*tilt))
      refuse("antenna_tilt", fmt::format(" {:g}: give {:g} to {:g} degrees", *tilt, -kMostTilt, kMostTilt));
    if (const auto azimuth = antenna->azimuth_deg; azimuth && !is_azimuth(*azimuth))
      refuse("antenna_azimuth", fmt::format(" {:g}: give {:g} to {:g} degrees", *azimuth, kLeastAzimuth, kMostAzimuth));
  }
}

void require_likely(const BudgetQuery& query) {
  for (const auto loss : {query.from_feeder_db, query.to_feeder_db})
    if (loss && *loss < 0) refuse("feeder_loss_db", fmt::format(" {:g}: a loss is not negative", *loss));
  if (const auto level = query.sensitivity_dbm; level && *level > 0)
    refuse("sensitivity_dbm", fmt::format(" {:g}: receivers work with less than 0 dBm; is it -{:g}?", *level, *level));
  if (const auto rate = query.rain_rate_mm_h; rate && *rate <= 0)
    refuse("rain_rate_mm_h", fmt::format(" {:g}: give a rate above 0", *rate));
  if (const auto factor = query.geoclimatic_factor; factor && *factor <= 0)
    refuse("geoclimatic_factor", fmt::format(" {:g}: give a factor above 0, such as 1e-4", *factor));
  if (const auto gradient = query.refractivity_gradient; gradient && *gradient >= 0)
    refuse("refractivity_gradient",
           fmt::format(" {:g}: the gradient that is not exceeded for 1 % of the year is negative, such as -300",
                       *gradient));
}

}  // namespace

BudgetQuery BudgetQuery::with(const BudgetQuery& own) const {
  BudgetQuery query = *this;
  if (own.power_dbm) query.eirp_dbm.reset();
  if (own.eirp_dbm) query.power_dbm.reset(), query.from_gain_dbi.reset(), query.from_feeder_db.reset();
  if (own.geoclimatic_factor) query.refractivity_gradient.reset();
  if (own.refractivity_gradient) query.geoclimatic_factor.reset();
  const auto take = [&](std::span<const BudgetField> fields) {
    for (const auto& [name, member] : fields)
      if (own.*member) query.*member = own.*member;
  };
  take(kPowers), take(kWithPower);
  if (own.from_antenna.pattern) query.from_antenna = own.from_antenna;
  if (own.to_antenna.pattern) query.to_antenna = own.to_antenna;
  return query;
}

void BudgetQuery::validate() const {
  require_finite(*this, kPowers);
  require_finite(*this, kWithPower);
  require_power(*this);
  require_one_first_end(*this);
  if (geoclimatic_factor && refractivity_gradient)
    refuse("refractivity_gradient", " and `geoclimatic_factor`: give one; the gradient serves to estimate the factor");
  require_patterns(*this);
  require_likely(*this);
}

}  // namespace itin::profile
