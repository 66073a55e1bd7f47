// The turbines of `itin ztv`: rows of a file, understood or named as bad.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/site_table.hpp>
#include <itin/store.hpp>
#include <viewshed/turbines.hpp>

#include "options/in_crs.hpp"
#include "options/turbine_size.hpp"
#include "program/verb.hpp"

namespace itin::cli {

struct BadRow {
  std::size_t number = 0;    ///< from 1, in the file's order
  std::int64_t feature = 0;  ///< the file's own number for it
  std::string place;         ///< where it stands in the file: "feature 3"
  std::string message;
};

/// Tells how many of a file's rows were used, and why the others were not.
Document bad_rows_document(const std::string& file, std::size_t rows, std::size_t used, const std::vector<BadRow>& bad);
std::string bad_row_warning(const std::string& file, const BadRow& row);

struct TurbineList {
  std::size_t rows = 0;
  std::vector<viewshed::Turbine> turbines;
  std::vector<BadRow> bad;
  std::vector<std::pair<std::int64_t, std::string>>
      places;                         ///< one for each row: the file's own number for it, and its place
  std::string sha256;                 ///< checksum of the file
  std::vector<std::string> warnings;  ///< about rows that are used
};

class TurbineOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError.
  void validate();
  const std::string& path() const { return query_.path; }
  const InCrs& in_crs() const { return in_crs_; }
  /// Reads the turbines. `radius` gives the radius for a tip height, metres. Throws FileError, InputError (no row can
  /// be used).
  TurbineList read(const StoreMetadata& metadata, const std::function<double(double)>& radius) const;
  Document parameters() const;

 private:
  /// Makes a turbine from a row. Throws InputError with what is wrong with the row.
  viewshed::Turbine turbine_of(const SiteRow& row) const;

  SiteQuery query_;
  std::string farm_;
  static constexpr const char *kHubField = "hub_height", *kRotorField = "rotor_diameter", *kTipField = "tip_height",
                              *kFarmField = "farm";
  std::string hub_field_ = kHubField, rotor_field_ = kRotorField, tip_field_ = kTipField, farm_field_ = kFarmField;
  InCrs in_crs_;
  TurbineSizeOptions size_;  ///< taken for rows that give none
};

}  // namespace itin::cli
