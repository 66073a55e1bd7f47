// Whose report of a line it is: project, operator, date, and the names of its ends.
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
  /// Throws InputError: names of ends where a table of links has its own.
  void validate(bool links);
  /// What the report begins with: name, value.
  std::vector<std::pair<std::string, std::string>> facts() const;
  /// The day for which magnetic azimuths are given; nothing where the date is no day.
  std::optional<CalendarDay> day() const;
  /// Why there are no magnetic azimuths, where a date is given; else empty.
  std::string warning() const;
  const std::string& from_name() const { return from_name_; }
  const std::string& to_name() const { return to_name_; }
  Document parameters() const;

 private:
  std::string project_, operator_, date_, from_name_, to_name_;
};

}  // namespace itin::cli
