// A line of sight on a store, as the options ask for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <profile/los.hpp>

#include "options/detail_options.hpp"
#include "options/foliage_options.hpp"
#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/places/in_crs.hpp"
#include "options/surface_options.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

/// The options `--from`, `--to` and those that choose the surface between them.
class LosStoreOptions {
 public:
  void declare(CLI::App& app);
  void declare_memory(CLI::App& app);
  bool given() const { return !from_text_.empty() || !to_text_.empty(); }
  /// Requires, for a call without a store, that none of the options is given. Throws InputError.
  void require_none() const;
  /// Checks the options. `object_tip_m` is the height at --to where --to gives none: that of the object there. Throws
  /// InputError.
  void validate(std::optional<double> object_tip_m);
  /// Checks everything but --from and --to, for links, which bring their own ends. Throws InputError.
  void validate_surface();
  /// Finds in the store what the options name there, before run() or themes(). Throws InputError, CorruptStore,
  /// FileError, Cancelled.
  void complete(const Store& store, Progress& progress) { themes_.complete(store, progress); }
  Document surface_parameters() const;
  Detail detail() const { return detail_.detail({}); }
  const ThemeChoice& themes() const { return themes_.choice(); }
  bool from_on_surface() const { return from_on_ == "surface"; }
  bool to_on_surface() const { return to_on_ == "surface"; }
  NoData nodata() const { return nodata_.rule(); }
  std::optional<std::uint64_t> memory_bytes() const { return memory_.bytes(); }
  const std::string& in_crs() const { return in_crs_.crs; }
  Document parameters() const;

  /// Two ends in the store's CRS; --absolute-heights says what their heights mean.
  struct Ends {
    Point2 from, to;
    double from_height, to_height;
  };
  struct Result {
    profile::LosReport report;
    profile::StoreLine line;
    std::vector<std::string> warnings;
    Document foliage;          ///< null without --foliage
    std::string foliage_text;  ///< empty without it
  };
  /// Completes the query by the options, and computes the report. Throws InputError, CorruptStore, FileError.
  Result run(const Store& store, profile::LosQuery query) const;
  /// Does the same between other ends.
  Result run(const Store& store, profile::LosQuery query, const Ends& ends) const;

 private:
  bool from_is_elevation() const { return absolute_heights_ || from_absolute_; }
  bool to_is_elevation() const { return absolute_heights_ || to_absolute_; }
  void validate_choices();

  CLI::App* app_ = nullptr;
  std::string from_text_, to_text_;
  std::string from_on_ = "ground", to_on_ = "ground";
  bool absolute_heights_ = false, from_absolute_ = false, to_absolute_ = false;
  InCrs in_crs_;
  DetailOptions detail_;
  ThemeOptions themes_;
  FoliageOptions foliage_;
  NoDataOption nodata_;
  MemoryOption memory_;

  Place from_, to_;
  double from_height_ = 2, to_height_ = 2;
};

}  // namespace itin::cli
