// Heights of many positions in one call, against one window for each of them.
#include "triangulate/heights.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/raster.hpp>
#include <itin/tin_heights.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

/// Rough ground of 1.2 km by 1.2 km with a hole, and houses on it.
class Heights : public testing::Test {
 protected:
  void SetUp() override {
    random_.seed(test::seed());
    std::mt19937 rough(3);
    test::write_raster(directory_.file("t.tif"), {300000, 200000, 10, 120, 120, 27700}, [&](int c, int r) {
      const double height =
          100 + 8 * std::sin(c * 0.3) + 6 * std::cos(r * 0.23) + static_cast<double>(rough() % 300) / 100;
      return in_hole(c, r) ? double{NAN} : height;
    });
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    options.tolerances = {2, 8};
    import_terrain(directory_.file("s.itin"), options, progress_);
    std::vector<test::LineFeature> houses;
    for (int i = 0; i < 40; ++i) {
      const double x = in(300020, 300450), y = in(199450, 199940);
      houses.push_back(test::box(x, y, x + in(6, 30), y + in(6, 30), in(3, 15)));
    }
    test::write_lines(directory_.file("b.geojson"), houses, true);
    options.sources = {directory_.file("b.geojson")};
    options.kind = ThemeKind::Buildings;
    options.height_field = "h";
    import_lines(directory_.file("s.itin"), options, progress_);
    store_.emplace(directory_.file("s.itin"));
  }

  static bool in_hole(int c, int r) { return c >= 60 && c < 75 && r >= 60 && r < 75; }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  Tin whole(const Detail& detail, const ThemeChoice& themes) {
    return triangulate(*store_, Window::all(), detail, progress_, themes);
  }

  /// The slow twin.
  std::optional<double> alone(Point2 p, const Detail& detail, const ThemeChoice& themes, RetrievalStatistics* cost) {
    const double margin = 2 * store_->metadata().grid.resolution;
    const Window window = Window::box({p.x - margin, p.y - margin, p.x + margin, p.y + margin});
    const Tin tin = triangulate(*store_, window, detail, progress_, themes);
    if (cost != nullptr) *cost += tin.statistics;
    return height_on(tin, p);
  }

  /// Anywhere, on vertices, on edges, a hair beside them, at the edge of the data, over the hole and off the data.
  std::vector<Point2> positions(const Tin& tin) {
    std::vector<Point2> result;
    for (int i = 0; i < 400; ++i) {
      const std::size_t some = random_() % tin.triangles.size();
      const Triangle& t = tin.triangles[some];
      const Point3 a = tin.point(t[0]), b = tin.point(t[1]);
      const double part = i % 2 == 0 ? 0.5 : in(0, 1);
      result.push_back({in(299990, 301210), in(198790, 200010)});
      result.push_back({a.x, a.y});
      result.push_back({a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part});
      result.push_back({a.x + in(-1e-6, 1e-6), a.y + in(-0.02, 0.02)});
      result.push_back({in(300590, 300760), in(199240, 199410)});
      result.push_back(i % 2 == 0 ? Point2{300005, in(198805, 199995)} : Point2{in(300005, 301195), 198805});
    }
    return result;
  }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  std::mt19937 random_;
  NoProgress progress_;
};

TEST_F(Heights, AreThoseOfOneWindowForEachPosition) {
  for (const double tolerance : {0.0, 8.0}) {
    for (const ThemeChoice& themes : {ThemeChoice::none(), ThemeChoice::all()}) {
      const Detail detail = Detail::tolerance(tolerance);
      const Tin tin = whole(detail, themes);
      const std::vector<Point2> places = positions(tin);
      const auto heights = heights_at(*store_, places, detail, themes, progress_);
      ASSERT_EQ(heights.size(), places.size());
      int none = 0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(heights[i], alone(places[i], detail, themes, nullptr)) << places[i].x << "," << places[i].y;
        none += !heights[i];
      }
      EXPECT_GT(none, 100);
      EXPECT_LT(none, 800);
      for (std::uint32_t v = 0; v < tin.vertices.size(); v += 97) {
        const Point3 p = tin.point(v);
        EXPECT_NEAR(heights_at(*store_, {{p.x, p.y}}, detail, themes, progress_)[0].value(), p.z, 1e-6);
      }
    }
  }
}

TEST_F(Heights, OfManyPositionsReadEachBlockOnce) {
  const Detail full = Detail::tolerance(0);
  const Tin tin = whole(full, ThemeChoice::none());
  const std::vector<Point2> places = positions(tin);
  const RetrievedHeights together = retrieve_heights(*store_, places, full, ThemeChoice::none(), progress_);
  RetrievalStatistics one_by_one;
  for (const Point2& p : places) alone(p, full, ThemeChoice::none(), &one_by_one);
  EXPECT_GT(together.statistics.blocks_read, 0U);
  EXPECT_LE(together.statistics.blocks_read, tin.statistics.blocks_read);
  EXPECT_LE(together.statistics.points_read, tin.statistics.points_read);
  EXPECT_GT(one_by_one.blocks_read, 100 * together.statistics.blocks_read);
}

TEST_F(Heights, WhereThereIsNoPlaceAreNone) {
  const std::vector<Point2> nowhere = {{NAN, 199900}, {300100, INFINITY}, {1e300, -1e300}, {0, 0}, {300655, 199345}};
  for (const auto& height : heights_at(*store_, nowhere, Detail::tolerance(0), ThemeChoice::none(), progress_))
    EXPECT_FALSE(height);
  EXPECT_TRUE(heights_at(*store_, std::vector<Point2>{}, Detail::tolerance(0), ThemeChoice::none(), progress_).empty());
  EXPECT_THROW(heights_at(*store_, nowhere, Detail::tolerance(0), ThemeChoice::parse("trees"), progress_), InputError);
}

TEST_F(Heights, OfManyAtOnePlaceAreOne) {
  const std::vector<Point2> same(40000, Point2{300105, 199905});
  const auto heights = heights_at(*store_, same, Detail::tolerance(0), ThemeChoice::none(), progress_);
  for (const auto& height : heights) EXPECT_EQ(height, heights.front());
  EXPECT_TRUE(heights.front());
}

TEST_F(Heights, OfARasterAreThoseUnderItsCentres) {
  const RasterGrid cells({299980, 200020}, 4.1, 3.7, 310, 330);
  const Detail full = Detail::tolerance(0);
  const std::vector<float> heights = heights_at(*store_, cells, full, ThemeChoice::all(), progress_);
  ASSERT_EQ(heights.size(), cells.cell_count());
  int none = 0;
  for (std::int64_t r = 0; r < cells.rows(); ++r) {
    for (std::int64_t c = 0; c < cells.columns(); ++c) {
      const float height = heights[cells.index({c, r})];
      none += std::isnan(height);
      if (random_() % 200 != 0) continue;
      const auto expected = alone(cells.centre(c, r), full, ThemeChoice::all(), nullptr);
      ASSERT_EQ(std::isnan(height), !expected);
      if (expected) {
        EXPECT_EQ(height, static_cast<float>(*expected));
      }
    }
  }
  EXPECT_GT(none, 1000);
}

}  // namespace
}  // namespace itin
