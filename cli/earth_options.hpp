// Curvature and refraction: `--curvature`, `--refraction`, `--earth-radius`, `--effective-earth`.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/earth.hpp>

#include "verb.hpp"

namespace itin::cli {

class EarthOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  const Earth& earth() const { return earth_; }
  /// The convention and its values: `refraction` of a document.
  Document document() const;

 private:
  std::string curvature_text_, refraction_text_, radius_text_, effective_text_;
  Earth earth_;
};

}  // namespace itin::cli
