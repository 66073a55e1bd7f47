// A file of masts, or of places where they may stand.
#pragma once

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>

namespace itin::cli {

/// What a verb calls the file and its rows.
struct MastFile {
  const char* option;   ///< "--masts"
  const char* what;     ///< "Masts"
  const char* unnamed;  ///< which names rows have where no field is given
};

/// Declares the option of the file, --layer, --where, --name-field and --height-field. Returns the first.
CLI::Option* declare_mast_file(CLI::App& app, const MastFile& file, SiteQuery& query);

}  // namespace itin::cli
