// Zones of visibility surveyed in parts, against the same all at once.
#include "turbines/zone_parts.hpp"

#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <viewshed/turbines.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/vector_file.hpp"

namespace itin::viewshed {
namespace {

constexpr int kZoneSide = 100;
constexpr double kZoneStep = 25;
constexpr Point2 kZoneCorner{300000, 200000};

/// Hills with a lake of no data and some houses, and two farms.
class ZoneParts : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<double> z = test::fractal_heights(129, 150, 0.5, test::seed());
    test::write_raster(directory_.file("t.tif"), {kZoneCorner.x, kZoneCorner.y, kZoneStep, kZoneSide, kZoneSide, 27700},
                       [&](int c, int r) {
                         if (std::hypot(c - 60, r - 45) < 5) return std::nan("");
                         return z[static_cast<std::size_t>(r) * 129 + static_cast<std::size_t>(c)];
                       });
    ImportOptions terrain;
    terrain.sources = {directory_.file("t.tif")};
    import_terrain(path(), terrain, progress_);
    add_houses();
    for (std::size_t k = 1; k <= 5; ++k) {
      Turbine t;
      t.number = k, t.farm = k < 4 ? "west" : "east";
      t.position = {kZoneCorner.x + (k < 4 ? 500 : 1900) + 90.0 * static_cast<double>(k), kZoneCorner.y - 900};
      t.tip_height = 100, t.hub_height = 60, t.rotor_diameter = 80, t.radius = 1200;
      request_.turbines.push_back(t);
    }
    request_.cell_size = 10;
    request_.themes = ThemeChoice::all();
  }

  std::string path() { return directory_.file("t.itin"); }

  void add_houses() {
    std::mt19937 random(test::seed());
    std::uniform_real_distribution<double> place(100, (kZoneSide - 1) * kZoneStep - 100);
    std::vector<test::LineFeature> houses;
    for (int i = 0; i < 40; ++i) {
      const double x = kZoneCorner.x + place(random), y = kZoneCorner.y - place(random);
      houses.push_back(test::box(x, y, x + 20, y + 12, 15));
    }
    test::write_lines(directory_.file("h.geojson"), houses, true);
    ImportOptions options;
    options.sources = {directory_.file("h.geojson")};
    options.kind = ThemeKind::Buildings;
    options.theme = "houses";
    options.height_field = "h";
    import_lines(path(), options, progress_);
  }

  Zone survey(std::optional<std::uint64_t> memory) {
    request_.memory_bytes = memory;
    return survey_turbines(Store(path()), request_, progress_);
  }

  static void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(a[i]), std::bit_cast<std::uint32_t>(b[i])) << "cell " << i;
  }

  static void expect_same(const Visibility& a, const Visibility& b) {
    EXPECT_EQ(a.hub_count, b.hub_count);
    EXPECT_EQ(a.tip_count, b.tip_count);
    EXPECT_EQ(a.turbines, b.turbines);
    for (const auto field :
         {&Visibility::visible_height_m, &Visibility::vertical_angle_deg, &Visibility::vertical_angle_sum_deg,
          &Visibility::horizontal_angle_deg, &Visibility::horizontal_from_deg, &Visibility::horizontal_occupied_deg,
          &Visibility::share, &Visibility::nearest_m})
      expect_same(a.*field, b.*field);
  }

  void expect_parts_make_the_whole() {
    const Zone whole = survey(std::nullopt);
    const double results = 2 * 40 * static_cast<double>(whole.grid.cell_count());
    const double surfaces = 110 * static_cast<double>(whole.statistics.triangles);
    const Zone parts = survey(static_cast<std::uint64_t>(results + 0.4 * surfaces));
    EXPECT_GT(zone_parts(Store(path()), parts, true).size(), 1U);
    EXPECT_EQ(parts.statistics.lines, whole.statistics.lines);
    expect_same(parts.bare, whole.bare);
    expect_same(*parts.screened, *whole.screened);
    EXPECT_EQ(parts.warnings, whole.warnings);
  }

  test::TemporaryDirectory directory_;
  ZoneRequest request_;
  NoProgress progress_;
};

TEST_F(ZoneParts, MakeTheWhole) {
  expect_parts_make_the_whole();
}

TEST_F(ZoneParts, LikewiseWhereWhatIsMissingHides) {
  request_.nodata = NoData::kBlock;
  expect_parts_make_the_whole();
}

TEST_F(ZoneParts, LittleMemoryIsRefusedWithWhatIsNeeded) {
  EXPECT_THROW(survey(100000), InputError);
}

}  // namespace
}  // namespace itin::viewshed
