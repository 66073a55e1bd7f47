// What is seen of the turbines along roads and paths: `--route`, `--every`.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/paths.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// Returns the name of a route; `number` counts the lines of the file from 1.
std::string route_name(const Path& route, std::size_t number);

class RouteOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError.
  void validate();
  bool given() const { return !path_.empty(); }
  Document parameters() const;

  struct Written {
    std::vector<viewshed::ZoneFile> files;
    std::vector<Path> routes;
    std::vector<std::string> warnings;  ///< about the file
  };
  /// Writes route-N-NAME.csv, .pdf and .svg of each line of the file, bare and screened, and routes.csv with a row for
  /// each line. Throws FileError, InputError, Cancelled.
  Written write(const std::string& folder, const Store& store, const viewshed::Zone& zone, Progress& progress) const;

 private:
  std::string path_, every_text_;
  double every_ = 100;
};

}  // namespace itin::cli
