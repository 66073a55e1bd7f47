// The turbines of `itin ztv` and `itin dwellings`: their file, and what its rows leave open.
#pragma once

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <viewshed/zone_study.hpp>

#include "options/places/in_crs.hpp"
#include "options/turbine_size.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class TurbineOptions {
 public:
  /// What the turbines are for: a zone is studied about those that are proposed, and numbers all in its rasters.
  enum class Use { zone, dwellings };
  explicit TurbineOptions(Use use) : use_(use) {}
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError.
  void validate();
  const InCrs& in_crs() const { return in_crs_; }
  /// Reads the turbines. Throws FileError, InputError (no row can be used, or all lie off the data).
  viewshed::TurbineTable read(const viewshed::RadiusRule& radius, const StoreMetadata& metadata) const;
  Document parameters() const;

 private:
  Use use_;
  viewshed::TurbineFile file_;
  InCrs in_crs_;
  TurbineSizeOptions size_;  ///< taken for rows that give none
};

}  // namespace itin::cli
