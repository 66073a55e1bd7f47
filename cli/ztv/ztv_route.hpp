// What is seen of the turbines along roads and paths: `--route`, `--every`.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class RouteOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  bool given() const { return !path_.empty(); }
  Document parameters() const;

  /// route-N-NAME.csv, .pdf and .svg of each line of the file, bare and screened, and routes.csv with a row for each.
  /// Throws FileError, InputError, Cancelled.
  std::vector<viewshed::ZoneFile> write(const std::string& folder, const Store& store, const viewshed::Zone& zone,
                                        Progress& progress) const;

 private:
  std::string path_, every_text_;
  double every_ = 100;
};

}  // namespace itin::cli
