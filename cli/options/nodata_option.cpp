#include "options/nodata_option.hpp"

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void NoDataOption::declare(CLI::App& app) {
  declare(
      app,
      "What ground without data does to a sight line: unknown (default) leaves it undecided unless known ground hides "
      "it, block hides the target, clear lets it pass");
}

void NoDataOption::declare(CLI::App& app, const std::string& help) {
  begin_group(app, kSurface);
  app.add_option("--nodata", text_, help)->type_name("unknown|block|clear");
}

NoData NoDataOption::rule() const {
  using enum NoData;
  constexpr NoData kChoices[] = {kUnknown, kBlock, kClear};
  return kChoices[parse_choice("--nodata", text_, {"unknown", "block", "clear"})];
}

}  // namespace itin::cli
