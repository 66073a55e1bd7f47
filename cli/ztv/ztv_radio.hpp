// Radio links and radars beside a wind farm: `--links`, `--frequency`, `--radar`.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <viewshed/zone_study.hpp>

#include "options/places/in_crs.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class ZtvRadioOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError.
  void validate();
  Document parameters() const;
  /// Adds the links and the radar to the request. Throws FileError, InputError.
  void complete(viewshed::ZoneStudyRequest& request, const InCrs& in_crs, const StoreMetadata& metadata);

 private:
  std::string links_path_, frequency_text_, radar_text_;
  double frequency_ghz_ = 0;
  std::optional<Place> radar_place_;
  std::optional<viewshed::Observer> radar_;
};

}  // namespace itin::cli
