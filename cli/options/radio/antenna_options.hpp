// Where antennas may be mounted on buildings.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/document.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::cli {

class AntennaOptions {
 public:
  /// Declares --reveal, --storey, --pole, and `spacing` for the distance between places.
  void declare(CLI::App& app, const std::string& spacing);
  /// Throws InputError.
  void validate();

  const viewshed::AntennaPlaces& places() const { return places_; }
  Document parameters() const;

 private:
  viewshed::AntennaPlaces places_;
  std::string spacing_, spacing_text_, reveal_text_, storey_text_, pole_text_;
};

}  // namespace itin::cli
