// The options of `itin dwellings`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>
#include <viewshed/dwellings.hpp>

#include "dwellings/flicker_options.hpp"
#include "options/foliage_options.hpp"
#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/radio/earth_options.hpp"
#include "options/sheet_options.hpp"
#include "options/surface_options.hpp"
#include "output/output_path.hpp"
#include "program/verb.hpp"
#include "ztv/ztv_turbines.hpp"

namespace itin::cli {

class DwellingsOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError, FileError.
  void validate();
  Document parameters() const;
  /// Adds to the request what takes the store and the files. Throws InputError, FileError, CorruptStore, Cancelled.
  viewshed::DwellingsRequest complete_request(const Store& read, Progress& progress);

  const SheetOptions& sheets() const { return sheets_; }
  /// The dwellings that sheets are for; empty: all.
  const std::vector<std::string>& sheets_of() const { return sheets_of_; }
  std::uint64_t memory_bytes() const { return request_.memory_bytes; }

  std::string store, directory;
  OutputPolicy policy;

 private:
  void read_places(const StoreMetadata& metadata);

  viewshed::DwellingsRequest request_;
  TurbineOptions turbines_{TurbineOptions::Use::dwellings};
  FlickerOptions flicker_;
  SheetOptions sheets_;
  ThemeOptions themes_;
  FoliageOptions foliage_;
  EarthOptions earth_;
  NoDataOption nodata_;
  MemoryOption memory_;
  std::string places_, radius_text_, observer_text_, sheets_of_text_;
  std::vector<std::string> sheets_of_;
};

}  // namespace itin::cli
