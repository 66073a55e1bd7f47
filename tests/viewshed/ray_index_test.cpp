// The visibility index by rays: every look against a line of sight, what observers see against whole viewsheds.
#include "index/ray_index.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/grazing.hpp>
#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <itin/tin_heights.hpp>
#include <itin/triangulate.hpp>
#include <profile/los.hpp>
#include <viewshed/visibility_index.hpp>

#include "index/index_part.hpp"
#include "index/post_rows.hpp"
#include "index/ray_course.hpp"
#include "index/ray_walk.hpp"
#include "support/raster_file.hpp"
#include "support/same_bits.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin::viewshed {
namespace {

using HeightAt = std::function<double(int, int)>;

class RayIndex : public testing::Test {
 protected:
  static constexpr int kSide = 60;

  void import_posts(const HeightAt& height, int side = kSide) const {
    const std::string raster = directory_.file("t.tif");
    test::write_raster(raster, {300000, 200000, 50, side, side, 27700}, height);
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(path_, options, progress);
  }

  HeightAt rough(double height) const {
    return [this, height](int, int) { return std::uniform_real_distribution<double>(0, height)(*random_); };
  }
  static HeightAt with_lakes(const HeightAt& ground) {
    return [ground](int c, int r) {
      const double height = ground(c, r);
      const bool lake = std::hypot(c - 40, r - 25) < 7 || std::hypot(c - 14, r - 44) < 3 || (c == 30 && r > 30);
      return lake ? std::nan("") : height;
    };
  }

  /// What looks along a ray count, and how many of them fall on ground.
  struct Seen {
    double looks = 0, on_ground = 0, seen = 0, beyond = 0;
  };

  /// Looks along a ray by lines of sight, each a cross-section of its own.
  static Seen by_lines(const Store& store, const Tin& tin, const IndexRequest& request, Point2 eye, double azimuth) {
    Seen all;
    const int rings = static_cast<int>(std::ceil(request.radius / 50));
    for (int ring = 0; ring < rings; ++ring) {
      const double distance = (ring + 0.5) * request.radius / rings, weight = 2 * ring + 1;
      const Point2 place{eye.x + distance * std::sin(azimuth), eye.y + distance * std::cos(azimuth)};
      if (!height_on(tin, place)) continue;
      ++all.looks, all.on_ground += weight;
      profile::LosQuery query;
      query.from_height_m = request.height, query.to_height_m = request.target_height;
      query.earth = request.earth;
      const auto verdict =
          profile::judge(profile::from_section(cross_section(store, eye, place, request.detail, request.themes)), query)
              .verdict;
      all.seen += verdict == profile::SightVerdict::kVisible ? weight : 0;
      all.beyond += verdict == profile::SightVerdict::kUndecided ? weight : 0;
    }
    return all;
  }

  /// The posts under an index, all of them read.
  struct Ground {
    Ground(const Store& store, const IndexRequest& request, const IndexLayout& layout)
        : reader(posts_under_index(store, request, layout.grid, progress)) {
      reader->read_all(progress);
      among = observers_among_posts(layout.grid, reader->lattice()).value();
      const double resolution = reader->lattice().grid.resolution;
      const auto reach = static_cast<std::int64_t>(layout.rings) + 3;
      box = {among.column - reach, among.row - reach, among.column + among.step * layout.grid.columns() + reach,
             among.row + among.step * layout.grid.rows() + reach};
      posts.emplace(reader->lattice(), box, among.column, among.step);
      fan = {.east = among.east,
             .south = among.south,
             .spacing = static_cast<double>(reader->lattice().spacing),
             .radius = request.radius / resolution,
             .rings = layout.rings,
             .reach = request.radius / resolution,
             .target_height = request.target_height / resolution,
             .drop = request.earth.drop_coefficient() * resolution,
             .grazing = kGrazing / resolution};
    }
    NoProgress progress;
    std::unique_ptr<LatticeReader> reader;
    ObserverPosts among;
    PostBox box;
    std::optional<PostRows> posts;
    RayFan fan;
  };

