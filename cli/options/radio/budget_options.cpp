#include "options/radio/budget_options.hpp"

#include <memory>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/multipath_fading.hpp>
#include <profile/rain_loss.hpp>

#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

/// Reads a value for both ends, or one for each. With an EIRP, a single value is that of the second end.
void take_of_ends(const char* option, const std::string& text, bool eirp, std::optional<double>& from,
                  std::optional<double>& to) {
  if (text.empty()) return;
  const std::vector<double> values = parse_numbers(option, text);
  if (values.size() > 2)
    throw InputError(fmt::format("{} '{}': give one value for both ends, or two, a,b", option, text));
  if (!eirp || values.size() == 2) from = values.front();
  to = values.back();
}

using AntennaFile = std::shared_ptr<const profile::AntennaPattern>;
AntennaFile pattern_of(const std::string& path) {
  if (path.empty()) return nullptr;
  return std::make_shared<const profile::AntennaPattern>(profile::read_antenna_pattern(path));
}

/// Reads degrees of the first end and, behind a comma, of the second; `aim` stands for none.
void take_degrees(const char* option, const std::string& text, std::optional<double>& from, std::optional<double>& to) {
  if (text.empty()) return;
  const std::size_t comma = text.find(',');
  const auto take = [&](const std::string& degrees, std::optional<double>& value) {
    if (degrees != "aim") value = parse_number(option, degrees, Range::kAny);
  };
  take(text.substr(0, comma), from);
  if (comma != std::string::npos) take(text.substr(comma + 1), to);
}

}  // namespace

void BudgetOptions::declare(CLI::App& app, const Ends& ends) {
  begin_group(app, "Link budget");
  app.add_option("--power-dbm", power_text_,
                 fmt::format("Power of the transmitter at {}; asks for a link budget", ends.first))
      ->type_name("DBM");
  app.add_option("--eirp-dbm", eirp_text_,
                 fmt::format("What {} radiates, its antenna and feeder included, instead", ends.first))
      ->type_name("DBM");
  app.add_option("--gain-dbi", gain_text_,
                 "Gain of both antennas, or of each; with --eirp-dbm, of the second alone; 0 unless the file of a "
                 "pattern has it")
      ->type_name("DBI[,DBI]");
  app.add_option("--feeder-loss-db", feeder_text_, "Loss between each radio and its antenna, likewise")
      ->type_name("DB[,DB]");
  app.add_option("--sensitivity-dbm", sensitivity_text_,
                 fmt::format("Least level that the receiver works with: gives the margin for fades{}",
                             ends.single ? " and, with rain or multipath, the availability"
                                         : " and, with rain, the minutes of outage"))
      ->type_name("DBM");
  declare_rain(app);
  if (ends.single) declare_multipath(app);
  for (const auto& [option, end, path] : {std::tuple("--from-antenna", ends.first, &from_antenna_path_),
                                          {"--to-antenna", ends.second, &to_antenna_path_}})
    reads(app.add_option(option, *path, fmt::format("Pattern of the antenna at {}: MSI (.msi, .pln), or .ant", end))
              ->type_name("FILE"));
  app.add_option("--antenna-azimuth", azimuth_text_,
                 fmt::format("Where the antenna at {} points, from grid north, and the one at {}: degrees, or aim for "
                             "the other end. {}",
                             ends.first, ends.second,
                             ends.single ? "Without it, both aim"
                                         : "A pattern of the first needs it; without it, the second aims"))
      ->type_name("DEG[,DEG]");
  app.add_option("--antenna-tilt", tilt_text_, "How far they are tilted below the horizontal, likewise")
      ->type_name("DEG[,DEG]");
}

void BudgetOptions::declare_rain(CLI::App& app) {
  app.add_option(
         "--rain-rate-mm-h", rain_text_,
         "Rate of rain that is exceeded for 0.01 % of an average year (P.837): gives losses and outage by rain, "
         "P.838-3 and P.530-18; 1 to 100 GHz, up to 60 km")
      ->type_name("MM/H");
}

void BudgetOptions::declare_multipath(CLI::App& app) {
  app.add_option("--geoclimatic-factor", factor_text_,
                 "Geoclimatic factor K of P.530-17: gives outage by multipath, by its method for quick planning; up to "
                 "45 GHz")
      ->type_name("K");
  app.add_option("--refractivity-gradient", gradient_text_,
                 "Gradient of refractivity in the lowest 65 m that is not exceeded for 1 % of an average year (dN1 of "
                 "P.453), in N-units per km, such as -300; instead, K = 10^(-4.6 - 0.0027 dN1)")
      ->type_name("N/KM");
}

