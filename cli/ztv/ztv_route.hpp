// What is seen of the turbines along roads and paths: `--route`, `--every`.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <viewshed/zone_study.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class RouteOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError.
  void validate();
  bool given() const { return !path_.empty(); }
  Document parameters() const;
  /// Adds the routes to the request. Throws FileError, InputError.
  void complete(viewshed::ZoneStudyRequest& request, const StoreMetadata& metadata) const;

 private:
  std::string path_, every_text_;
  double every_ = 100;
};

}  // namespace itin::cli