  /// Compares what the first observers of some rows see along some rays with lines of sight.
  void expect_lines_of_sight(const IndexRequest& request) const {
    const Store store(path_);
    NoProgress progress;
    const IndexLayout layout = lay_out_index(store, request, progress);
    ASSERT_GT(layout.sample.rays, 0U) << layout.sample.without_rays;
    const Ground ground(store, request, layout);
    const Tin tin = triangulate(store, Window::all(), request.detail, progress, request.themes);
    double seen = 0, hidden = 0;
    for (int n = 0; n < 6; ++n) {
      const double azimuth = azimuth_of_ray(
          std::uniform_int_distribution<unsigned>(0, layout.sample.rays - 1)(*random_), layout.sample.rays);
      const std::int64_t row = std::uniform_int_distribution<std::int64_t>(0, layout.grid.rows() - 1)(*random_);
      const std::int64_t post_row = ground.among.row + row * ground.among.step;
      const RayCourse course(ground.fan, azimuth, *ground.posts,
                             {ground.among.column, post_row,
                              ground.among.column + (layout.grid.columns() - 1) * ground.among.step, post_row});
      RayWalk walk{.place = ground.posts->place(0, post_row)};
      std::vector<Seen> lines;
      for (std::int64_t i = 0; i < std::min<std::int64_t>(layout.grid.columns(), PostRows::kTogether); ++i) {
        const auto height = ground.posts->ground(walk.place + i, ground.among.east, ground.among.south);
        const Point2 eye = layout.grid.centre(i, row);
        ASSERT_EQ(height.has_value(), height_on(tin, eye).has_value());
        lines.push_back(height ? by_lines(store, tin, request, eye, azimuth) : Seen{});
        const auto at = static_cast<std::size_t>(i);
        walk.there[at] = height.has_value();
        walk.ground[at] = height.value_or(0);
        walk.eye[at] = walk.ground[at] + request.height / tin.grid.resolution;
        if (!height) continue;
        ASSERT_NEAR(*height * tin.grid.resolution, *height_on(tin, eye), 1e-9);
        seen += lines.back().seen, hidden += lines.back().on_ground - lines.back().seen;
      }
      for (const Instructions instructions : instructions_here()) {
        walk_ray(course, *ground.posts, instructions, walk);
        for (std::size_t i = 0; i < lines.size(); ++i) {
          if (lines[i].looks == 0) continue;
          SCOPED_TRACE(testing::Message() << "observer " << i << " of row " << row << ", azimuth " << azimuth);
          EXPECT_EQ(walk.looks[i], lines[i].looks);
          EXPECT_EQ(walk.on_ground[i], lines[i].on_ground);
          EXPECT_EQ(walk.seen[i], lines[i].seen);
          EXPECT_EQ(walk.beyond[i], lines[i].beyond);
        }
      }
    }
    EXPECT_GT(seen, 0);
    EXPECT_GT(hidden, 0);
  }

  /// Asks about lines from posts and from between them, next to each other and far apart.
  void expect_lines_of_sight_from_everywhere(IndexRequest request) const {
    // Posts lie 25 m beside multiples of 50 m, where the centres of cells of 50 and 150 m are; those of 100 m lie
    // between.
    for (const double cell : {50.0, 150.0, 100.0}) {
      SCOPED_TRACE(cell);
      request.cell_size = cell;
      request.area = Window::box({300100, 197200, 302900, 199900});
      expect_lines_of_sight(request);
    }
  }

  IndexPart part(const IndexRequest& request, Instructions instructions) const {
    const Store store(path_);
    NoProgress progress;
    const IndexLayout layout = lay_out_index(store, request, progress);
    return index_part_by_rays(store, request, layout, all_cells(layout.grid), progress, instructions);
  }

  VisibilityIndex index(const IndexRequest& request) const {
    NoProgress progress;
    return visibility_index(Store(path_), request, progress);
  }