void BudgetOptions::validate() {
  const auto take = [](const char* option, const std::string& text, std::optional<double>& value) {
    if (!text.empty()) value = parse_number(option, text, Range::kAny);
  };
  take("--power-dbm", power_text_, query_.power_dbm);
  take("--eirp-dbm", eirp_text_, query_.eirp_dbm);
  const bool eirp = query_.eirp_dbm.has_value();
  take_of_ends("--gain-dbi", gain_text_, eirp, query_.from_gain_dbi, query_.to_gain_dbi);
  take_of_ends("--feeder-loss-db", feeder_text_, eirp, query_.from_feeder_db, query_.to_feeder_db);
  take("--sensitivity-dbm", sensitivity_text_, query_.sensitivity_dbm);
  take("--rain-rate-mm-h", rain_text_, query_.rain_rate_mm_h);
  take("--geoclimatic-factor", factor_text_, query_.geoclimatic_factor);
  take("--refractivity-gradient", gradient_text_, query_.refractivity_gradient);
  profile::AimedAntenna &from = query_.from_antenna, &to = query_.to_antenna;
  from.pattern = pattern_of(from_antenna_path_), to.pattern = pattern_of(to_antenna_path_);
  take_degrees("--antenna-azimuth", azimuth_text_, from.azimuth_deg, to.azimuth_deg);
  take_degrees("--antenna-tilt", tilt_text_, from.tilt_deg, to.tilt_deg);
}

void BudgetOptions::require_frequency(const std::optional<profile::RadioPath>& radio) const {
  query_.validate();
  if (!query_.asks()) return;
  if (!radio) throw InputError(fmt::format("{} needs a --frequency", query_.power_dbm ? "--power-dbm" : "--eirp-dbm"));
  using namespace profile;
  const double ghz = radio->frequency_ghz;
  if (query_.rain_rate_mm_h && (ghz < kRainFrom || ghz > kRainTo))
    throw InputError(
        fmt::format("--rain-rate-mm-h is for {:g} to {:g} GHz, the range of P.530, not for {:g} GHz; leave "
                    "it out",
                    kRainFrom, kRainTo, ghz));
  const char* multipath = query_.geoclimatic_factor ? "--geoclimatic-factor" : "--refractivity-gradient";
  if ((query_.geoclimatic_factor || query_.refractivity_gradient) && ghz > kMultipathTo)
    throw InputError(fmt::format("{} is for up to {:g} GHz, the range of P.530, not for {:g} GHz; leave it out",
                                 multipath, kMultipathTo, ghz));
}

void BudgetOptions::require_for_links() const {
  profile::BudgetQuery query = query_;
  if (!query.asks()) query.power_dbm = 0;
  query.validate();
}

Document BudgetOptions::parameters() const {
  Document parameters = Document::object();
  const auto add = [&](const char* name, const std::optional<double>& value) {
    if (value) parameters[name] = *value;
  };
  add("power_dbm", query_.power_dbm);
  add("eirp_dbm", query_.eirp_dbm);
  add("gain1_dbi", query_.from_gain_dbi);
  add("gain2_dbi", query_.to_gain_dbi);
  add("feeder_loss1_db", query_.from_feeder_db);
  add("feeder_loss2_db", query_.to_feeder_db);
  add("sensitivity_dbm", query_.sensitivity_dbm);
  add("rain_rate_mm_h", query_.rain_rate_mm_h);
  add("geoclimatic_factor", query_.geoclimatic_factor);
  add("refractivity_gradient", query_.refractivity_gradient);
  for (const auto& [end, path, antenna] : {std::tuple("antenna1", &from_antenna_path_, &query_.from_antenna),
                                           {"antenna2", &to_antenna_path_, &query_.to_antenna}}) {
    if (path->empty()) continue;
    const auto degrees = [](const std::optional<double>& value) { return value ? Document(*value) : Document("aim"); };
    parameters[end] = {
        {"pattern", *path}, {"azimuth_deg", degrees(antenna->azimuth_deg)}, {"tilt_deg", degrees(antenna->tilt_deg)}};
  }
  return parameters;
}

}  // namespace itin::cli
