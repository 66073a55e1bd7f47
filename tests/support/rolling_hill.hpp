// A store of rolling ground for tests of what stands on it: 60 x 60 posts every 10 m from (300000, 199400).
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/feature_at.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>

#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/rolling_ground.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin::test {

class RollingHill : public testing::Test {
 protected:
  void SetUp() override {
    write_raster(directory_.file("t.tif"), {300000, 200000, 10, 60, 60, 27700}, rolling);
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    import_terrain(path(), options, progress_);
  }

  /// Imports woods whose field `lad` has their leaf areas.
  void import_woods(const std::string& theme, const std::vector<LineFeature>& woods) {
    ImportOptions options;
    options.attributes = {"lad"};
    import_raised(path(), directory_.file(theme + ".geojson"), ThemeKind::Vegetation, theme, woods, options);
  }
  /// Imports 15 houses of random size at random places.
  void add_houses() {
    std::vector<LineFeature> houses;
    for (int i = 0; i < 15; ++i) {
      const double x = in(300010, 300560), y = in(199420, 199960);
      houses.push_back(box(x, y, x + in(6, 20), y + in(6, 20), in(3, 9)));
    }
    import_houses(path(), directory_.file("houses.geojson"), houses);
  }
  /// The features of all themes of vegetation.
  static std::vector<FeatureNumber> woods_of(const Store& store) {
    std::vector<FeatureNumber> woods;
    std::uint16_t number = 0;
    for (const ThemeInfo& theme : store.metadata().themes) {
      ++number;
      if (theme.kind != ThemeKind::Vegetation) continue;
      for (const FeatureAt& f : features_of(store, number)) woods.push_back({number, f.number});
    }
    return woods;
  }
  /// Every second of these features.
  static std::vector<FeatureNumber> with_even_numbers(std::vector<FeatureNumber> features) {
    std::erase_if(features, [](const FeatureNumber& f) { return f.number % 2 != 0; });
    return features;
  }
  std::string path() const { return directory_.file("s.itin"); }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 100000) / 100000; }

  const TemporaryDirectory directory_;
  std::mt19937 random_{seed()};
  NoProgress progress_;
};

}  // namespace itin::test
