// Two stores, each imported once for a suite, if at all: hills with a hole, as a raster, and the bundled town of lidar
// and footprints.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <itin/import.hpp>
#include <viewshed/request.hpp>

#include "support/alexandria.hpp"
#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin::test {

inline constexpr viewshed::Mode kEveryMode[] = {
    viewshed::Mode::kVisible, viewshed::Mode::kCount,   viewshed::Mode::kWhich,  viewshed::Mode::kAngle,
    viewshed::Mode::kNearest, viewshed::Mode::kBlocker, viewshed::Mode::kHeight, viewshed::Mode::kProbability,
    viewshed::Mode::kFresnel, viewshed::Mode::kLoss,    viewshed::Mode::kLevel};

class HillsAndTown {
 public:
  std::string file(const std::string& name) const { return directory_.file(name); }
  std::string hills() const {
    return imported("hills.itin", [this](const std::string& store) { import_hills(file("hills.tif"), store); });
  }
  std::string town() const { return imported("town.itin", import_alexandria); }

  /// Observers of all kinds; one looks past the data's edge, and one sees its own neighbourhood alone.
  static viewshed::Request over_hills() {
    viewshed::Request request;
    request.observers = {{"summit", {301500, 202500}, 30},
                         {"valley", {303300, 200700}, 2},
                         {"corner", {300020, 203970}, 12},
                         {"near", {302200, 201800}, 5}};
    request.observers[3].radius = 300;
    request.observers[1].azimuth = viewshed::AngleRange{200, 30};
    request.target_height = 2;
    request.cell_size = 13;
    request.vertical_error = {0.5, 40};
    add_radio(request);
    return request;
  }

  static viewshed::Request over_town() {
    viewshed::Request request;
    request.observers = {{"street", {321800, 4297750}, 2}, {"roof", {321692.34, 4297619.88}, 25}};
    request.cell_size = 3;
    request.target_height = 0.5;
    request.vertical_error = {0.3, 10};
    add_radio(request);
    request.themes = ThemeChoice::all();
    return request;
  }

  /// Returns the request in this mode; for losses and levels, which take all triangles under each line, with half of
  /// the observers.
  static viewshed::Request in_mode(viewshed::Mode mode, viewshed::Request request) {
    request.mode = mode;
    if (mode != viewshed::Mode::kLoss && mode != viewshed::Mode::kLevel) return request;
    for (std::size_t i = 0; i < request.observers.size(); ++i)
      request.observers.erase(request.observers.begin() + static_cast<std::ptrdiff_t>(i));
    return request;
  }

 private:
  /// Imports a store when it is first asked for.
  std::string imported(const std::string& name, const auto& import) const {
    std::string path = file(name);
    if (!std::filesystem::exists(path)) import(path);
    return path;
  }
  /// Imports 4 km by 4 km of hills.
  static void import_hills(const std::string& raster, const std::string& store) {
    const std::vector<double> z = fractal_heights(257, 200, 0.55, 11);
    write_raster(raster, {300000, 204000, 20, 200, 200, 27700}, [&](int c, int r) {
      if (std::hypot(c - 60, r - 120) < 12) return std::nan("");
      return z[static_cast<std::size_t>(r) * 257 + static_cast<std::size_t>(c)];
    });
    NoProgress progress;
    ImportOptions options;
    options.sources = {raster};
    import_terrain(store, options, progress);
  }
  static void add_radio(viewshed::Request& request) {
    request.radio.frequency_ghz = 2.5;
    request.radio.effective_earth_km = effective_earth_km(request.earth);
    request.fresnel.wavelength = wavelength_m(request.radio.frequency_ghz);
    request.budget = {.power_dbm = 20, .to_gain_dbi = 8, .sensitivity_dbm = -85, .rain_rate_mm_h = 30};
  }

  const TemporaryDirectory directory_;
};

}  // namespace itin::test
