// The field that an InputError names, as data, for requests of every library.
#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <itin/coordinates.hpp>
#include <itin/earth.hpp>
#include <itin/error.hpp>
#include <itin/import.hpp>
#include <profile/los.hpp>
#include <profile/path_profiles.hpp>
#include <viewshed/site_plan.hpp>
#include <viewshed/viewshed.hpp>
#include <viewshed/visibility_index.hpp>
#include <viewshed/zone_study.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"

namespace itin::viewshed {
namespace {

/// A store of level ground, 400 m by 400 m.
class ErrorFields : public testing::Test {
 protected:
  void SetUp() override {
    test::write_raster(file("t.tif"), {300000, 200400, 20, 20, 20, 27700}, [](int, int) { return 50.0; });
    ImportOptions terrain;
    terrain.sources = {file("t.tif")};
    import_terrain(file("s.itin"), terrain, progress_);
  }
  std::string file(const std::string& name) const { return directory_.file(name); }
  Store store() const { return Store(file("s.itin")); }

  /// The field that the call's error names; "none" where it throws no InputError.
  static std::string field_of(const std::function<void()>& call) {
    try {
      call();
    } catch (const InputError& error) {
      return error.field();
    }
    return "none";
  }

  /// The field that is wrong in a viewshed's request after `spoil` has changed it.
  std::string field_of_viewshed(const std::function<void(Request&)>& spoil) {
    Request request;
    request.observers = {{"mast", {300200, 200200}, 10}};
    request.radius = 100, request.cell_size = 10;
    spoil(request);
    return field_of([&] { compute(store(), request, progress_); });
  }
  std::string field_of_plan(const std::function<void(SitePlanRequest&)>& spoil) {
    SitePlanRequest request{.candidates = {.places = {{.name = "a", .position = {300200, 200200}}}}, .count = 1};
    request.radius = 100;
    spoil(request);
    return field_of([&] { plan_sites(store(), request, progress_); });
  }

  test::TemporaryDirectory directory_;
  NoProgress progress_;
};

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

TEST_F(ErrorFields, OfViewsheds) {
  EXPECT_EQ(field_of_viewshed([](Request&) {}), "none");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.observers.clear(); }), "observers");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.observers[0].position = {0, 0}; }), "observers");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.observers[0].height = -1; }), "observers");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.radius = -1; }), "radius");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.observers[0].radius = -1; }), "observers");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.min_radius = 1000; }), "min_radius");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.target_height = -1; }), "target_height");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.cell_size = 0; }), "cell_size");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.cell_size = 1000; }), "cell_size");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.azimuth = {kNoNumber, 10}; }), "azimuth");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.elevation = {20, 10}; }), "elevation");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.earth.refraction = 1; }), "refraction");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.themes = ThemeChoice::parse("moat"); }), "themes");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.mode = Mode::kProbability; }), "vertical_error");
  EXPECT_EQ(field_of_viewshed([](Request& r) { r.mode = Mode::kHeight, r.engine = Engine::kRays; }), "engine");
}

TEST_F(ErrorFields, OfPlansZonesAndIndices) {
  EXPECT_EQ(field_of_plan([](SitePlanRequest&) {}), "none");
  EXPECT_EQ(field_of_plan([](SitePlanRequest& r) { r.candidates = {}; }), "candidates");
  EXPECT_EQ(field_of_plan([](SitePlanRequest& r) { r.radius = 0; }), "radius");
  EXPECT_EQ(field_of_plan([](SitePlanRequest& r) { r.cell_size = 0; }), "cell_size");
  EXPECT_EQ(field_of_plan([](SitePlanRequest& r) { r.share = 2; }), "share");
  EXPECT_EQ(field_of_plan([](SitePlanRequest& r) { r.count.reset(); }), "count");
  EXPECT_EQ(field_of([&] { study_zone(store(), {.zone = {.cell_size = 10}}, progress_); }), "turbines");
  EXPECT_EQ(
      field_of([&] { visibility_index(store(), {.area = Window::all(), .cell_size = 20, .radius = 0}, progress_); }),
      "radius");
}

TEST_F(ErrorFields, OfLinesAndPaths) {
  const auto field_of_line = [&](Point2 to, double height) {
    profile::StoreLine line;
    line.from = {300100, 200100}, line.to = to;
    profile::LosQuery query;
    query.from_height_m = height;
    return field_of([&] { profile::analyse(store(), line, query); });
  };
  EXPECT_EQ(field_of_line({300300, 200300}, 2), "none");
  EXPECT_EQ(field_of_line({300300, 200300}, -1), "from_height_m");
  EXPECT_EQ(field_of_line({0, 0}, 2), "to");
  EXPECT_EQ(field_of([&] { profile::profiles_along(store(), {.corners = {{0, 0}}}, progress_); }), "corners");
  EXPECT_EQ(field_of([] { Detail::tolerance(-1); }), "tolerance");
}

TEST_F(ErrorFields, OfImports) {
  const auto field_of_import = [&](const std::function<void(ImportOptions&)>& spoil) {
    ImportOptions options;
    options.sources = {file("t.tif")};
    spoil(options);
    return field_of([&] { import_terrain(file("new.itin"), options, progress_); });
  };
  EXPECT_EQ(field_of_import([](ImportOptions& o) { o.sources.clear(); }), "sources");
  EXPECT_EQ(field_of_import([](ImportOptions& o) { o.to_crs = "EPSG:1"; }), "to_crs");
  EXPECT_EQ(field_of_import([](ImportOptions& o) { o.to_crs = "EPSG:4326"; }), "to_crs");
  EXPECT_EQ(field_of_import([](ImportOptions& o) { o.where = "x > 1"; }), "where");
  EXPECT_EQ(field_of_import([](ImportOptions& o) { o.repair = false; }), "repair");
  EXPECT_EQ(field_of_import([](ImportOptions& o) { o.resolution = 0; }), "resolution");
  EXPECT_EQ(field_of([&] { import_lines(file("s.itin"), {}, progress_); }), "kind");
}

TEST_F(ErrorFields, AreNoneWhereAPlaceOrAFileIsWrong) {
  const CoordinateTransform to_britain("EPSG:4326", "EPSG:27700");
  EXPECT_EQ(field_of([&] { to_britain({51000, 300000}); }), "");
}

}  // namespace
}  // namespace itin::viewshed
