#include "report/tables/budget_table.hpp"

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <profile/budget_text.hpp>

namespace itin::profile {

namespace {

std::string decibels(double value, const char* unit = "dB") {
  return fmt::format("{:.1f} {}", value, unit);
}

class BudgetRows {
 public:
  BudgetRows(const LinkBudget& budget, const BudgetQuery& query) : budget_(budget), query_(query) {}

  std::vector<std::vector<std::string>> all() {
    add_first_end();
    add_path();
    add_second_end();
    add_fading();
    return std::move(rows_);
  }

 private:
  void add(const std::string& name, const std::string& value) { rows_.push_back({name, value}); }
  void add_end(const char* end, double gain, const std::optional<double>& feeder) {
    add(fmt::format("Antenna gain, {}", end), decibels(gain, "dBi"));
    if (feeder) add(fmt::format("Feeder loss, {}", end), decibels(*feeder));
  }
  void add_off_axis(const char* end, const AimedAntenna& antenna, double loss) {
    if (antenna.pattern) add(fmt::format("Off the axis of the antenna, {}", end), decibels(loss));
  }
  void add_first_end() {
    if (query_.power_dbm) {
      add("Power of the transmitter (A)", decibels(*query_.power_dbm, "dBm"));
      add_end("A", budget_.from_gain_dbi, query_.from_feeder_db);
    }
    add("EIRP", decibels(budget_.eirp_dbm, "dBm"));
    add_off_axis("A", query_.from_antenna, budget_.from_off_axis_db);
  }
  void add_path() {
    add("Free space (P.525)", decibels(budget_.free_space_db));
    add("Diffraction, delta-Bullington (P.452)", decibels(budget_.diffraction_db));
    if (budget_.gases_db) add("Gases (P.676-13)", decibels(*budget_.gases_db));
  }
  void add_second_end() {
    add_end("B", budget_.to_gain_dbi, query_.to_feeder_db);
    add_off_axis("B", query_.to_antenna, budget_.to_off_axis_db);
    add("Level at the receiver (B), clear air", decibels(budget_.level_dbm, "dBm"));
    if (!budget_.margin_db) return;
    add("Sensitivity", decibels(*query_.sensitivity_dbm, "dBm"));
    add("Margin for fades", decibels(*budget_.margin_db));
  }
  void add_fading() {
    if (budget_.rain) add_rain();
    if (budget_.multipath) add_multipath();
    if (!budget_.availability) return;
    add("Availability", availability_text(*budget_.availability));
    add("Out for", minutes_text(*budget_.availability));
  }
  void add_rain() {
    add(fmt::format("Rain of {:g} mm/h (P.838-3)", *query_.rain_rate_mm_h),
        fmt::format("{:.2f} dB/km over {:.1f} km", budget_.rain->specific_db_km, budget_.rain->effective_km));
    add("Exceeded for 0.01 % of the year (P.530-18)", decibels(budget_.rain->exceeded_db));
    if (budget_.rain_outage) add("Out by rain, of the year", outage_text(*budget_.rain_outage));
  }
  void add_multipath() {
    add("Geoclimatic factor K (P.530-17)", fmt::format("{:.3g}", budget_.multipath->geoclimatic_factor));
    if (budget_.multipath->occurrence_percent == 0) return add("Multipath", no_multipath_text());
    add("Multipath occurrence p0", significant(budget_.multipath->occurrence_percent, 3) + " %");
    if (!budget_.multipath_outage) return;
    add("Out by multipath, of the worst month", significant(*budget_.multipath->worst_month_percent, 2) + " %");
    add("Out by multipath, of the year", outage_text(*budget_.multipath_outage));
  }

  const LinkBudget& budget_;
  const BudgetQuery& query_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace

Table budget_table(const LosReport& report) {
  return {"Link budget",
          {},
          BudgetRows(*report.budget, report.query.budget).all(),
          "Not counted: " + not_counted_text(*report.budget) + ".",
          true};
}

}  // namespace itin::profile