  std::string refusal(const IndexRequest& request) const {
    try {
      index(request);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  test::TemporaryDirectory directory_;
  std::string path_ = directory_.file("t.itin");
  std::unique_ptr<std::mt19937> random_ = std::make_unique<std::mt19937>(test::seed());
};

/// What lies at one place from observers next to each other lies side by side, however far apart they stand.
TEST_F(RayIndex, PostsLieSideBySide) {
  import_posts(with_lakes(rough(100)), 150);
  const Store store(path_);
  NoProgress progress;
  const auto reader =
      LatticeReader::open(store, Window::all(), ThemeChoice::none(), LatticeReader::Heights::kAll, 100000, progress);
  ASSERT_NE(reader, nullptr);
  const LatticeTin& lattice = reader->lattice();
  for (const int step : {1, 2, 3, 7, 64}) {
    const PostBox box{-3, 5, 140, 155};
    const std::int64_t first = 20;
    const PostRows posts(lattice, box, first, step);
    for (int n = 0; n < 2000; ++n) {
      const auto any = [&](std::int64_t low, std::int64_t high) {
        return std::uniform_int_distribution<std::int64_t>(low, high)(*random_);
      };
      const std::int64_t observer = any(0, 120 / step), column = any(box.west, box.east),
                         row = any(box.north, box.south), observers_row = any(box.north, box.south);
      const std::ptrdiff_t at =
          posts.place(observer, observers_row) + posts.offset(column - (first + observer * step), row - observers_row);
      const auto post = lattice.post_at(lattice.west + static_cast<double>(column) * lattice.spacing,
                                        lattice.north - static_cast<double>(row) * lattice.spacing);
      if (post) {
        EXPECT_EQ(posts.heights()[at], *post);
        EXPECT_GE(posts.highest({column, row, column, row}), *post);
      }
      const bool within = column >= 0 && row >= 0 && column < lattice.columns && row < lattice.rows;
      EXPECT_EQ(posts.halves()[at], within ? lattice.halves(lattice.cell(static_cast<std::uint32_t>(column),
                                                                         static_cast<std::uint32_t>(row)))
                                           : 0);
    }
  }
}

TEST_F(RayIndex, LooksAreLinesOfSight) {
  const test::CardiffTerrain terrain;
  IndexRequest request{.height = 2, .radius = 1000, .rays = 32};
  for (const HeightAt& ground : {HeightAt([&](int c, int r) { return terrain(c + 200, r + 150); }), rough(6)}) {
    import_posts(ground);
    for (const double target_height : {0.0, 3.0}) {
      request.target_height = target_height;
      expect_lines_of_sight_from_everywhere(request);
    }
  }
}

/// Where the Earth curves a thousand times as much, the ground is highest between edges.
TEST_F(RayIndex, LooksAreLinesOfSightOverTheSummitsOfStretches) {
  for (const double height : {0.0, 2.0}) {
    import_posts(rough(0.5));
    expect_lines_of_sight_from_everywhere(
        {.height = height, .target_height = 4, .radius = 1000, .rays = 32, .earth = Earth::effective_earth(1e-3)});
  }
  // Without curvature, and where rays bend upwards, there are none.
  import_posts(rough(4));
  expect_lines_of_sight_from_everywhere({.radius = 1000, .rays = 32, .earth = Earth::flat()});
}

TEST_F(RayIndex, LooksAcrossGroundWithoutDataAreLinesOfSight) {
  const test::CardiffTerrain terrain;
  for (const HeightAt& ground : {HeightAt([&](int c, int r) { return terrain(c + 200, r + 150); }), rough(6)}) {
    import_posts(with_lakes(ground));
    for (const Earth& earth : {Earth(), Earth::effective_earth(1e-3)})
      expect_lines_of_sight_from_everywhere(
          {.height = 3, .target_height = 1, .radius = 1200, .rays = 32, .earth = earth});
  }
}

TEST_F(RayIndex, IsTheSameBitsWhateverTheInstructionsAndThreads) {
  const test::CardiffTerrain terrain;
  import_posts(with_lakes([&](int c, int r) { return terrain(c + 200, r + 150); }));
  for (const double cell : {50.0, 100.0, 250.0}) {
    const IndexRequest request{.area = Window::all(), .cell_size = cell, .radius = 900, .rays = 24};
    const IndexPart first = part(request, instructions_here().front());
    EXPECT_GT(first.counts.lines, 0U);
    for (const Instructions instructions : instructions_here()) {
      for (const int threads : {1, 0}) {
        set_thread_count(threads);
        const IndexPart other = part(request, instructions);
        for (std::size_t i = 0; i < first.shares.share.size(); ++i) {
          ASSERT_TRUE(test::same_bits(first.shares.share[i], other.shares.share[i]));
          ASSERT_TRUE(test::same_bits(first.shares.standard_error[i], other.shares.standard_error[i]));
          ASSERT_TRUE(test::same_bits(first.shares.undecided[i], other.shares.undecided[i]));
        }
        EXPECT_EQ(first.counts.lines, other.counts.lines);
        EXPECT_EQ(first.counts.seen_of_ray, other.counts.seen_of_ray);
        EXPECT_EQ(first.counts.on_ground_of_ray, other.counts.on_ground_of_ray);
      }
    }
  }
}

/// Rays that meet whole cells alone are walked in another way.
TEST_F(RayIndex, GapsElsewhereChangeNothing) {
  const auto ground = rough(5);
  std::vector<double> heights;
  for (int i = 0; i < kSide * kSide; ++i) heights.push_back(ground(0, 0));
  const auto at = [&](int c, int r) { return heights[static_cast<std::size_t>(r * kSide + c)]; };
  const IndexRequest request{
      .area = Window::box({300700, 199000, 301000, 199300}), .cell_size = 50, .radius = 500, .rays = 64};
  import_posts(at);
  const VisibilityIndex whole = index(request);
  import_posts([&](int c, int r) { return c > 40 && r == 59 ? std::nan("") : at(c, r); });
  const VisibilityIndex beside = index(request);
  // Nearer, but within no ray: the lattice's tile is not whole.
  import_posts([&](int c, int r) { return c == 45 && r == 9 ? std::nan("") : at(c, r); });
  const VisibilityIndex near = index(request);
  EXPECT_EQ(whole.share, beside.share);
  EXPECT_EQ(whole.share, near.share);
  EXPECT_EQ(whole.lines, near.lines);
  EXPECT_EQ(near.mean_undecided, 0);
}

/// A look is one cell of a polar raster, so that a viewshed of fine cells finds what rays estimate.
TEST_F(RayIndex, AgreesWithViewshedsWithinItsStandardError) {
  const test::CardiffTerrain terrain;
  constexpr int kWide = 100;
  import_posts([&](int c, int r) { return std::hypot(c - 70, r - 30) < 6 ? std::nan("") : terrain(c + 200, r + 150); },
               kWide);
  const IndexRequest request{.area = Window::box({301500, 196000, 303500, 198000}),
                             .cell_size = 250,
                             .height = 10,
                             .target_height = 2,
                             .radius = 1500,
                             .rays = 16};
  const VisibilityIndex result = index(request);
  ASSERT_EQ(result.grid.cell_count(), 64U);
  int within = 0, compared = 0;
  double squared = 0, mean = 0;
  for (std::size_t i = 0; i < result.share.size(); ++i) {
    if (std::isnan(result.share[i])) continue;
    Request look;
    look.observers = {
        {"o", result.grid.centre(static_cast<std::int64_t>(i) % 8, static_cast<std::int64_t>(i) / 8), 10}};
    // Cells of 10 m would have many of their centres on edges between posts, and more of them would be seen.
    look.target_height = 2, look.radius = 1500, look.cell_size = 7;
    NoProgress progress;
    const CellCounts cells = compute(Store(path_), look, progress).cells;
    const double truth =
        static_cast<double>(cells.visible) / static_cast<double>(cells.visible + cells.hidden + cells.undecided);
    const double errors = (result.share[i] - truth) / result.standard_error[i];
    within += std::abs(errors) <= 2, ++compared;
    squared += errors * errors, mean += truth;
  }
  EXPECT_GT(compared, 55);
  EXPECT_GE(within, 0.95 * compared);
  // The stated error is not so large that it says nothing.
  EXPECT_GT(squared / compared, 0.1);
  EXPECT_NEAR(result.mean, mean / compared, 2 * result.mean_error);
}

TEST_F(RayIndex, SaysWhereThereAreNoRays) {
  import_posts(rough(5));
  IndexRequest request{.area = Window::box({300500, 197500, 302500, 199500}), .cell_size = 100, .radius = 500};
  EXPECT_EQ(index(request).sample.rays, 128U);
  EXPECT_EQ(index(request).sample.without_rays, "");
  request.targets = 16;
  EXPECT_EQ(index(request).sample.targets, 16U);
  EXPECT_EQ(index(request).sample.without_rays, "");
  request.rays = 16;
  EXPECT_NE(refusal(request).find("give one of them"), std::string::npos);
  request.targets.reset(), request.rays = 7;
  EXPECT_NE(refusal(request).find("at least 8 rays"), std::string::npos);
  const auto expect_targets = [&](const std::string& why) {
    request.rays.reset();
    const IndexSample sample = index(request).sample;
    EXPECT_EQ(sample.rays, 0U);
    EXPECT_EQ(sample.targets, 128U);
    EXPECT_NE(sample.without_rays.find(why), std::string::npos) << sample.without_rays;
    request.rays = 16;
    EXPECT_NE(refusal(request).find(why), std::string::npos) << refusal(request);
  };
  request.cell_size = 130;
  expect_targets("cells of 130 m are no multiple of the 50 m between posts");
  request.cell_size = 100, request.detail = Detail::tolerance(1);
  expect_targets("not that of the posts of one raster");
}

}  // namespace
}  // namespace itin::viewshed
