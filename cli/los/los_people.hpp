// The people behind a report of a line: project, operator, date, and the names of its ends.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/calendar_day.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class LosPeople {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError for names of ends where `links` have their own.
  void validate(bool links);
  /// The facts that the report begins with: name, value.
  std::vector<std::pair<std::string, std::string>> facts() const;
  /// The day for which magnetic azimuths are given; nothing where the date is not a day.
  std::optional<CalendarDay> day() const;
  /// The reason why there are no magnetic azimuths for the given date; empty where there are some, or no date is given.
  std::string warning() const;
  const std::string& from_name() const { return from_name_; }
  const std::string& to_name() const { return to_name_; }
  Document parameters() const;

 private:
  std::string project_, operator_, date_, from_name_, to_name_;
};

}  // namespace itin::cli
