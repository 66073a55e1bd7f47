// A store of random hills, some of them in a flat sea or with a round gap, and requests to look at them.
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <viewshed/request.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin::test {

class HillsWithGap : public testing::Test {
 protected:
  static constexpr int kPostsPerSide = 193;
  static constexpr double kPostStep = 25, kFirstEast = 300000, kFirstNorth = 200000;
  static constexpr Point2 kBetweenPosts{kFirstEast + 2400.7, kFirstNorth - 2300.3},
      kOnPost{kFirstEast + 2412.5, kFirstNorth - 2312.5};

  /// Makes hills with a gap, whose radius is in posts; ground lower than `sea` lies under the sea.
  void make(double gap, double roughness = 0.6, double sea = -1e6) {
    gap_ = gap;
    const std::vector<double> z = fractal_heights(257, 300, roughness, random_());
    import_posts([&](int c, int r) {
      const double height = std::max(sea, z[static_cast<std::size_t>(r) * 257 + static_cast<std::size_t>(c)]);
      return posts_to_gap(c, r) < 0 ? std::numeric_limits<double>::quiet_NaN() : height;
    });
  }
  template <class Heights>
  void import_posts(const Heights& heights) {
    store_.reset();
    std::filesystem::remove(directory_.file("t.itin"));
    write_raster(directory_.file("t.tif"), {kFirstEast, kFirstNorth, kPostStep, kPostsPerSide, kPostsPerSide, 27700},
                 heights);
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    import_terrain(directory_.file("t.itin"), options, progress_);
    store_.emplace(directory_.file("t.itin"));
  }

  /// A random place on the hills or in the gap.
  Point2 anywhere() {
    std::uniform_real_distribution<double> share(0.02, 0.98);
    const double east = share(random_) * kPostsPerSide * kPostStep, south = share(random_) * kPostsPerSide * kPostStep;
    return {kFirstEast + east, kFirstNorth - south};
  }
  Point2 on_the_hills() {
    while (true) {
      const Point2 place = anywhere();
      if (posts_to_gap((place.x - kFirstEast) / kPostStep, (kFirstNorth - place.y) / kPostStep) > 2) return place;
    }
  }

  static viewshed::Request request_from(Point2 position, double height) {
    viewshed::Request request;
    viewshed::Observer observer;
    observer.position = position;
    observer.height = height;
    request.observers.push_back(observer);
    return request;
  }

  /// Adds three observers on the hills, with radii of their own.
  void add_observers(viewshed::Request& request) {
    for (const double radius : {600.0, 1500.0, 1e5}) {
      viewshed::Observer observer = request.observers.front();
      observer.position = on_the_hills();
      observer.radius = radius;
      request.observers.push_back(observer);
    }
  }

  /// Calls expect(request) for ever narrower fields of view, then for targets at an elevation; returns the last
  /// request.
  template <class Expect>
  static viewshed::Request in_fields_of_view(viewshed::Request request, const Expect& expect) {
    request.radius = 1900;
    request.min_radius = 200;
    expect(request);
    request.azimuth = viewshed::AngleRange{300, 100};
    expect(request);
    request.elevation = viewshed::AngleRange{-4, 1};
    expect(request);
    request.elevation.reset();
    request.target_absolute = true;
    request.target_height = 120;
    expect(request);
    return request;
  }

  /// Calls expect(request) for cells from far smaller than the posts' distance to far larger.
  template <class Expect>
  static void in_cells_of_all_sizes(viewshed::Request request, const Expect& expect) {
    for (const double cell : {3.0, 25.0, 400.0, 1700.0}) {
      request.cell_size = cell;
      request.radius = cell < 5 ? std::optional(700.0) : std::nullopt;
      expect(request);
    }
  }

  std::mt19937 random_{seed()};
  NoProgress progress_;
  TemporaryDirectory directory_;
  std::optional<Store> store_;

 private:
  double posts_to_gap(double column, double row) const {
    return gap_ > 0 ? std::hypot(column - 75, row - 105) - gap_ : std::numeric_limits<double>::infinity();
  }

  double gap_ = 0;
};

}  // namespace itin::test
