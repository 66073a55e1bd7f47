// Curvature and refraction: `--curvature`, `--refraction`, `--earth-radius`, `--effective-earth`.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/earth.hpp>
#include <itin/store.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class EarthOptions {
 public:
  void declare(CLI::App& app);
  /// Declares `--effective-earth-km`, too.
  void declare_radius(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// Takes the radius of the body that a store's CRS is of, where it is not the Earth and no option gives a radius.
  void take_body_of(const StoreMetadata& metadata);
  const Earth& earth() const { return earth_; }
  /// Whether nothing was said about refraction.
  bool is_default() const { return refraction_text_.empty() && effective_text_.empty() && effective_km_text_.empty(); }
  /// Warns where nothing was said about refraction, and radio is asked for.
  void warn_of_light(std::vector<std::string>& warnings) const;

 private:
  void require_no_refraction() const;
  void set_effective_km();

  std::string curvature_text_, refraction_text_, radius_text_, effective_text_, effective_km_text_;
  Earth earth_;
};

}  // namespace itin::cli
