#include "los/los_people.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/magnetic_north.hpp>

#include "options/day_of_run.hpp"
#include "program/help.hpp"

namespace itin::cli {

void LosPeople::declare(CLI::App& app) {
  begin_group(app, "Reports");
  app.add_option("--project", project_, "The project, named at the head of the report")->type_name("TEXT");
  app.add_option("--operator", operator_, "Who makes the report or answers for it, named there as well")
      ->type_name("TEXT");
  app.add_option("--date", date_,
                 "The date of the report, named there as well; for a day, such as 2026-11-23 or 23 November 2026, "
                 "magnetic azimuths are given (default: the day of the run, UTC, where a project or an operator is "
                 "given; else none, so that equal calls write equal bytes)")
      ->type_name("TEXT");
  app.add_option("--from-name", from_name_, "What the first end is called")->type_name("TEXT");
  app.add_option("--to-name", to_name_, "What the second end is called")->type_name("TEXT");
}

void LosPeople::validate(bool links) {
  if (links && !(from_name_.empty() && to_name_.empty()))
    throw InputError("--from-name and --to-name are those of one line; with --links give columns name1 and name2");
  if (date_.empty() && !(project_.empty() && operator_.empty())) date_ = day_text(day_of_run());
}

std::vector<std::pair<std::string, std::string>> LosPeople::facts() const {
  std::vector<std::pair<std::string, std::string>> facts;
  for (const auto& [name, value] : {std::pair("Project", project_), {"Operator", operator_}, {"Date", date_}})
    if (!value.empty()) facts.emplace_back(name, value);
  return facts;
}

std::optional<CalendarDay> LosPeople::day() const {
  return parse_day(date_);
}

std::string LosPeople::warning() const {
  if (date_.empty()) return {};
  if (!day())
    return fmt::format(
        "--date '{}' is no day such as 2026-11-23 or 23 November 2026, so that no magnetic azimuths are given", date_);
  if (has_declination(*day())) return {};
  return fmt::format("no magnetic azimuths are given for {}, the report's date; {}", day_text(*day()),
                     magnetic_model_text());
}

Document LosPeople::parameters() const {
  Document parameters = Document::object();
  for (const auto& [name, value] : {std::pair("project", project_),
                                    {"operator", operator_},
                                    {"date", date_},
                                    {"from_name", from_name_},
                                    {"to_name", to_name_}})
    if (!value.empty()) parameters[name] = value;
  return parameters;
}

}  // namespace itin::cli
