// The options of `itin premises`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>
#include <viewshed/premises.hpp>

#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/places/in_crs.hpp"
#include "options/radio/antenna_options.hpp"
#include "options/radio/earth_options.hpp"
#include "options/sheet_options.hpp"
#include "options/surface_options.hpp"
#include "output/output_path.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class PremisesOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  Document parameters() const;
  /// Adds to the request what takes the store and the file of masts. Throws InputError, FileError,
  /// CorruptStore, Cancelled.
  viewshed::PremisesRequest complete_request(const Store& read, Progress& progress);
  /// Says whose heights the masts have, where their file gives these unasked; empty else.
  std::string heights_text() const;
  /// Warns where refraction is that of light, and links are radio.
  void warn_of_light(std::vector<std::string>& warnings) const;

  const SheetOptions& sheets() const { return sheets_; }
  std::uint64_t memory_bytes() const { return request_.memory_bytes; }

  std::string store, directory;
  OutputPolicy policy;

 private:
  void declare_masts(CLI::App& app);
  void declare_antennas(CLI::App& app);
  void declare_work(CLI::App& app);
  void validate_antennas();
  void take_fields(std::vector<std::string>& warnings);

  viewshed::PremisesRequest request_;
  SiteQuery masts_;
  AntennaOptions antennas_;
  InCrs in_crs_;
  ThemeOptions themes_;
  EarthOptions earth_;
  NoDataOption nodata_;
  MemoryOption memory_;
  SheetOptions sheets_;
  bool took_heights_ = false;  ///< whether heights come from the usual field, for which the call did not ask
  std::string mast_height_text_, observer_on_ = "ground", radius_text_;
  std::string setback_text_, frequency_text_, fresnel_text_;
};

}  // namespace itin::cli
