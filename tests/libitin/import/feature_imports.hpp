// Features with ids on a hill of 1 km, and what a store says of them once they are imported.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/tin_export.hpp>
#include <itin/triangulate.hpp>

#include "features/feature_lines.hpp"
#include "store/feature_table.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin::test {

/// A piece of a line: the theme's name, the feature's id, and both ends with their heights, the lesser first.
struct IdentifiedEdge {
  std::string theme, id;
  GridPoint a, b;
  friend auto operator<=>(const IdentifiedEdge&, const IdentifiedEdge&) = default;
};
using Edges = std::set<IdentifiedEdge>;

inline std::vector<std::uint16_t> all_themes(const Store& store) {
  std::vector<std::uint16_t> themes;
  for (std::size_t t = 1; t <= store.metadata().themes.size(); ++t) themes.push_back(static_cast<std::uint16_t>(t));
  return themes;
}

inline Edges edges_of(const Store& store, const Window& window, const Detail& detail) {
  NoProgress progress;
  const Tin tin = triangulate(store, window, detail, progress, ThemeChoice::all().with_ground_lines());
  Edges edges;
  for (const FeatureLine& line : feature_lines(store, {tin, window, detail, all_themes(store)}, progress)) {
    FeatureTable table(store, line.theme);
    const FeatureRecord* record = line.feature ? table.at(*line.feature) : nullptr;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const auto [a, b] = std::minmax(
          {store.metadata().grid.quantise(line.points[i - 1]), store.metadata().grid.quantise(line.points[i])});
      edges.insert(
          {store.metadata().themes[line.theme - std::size_t{1}].name, record != nullptr ? record->id : "", a, b});
    }
  }
  return edges;
}

/// What a store says of features, by theme and id: names, and values by field.
using Records =
    std::map<std::pair<std::string, std::string>, std::pair<std::string, std::map<std::string, AttributeValue>>>;

inline Records records_of(const Store& store) {
  Records records;
  for (const std::uint16_t theme : all_themes(store)) {
    const ThemeFeatures features = stored_features(store, theme);
    for (const FeatureRecord& record : features.records) {
      auto& [name, values] = records[{store.metadata().themes[theme - std::size_t{1}].name, record.id}];
      name = record.name;
      for (std::size_t i = 0; i < record.values.size(); ++i) values[features.fields[i].name] = record.values[i];
    }
  }
  return records;
}

/// Lines, houses and ground to import.
class FeatureImports : public ::testing::Test {
 protected:
  FeatureImports() {
    write_raster(path("ground.tif"), {300000, 200000, 20, 50, 50, 27700}, [](int c, int r) {
      return 100 + 20 * std::sin(c / 7.0) + 15 * std::cos(r / 5.0) + 2 * std::sin(c * 1.7 + r * 2.3);
    });
  }

  std::string path(const std::string& name) const { return directory_.file(name); }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 1000000) / 1e6; }

  /// Lines that cross each other; every third goes on where the one before it ends, and every fifth repeats it.
  std::vector<LineFeature> wandering(const std::string& prefix, int count) {
    std::vector<LineFeature> features;
    for (int i = 0; i < count; ++i) {
      LineFeature f;
      f.properties = fmt::format(R"({{"ref":"{}{}","rank":{},"length":{:.2f}}})", prefix, i, i, in(0, 9));
      const bool goes_on = i % 3 == 2;
      Point3 p =
          goes_on ? features.back().vertices.back() : Point3{in(300100, 300800), in(199100, 199900), in(80, 130)};
      double heading = in(0, 6.28);
      for (int k = 0; k < 12; ++k) {
        f.vertices.push_back(p);
        // Near the edge of the ground lines turn back to its middle.
        const bool near_edge = std::max(std::abs(p.x - 300500), std::abs(p.y - 199500)) > 430;
        heading = near_edge ? std::atan2(199500 - p.y, 300500 - p.x) : heading + in(-0.5, 0.5);
        p = {p.x + 15 * std::cos(heading), p.y + 15 * std::sin(heading), p.z + in(-1, 1)};
      }
      if (i % 5 == 4) f.vertices = features.back().vertices;
      features.push_back(f);
      lines_[prefix + std::to_string(i)] = f.vertices;
    }
    return features;
  }

  std::vector<LineFeature> houses(int count) {
    std::vector<LineFeature> features;
    for (int i = 0; i < count; ++i) {
      const double x = in(300100, 300850), y = in(199100, 199850);
      features.push_back(box(x, y, x + in(5, 30), y + in(5, 30), 8));
      features.back().properties = fmt::format(R"({{"h":8,"ref":"house{}"}})", i);
    }
    return features;
  }

  ImportOptions raised(const std::string& file, const std::string& theme) const {
    ImportOptions houses = options(file, ThemeKind::Buildings, theme);
    houses.height_field = "h";
    return houses;
  }

  ImportOptions options(const std::string& file, ThemeKind kind, const std::string& theme) const {
    ImportOptions options;
    options.sources = {path(file)};
    options.kind = kind;
    options.theme = theme;
    options.id_field = "ref";
    return options;
  }

  ImportOptions ground() const {
    ImportOptions options;
    options.sources = {path("ground.tif")};
    return options;
  }

  void import(const std::string& store, const ImportOptions& options) {
    NoProgress progress;
    if (options.kind)
      import_lines(path(store), options, progress);
    else
      import_terrain(path(store), options, progress);
  }

  TemporaryDirectory directory_;
  std::mt19937 random_{seed()};
  std::map<std::string, std::vector<Point3>> lines_;  ///< as imported, by id
};

}  // namespace itin::test
