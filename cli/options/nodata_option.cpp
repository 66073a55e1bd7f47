#include "options/nodata_option.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "program/values.hpp"

namespace itin::cli {

void NoDataOption::declare(CLI::App& app) {
  declare(app, fmt::format("What ground without data does to sight lines (default: {})", text_));
}

void NoDataOption::declare(CLI::App& app, const std::string& help) {
  app.add_option("--nodata", text_, help)->type_name(fmt::format("{}", fmt::join(choices_, "|")));
}

NoData NoDataOption::rule() const {
  const std::string_view choice = choices_[parse_choice("--nodata", text_, choices_)];
  return choice == "block" ? NoData::kBlock : choice == "clear" ? NoData::kClear : NoData::kUnknown;
}

}  // namespace itin::cli
