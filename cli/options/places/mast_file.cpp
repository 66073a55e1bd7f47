#include "options/places/mast_file.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "program/call_files.hpp"

namespace itin::cli {

CLI::Option* declare_mast_file(CLI::App& app, const MastFile& file, SiteQuery& query) {
  std::string rows = file.what;
  rows.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(rows.front())));
  CLI::Option* const option =
      app.add_option(file.option, query.path,
                     fmt::format("{} from a vector file, or from CSV with columns x,y or lon,lat", file.what))
          ->type_name("FILE");
  reads(option);
  app.add_option("--layer", query.layer, "The layer of that file")->type_name("NAME");
  app.add_option("--where", query.where, fmt::format("Only {} that this SQL condition holds for", rows))
      ->type_name("SQL");
  app.add_option("--name-field", query.name_field,
                 fmt::format("The field that holds names (default: {})", file.unnamed))
      ->type_name("FIELD");
  app.add_option("--height-field", query.height_field,
                 "The field that holds each mast's height (default: height, unless --mast-height is given)")
      ->type_name("FIELD");
  return option;
}

}  // namespace itin::cli
