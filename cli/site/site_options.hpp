// The options of `itin site`, from the command line and from a parameter file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>
#include <viewshed/site_plan.hpp>

#include "options/engine_option.hpp"
#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/places/in_crs.hpp"
#include "options/radio/antenna_options.hpp"
#include "options/radio/budget_options.hpp"
#include "options/radio/earth_options.hpp"
#include "options/sheet_options.hpp"
#include "options/surface_options.hpp"
#include "output/output_path.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"
#include "site/placement_options.hpp"

namespace itin::cli {

class SiteOptions {
 public:
  void declare(CLI::App& app);
  /// Takes options from the parameter file, which is part of the call. Throws InputError, FileError.
  void apply_parameter_file();
  /// Checks the options. Throws InputError.
  void validate();
  /// Takes cells that are no finer than half the posting of bare ground, where the call gives none.
  void take_posting(const StoreMetadata& metadata);
  /// Decides which fields of the files of sites hold heights. `warnings` gets one where a file's heights are not used.
  /// Throws FileError.
  void take_fields(std::vector<std::string>& warnings);
  /// Returns lines about heights of masts and targets that a file gives unasked; empty where no file does. To be called
  /// after take_fields().
  std::string heights_text() const;
  /// Returns the values given, by option name without dashes, as a parameter file holds them.
  Document given() const;
  Document parameters() const;

  std::string store, directory;
  /// Returns the path of a file in the folder.
  std::string path(const std::string& name) const { return (std::filesystem::path(directory) / name).string(); }
  SheetOptions sheets;
  /// The request as far as options alone give it; site_request.hpp adds what files hold.
  viewshed::SitePlanRequest request;
  SiteQuery candidates;
  std::string cost_field;
  std::string search_area;
  PlacementOptions placement;
  InCrs in_crs;
  std::string demand = "cells";
  /// Tells whether the demand is in a file.
  bool reads_demand() const { return demand != "cells" && demand != "premises"; }
  AntennaOptions antennas;
  BudgetOptions radios;
  std::string weight_field;
  std::string demand_height_field;  ///< the field of the demand's points that holds heights; empty: there is none
  std::string existing, existing_height_field, forbidden;
  std::optional<Place> hub;
  ThemeOptions themes;
  EarthOptions earth;
  EngineOption engine;
  MemoryOption memory;
  NoDataOption nodata;
  bool resume = false;
  OutputPolicy policy;

 private:
  void declare_candidates(CLI::App& app);
  void declare_demand(CLI::App& app);
  void declare_antennas(CLI::App& app);
  void declare_radios(CLI::App& app);
  void declare_choice(CLI::App& app);
  void declare_outputs(CLI::App& app);
  void declare_work(CLI::App& app);
  void validate_candidates();
  void validate_masts();
  void validate_demand();
  void validate_links();
  void validate_radios();
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
  std::string frequency_text_, fresnel_text_, margin_text_;
};

}  // namespace itin::cli
