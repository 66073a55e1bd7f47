#include "dwellings/flicker_options.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/sun.hpp>

#include "options/day_of_run.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

/// Reads how far a clock is ahead of universal time, minutes: UTC, +1, -3:30, UTC+5:45.
int parse_time_zone(const std::string& text) {
  std::string rest = text.starts_with("UTC") ? text.substr(3) : text;
  if (rest.empty()) return 0;
  const auto wrong = [&] {
    return InputError(fmt::format("--time-zone '{}': give hours ahead of UTC, such as +1, -3:30 or UTC", text));
  };
  const bool behind = rest.front() == '-';
  if (behind || rest.front() == '+') rest.erase(0, 1);
  const std::size_t colon = rest.find(':');
  const std::string hours = rest.substr(0, colon), minutes = colon == std::string::npos ? "0" : rest.substr(colon + 1);
  const auto h = whole_text_as<int>(hours), m = whole_text_as<int>(minutes);
  if (!h || !m || *h < 0 || *h > 14 || *m < 0 || *m > 59 || (*h == 14 && *m > 0)) throw wrong();
  return (behind ? -1 : 1) * (60 * *h + *m);
}

/// Reads hours a year and minutes a day into the rules.
void parse_limits(const std::string& text, viewshed::FlickerRules& rules) {
  const auto number = [&](std::string_view part, std::string_view unit) {
    const auto value =
        part.ends_with(unit) ? whole_text_as<double>(part.substr(0, part.size() - unit.size())) : std::nullopt;
    if (!value || *value < 0)
      throw InputError(fmt::format("--limits '{}': give hours a year and minutes a day, such as 30h,30min", text));
    return *value;
  };
  const std::string_view all = text;
  const std::size_t comma = std::min(all.find(','), all.size());
  rules.limit_minutes_year = 60 * number(all.substr(0, comma), "h");
  rules.limit_minutes_day = number(all.substr(std::min(comma + 1, all.size())), "min");
}

}  // namespace

void FlickerOptions::declare(CLI::App& app) {
  begin_group(app, "Shadow flicker");
  app.add_option("--year", year_text_, "The year whose minutes are looked at (default: the year of the run)")
      ->type_name("YEAR");
  app.add_option("--time-zone", zone_text_,
                 "How far the clock of the calendar is ahead of UTC, summer and winter: +1, -3:30 (default: UTC)")
      ->type_name("HOURS");
  app.add_option("--limits", limits_text_,
                 "How much flicker a dwelling may have in a year and on a day, in the worst case (default: 30h,30min)")
      ->type_name("HOURS,MINUTES");
  reads(
      app.add_option("--months", months_,
                     "Tell the likely flicker as well, by a table with the columns month (1 to 12), sunshine (the part "
                     "of daylight in which the sun shines, 0 to 1) and operation (the part of the time in which the "
                     "turbines turn); one of the two may be missing"))
      ->type_name("FILE");
  app.add_option("--sun-elevation", elevation_text_, "A lower sun throws no shadow: degrees, 1 or more (default: 3)")
      ->type_name("DEGREES");
  app.add_option("--flicker-reach", reach_text_,
                 "How far a turbine's shadow reaches, in diameters of its rotor (default: 10)")
      ->type_name("DIAMETERS");
  app.add_option("--blade-width", blade_text_,
                 fmt::format("Let shadows reach as far as a blade of this mean width hides a fifth of the sun: {:g} "
                             "widths",
                             viewshed::kReachOfBlade))
      ->type_name("METRES");
}

void FlickerOptions::validate() {
  rules_.year.year = year_text_.empty() ? static_cast<int>(day_of_run().year())
                                        : parse_whole("--year", year_text_, kFirstYearOfSun, kLastYearOfSun);
  if (!zone_text_.empty()) rules_.year.utc_offset_minutes = parse_time_zone(zone_text_);
  if (!limits_text_.empty()) parse_limits(limits_text_, rules_);
  if (!elevation_text_.empty()) rules_.least_elevation_deg = parse_number("--sun-elevation", elevation_text_);
  if (!reach_text_.empty() && !blade_text_.empty())
    throw InputError("--flicker-reach and --blade-width exclude each other");
  if (!reach_text_.empty()) rules_.reach_diameters = parse_number("--flicker-reach", reach_text_, Range::kPositive);
  if (!blade_text_.empty()) rules_.blade_width = parse_number("--blade-width", blade_text_, Range::kPositive);
  if (!months_.empty()) rules_.months = viewshed::read_months(months_);
}

Document FlickerOptions::parameters() const {
  Document p{{"year", rules_.year.year},
             {"utc_offset_minutes", rules_.year.utc_offset_minutes},
             {"limit_hours_year", rules_.limit_minutes_year / 60},
             {"limit_minutes_day", rules_.limit_minutes_day},
             {"sun_elevation_deg", rules_.least_elevation_deg}};
  if (rules_.blade_width)
    p["blade_width_m"] = *rules_.blade_width;
  else
    p["flicker_reach_diameters"] = rules_.reach_diameters;
  if (!months_.empty()) p["months"] = months_;
  return p;
}

}  // namespace itin::cli
