#include "report/budget_document.hpp"

#include <optional>

namespace itin::profile {

namespace {

/// Adds how much of the year a link is out by one cause.
void add_outage(const std::optional<Outage>& outage, Document& document) {
  document["outage_percent"] = outage ? Document(outage->percent) : Document(nullptr);
  document["outage_at_most"] = outage ? Document(outage->at_most) : Document(nullptr);
}

Document rain_document(const LinkBudget& budget, const BudgetQuery& query) {
  if (!budget.rain) return nullptr;
  Document rain{{"rate_mm_h", *query.rain_rate_mm_h},
                {"specific_db_km", budget.rain->specific_db_km},
                {"effective_km", budget.rain->effective_km},
                {"exceeded_0_01_db", budget.rain->exceeded_db}};
  add_outage(budget.rain_outage, rain);
  return rain;
}

Document multipath_document(const LinkBudget& budget) {
  if (!budget.multipath) return nullptr;
  Document multipath{{"geoclimatic_factor", budget.multipath->geoclimatic_factor},
                     {"occurrence_percent", budget.multipath->occurrence_percent},
                     {"worst_month_percent", number_or_null(budget.multipath->worst_month_percent)}};
  add_outage(budget.multipath_outage, multipath);
  return multipath;
}

Document availability_document(const LinkBudget& budget) {
  if (!budget.availability) return nullptr;
  return {{"percent", budget.availability->percent},
          {"outage_minutes", budget.availability->outage_minutes},
          {"at_least", budget.availability->at_least}};
}

}  // namespace

Document budget_document(const LosReport& report) {
  const LinkBudget& budget = *report.budget;
  const BudgetQuery& query = report.query.budget;
  return {{"power_dbm", number_or_null(query.power_dbm)},
          {"eirp_dbm", budget.eirp_dbm},
          {"off_axis1_db", budget.from_off_axis_db},
          {"free_space_db", budget.free_space_db},
          {"diffraction_db", budget.diffraction_db},
          {"gases_db", number_or_null(budget.gases_db)},
          {"gain2_dbi", budget.to_gain_dbi},
          {"off_axis2_db", budget.to_off_axis_db},
          {"feeder_loss2_db", query.to_feeder_db.value_or(0)},
          {"level_dbm", budget.level_dbm},
          {"sensitivity_dbm", number_or_null(query.sensitivity_dbm)},
          {"margin_db", number_or_null(budget.margin_db)},
          {"rain", rain_document(budget, query)},
          {"multipath", multipath_document(budget)},
          {"availability", availability_document(budget)},
          {"left_out", budget.left_out},
          {"never_counted", kNeverInBudgets}};
}

}  // namespace itin::profile
