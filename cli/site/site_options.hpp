// The options of `itin site`, from the command line and from a parameter file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>
#include <viewshed/site_coverage.hpp>

#include "options/earth_options.hpp"
#include "options/engine_option.hpp"
#include "options/in_crs.hpp"
#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/sheet_options.hpp"
#include "options/surface_options.hpp"
#include "output/output_path.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"
#include "site/placement_options.hpp"

namespace itin::cli {

/// A mast that may be built.
struct Mast {
  double height = 20;  ///< metres
  double cost = 1;
};

class SiteOptions {
 public:
  void declare(CLI::App& app);
  /// Takes options from the parameter file, which is part of the call. Throws InputError, FileError.
  void apply_parameter_file();
  /// Checks the options. Throws InputError.
  void validate();
  /// Decides which fields of the files of sites hold heights. `warnings` gets one where a file's heights are not used.
  /// Throws FileError.
  void take_fields(std::vector<std::string>& warnings);
  /// Returns lines about heights of masts and targets that a file gives unasked; empty where no file does. To be called
  /// after take_fields().
  std::string heights_text() const;
  /// Returns the values given, by option name without dashes, as a parameter file holds them.
  Document given() const;
  Document parameters() const;
  /// Returns the part of the Fresnel zone that a link must leave clear, if any.
  std::optional<viewshed::FresnelCriterion> criterion() const;
  viewshed::Objective objective() const {
    return placement.given() ? viewshed::Objective::kLeast : viewshed::Objective::kMost;
  }
  /// Returns what targets count as that only ground without data could hide: turbines are hidden in the worst case.
  viewshed::OpenTargets open_targets() const {
    return placement.given() ? viewshed::OpenTargets::kServed : viewshed::OpenTargets::kUnserved;
  }
  /// Tells whether sites at both places may be chosen, as far as distances go.
  bool may_both_stand(Point2 a, Point2 b) const;
  /// Returns a sentence that tells when a target is served, or which targets see turbines.
  std::string meaning_of_served() const;

  std::string store, directory;
  /// Returns the path of a file in the folder.
  std::string path(const std::string& name) const { return (std::filesystem::path(directory) / name).string(); }
  SheetOptions sheets;
  // Candidates.
  SiteQuery candidates;
  std::string cost_field;
  std::string search_area;
  std::optional<double> spacing;
  std::vector<Mast> masts;  ///< empty with a height field; with --turbines one, as high as the tip or the hub
  PlacementOptions placement;
  bool on_surface = false;
  InCrs in_crs;
  // Demand.
  std::string demand = "cells";
  std::string weight_field;
  double target_height = 2;
  std::string demand_height_field;  ///< the field of the demand's points that holds heights; empty: there is none
  bool targets_on_surface = false;
  double radius = 10000;
  std::optional<double> cell;
  double cell_size() const { return cell.value_or(50); }
  std::optional<double> frequency_ghz;  ///< nothing: targets in sight are served
  double fresnel = 0.6;                 ///< fraction of the first Fresnel zone that must be clear, with a frequency
  // The choice.
  std::optional<std::size_t> count;
  std::optional<double> budget, share;
  std::optional<double> min_spacing;
  std::string existing, existing_height_field, forbidden;
  int cover = 1;
  bool intervisible = false;
  std::optional<Place> hub;
  bool exact_final = true;
  bool swaps = true;
  // The computation and the files.
  std::optional<double> tolerance;
  ThemeOptions themes;
  EarthOptions earth;
  EngineOption engine;
  MemoryOption memory;
  NoDataOption nodata;
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;
  bool resume = false;
  OutputPolicy policy;

 private:
  void declare_candidates(CLI::App& app);
  void declare_demand(CLI::App& app);
  void declare_choice(CLI::App& app);
  void declare_outputs(CLI::App& app);
  void declare_work(CLI::App& app);
  void validate_candidates();
  void validate_masts();
  void validate_demand();
  void validate_links();
  void validate_choice();
  void validate_work();

  CLI::App* app_ = nullptr;
  std::string params_;
  void take_demand_heights(std::vector<std::string>& warnings);

  bool took_heights_ = false;  ///< whether heights come from the usual field, for which the call did not ask
  std::string spacing_text_, mast_height_text_, mast_cost_text_, observer_on_ = "ground";
  std::string target_height_text_, target_on_ = "ground", radius_text_, cell_text_;
  std::string count_text_, budget_text_, share_text_, min_spacing_text_, cover_text_, hub_text_;
  std::string exact_final_text_, swap_text_, tolerance_text_;
  std::string frequency_text_, fresnel_text_;
};

}  // namespace itin::cli
