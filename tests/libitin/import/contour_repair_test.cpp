// Points inferred in the flat triangles of contours: by hand, and against a grid of the same ground.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature;

LineFeature ellipse(Point2 centre, double rx, double ry, double z, int count = 48) {
  LineFeature f;
  for (int i = 0; i <= count; ++i) {
    const double angle = 2 * std::numbers::pi * (i % count) / count;
    f.vertices.push_back({centre.x + rx * std::cos(angle), centre.y + ry * std::sin(angle), z});
  }
  return f;
}

/// Down to both sides of its tip, as a valley's contour that is open towards the south.
LineFeature horseshoe(Point2 tip, double width, double z) {
  LineFeature f;
  for (int i = -40; i <= 40; ++i) {
    const double t = i / 40.0;
    f.vertices.push_back({tip.x + t * width / 2, tip.y * (1 - t * t), z});
  }
  return f;
}

/// Straight pieces with a vertex every 25 m or so.
LineFeature polyline(const std::vector<Point2>& corners, double z) {
  LineFeature f;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Point2 a = corners[i - 1], b = corners[i];
    const int pieces = static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / 25));
    for (int k = i == 1 ? 0 : 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      f.vertices.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), z});
    }
  }
  return f;
}

class ContourRepair : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }

  ImportReport add(const std::vector<LineFeature>& features, ThemeKind kind = ThemeKind::Contours, bool repair = true,
                   const std::string& store = "s.itin", const std::string& theme = "") const {
    test::write_lines(path("lines.geojson"), features);
    ImportOptions options;
    options.sources = {path("lines.geojson")};
    options.kind = kind;
    options.theme = theme;
    options.repair = repair;
    NoProgress progress;
    return import_lines(path(store), options, progress);
  }

  Tin surface(const std::string& store = "s.itin") const {
    NoProgress progress;
    const Store s(path(store));
    EXPECT_TRUE(check(s, progress).empty());
    return triangulate(s, Window::all(), Detail::tolerance(0), progress);
  }

  std::vector<Point3> inferred(const std::string& store = "s.itin") const {
    const Tin tin = surface(store);
    const std::vector<SourceInfo> sources = Store(path(store)).metadata().sources;
    std::vector<Point3> points;
    for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
      if (sources[tin.sources[v]].kind == "inferred") points.push_back(tin.point(v));
    }
    return points;
  }

  test::TemporaryDirectory directory_;
};

/// The surface's height, by looking at every triangle; NaN beyond the ground.
double height_at(const Tin& tin, Point2 p) {
  for (const Triangle& t : tin.triangles) {
    const std::array<Point3, 3> c{tin.point(t[0]), tin.point(t[1]), tin.point(t[2])};
    const auto area = [](Point2 a, Point2 b, Point2 q) {
      return (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x);
    };
    const Point2 a{c[0].x, c[0].y}, b{c[1].x, c[1].y}, d{c[2].x, c[2].y};
    const double wa = area(b, d, p), wb = area(d, a, p), wc = area(a, b, p);
    if (wa < 0 || wb < 0 || wc < 0) continue;
    return (wa * c[0].z + wb * c[1].z + wc * c[2].z) / (wa + wb + wc);
  }
  return std::nan("");
}

std::size_t flat_triangles(const Tin& tin) {
  return static_cast<std::size_t>(std::count_if(tin.triangles.begin(), tin.triangles.end(), [&](const Triangle& t) {
    return tin.vertices[t[0]].z == tin.vertices[t[1]].z && tin.vertices[t[0]].z == tin.vertices[t[2]].z;
  }));
}

TEST_F(ContourRepair, RaisesAHilltopAndStaysWithinHalfTheInterval) {
  const ImportReport report = add({ellipse({1000, 1000}, 900, 500, 100), ellipse({1000, 1000}, 500, 150, 110)});
  EXPECT_GT(report.flat_before, 40u);
  EXPECT_EQ(report.flat_after, 0u);
  const std::vector<Point3> top = inferred();
  EXPECT_EQ(report.inferred, top.size());
  for (const Point3& p : top) {
    EXPECT_GT(p.z, 110);
    EXPECT_LE(p.z, 115);
  }
  const Tin tin = surface();
  EXPECT_EQ(flat_triangles(tin), 0u);
  // The interval outside falls by 10 m in 350 to 400 m; the contour is 150 m away.
  EXPECT_NEAR(height_at(tin, {1000, 1000}), 114, 1);
}

TEST_F(ContourRepair, DeepensAPit) {
  add({ellipse({1000, 1000}, 900, 500, 110), ellipse({1000, 1000}, 500, 150, 100)});
  const std::vector<Point3> pit = inferred();
  ASSERT_FALSE(pit.empty());
  for (const Point3& p : pit) {
    EXPECT_LT(p.z, 100);
    EXPECT_GE(p.z, 95);
  }
}

TEST_F(ContourRepair, LeavesALoneContourAsItIs) {
  const ImportReport report = add({ellipse({1000, 1000}, 500, 150, 110)});
  EXPECT_EQ(report.flat_before, 46u);
  EXPECT_EQ(report.flat_after, 46u);
  EXPECT_EQ(report.inferred, 0u);
}

TEST_F(ContourRepair, LaysASaddleBetweenTwoHills) {
  add({ellipse({1500, 1000}, 1400, 900, 100), ellipse({950, 1000}, 450, 400, 110), ellipse({2050, 1000}, 450, 400, 110),
       ellipse({950, 1000}, 200, 150, 120), ellipse({2050, 1000}, 200, 150, 120)});
  const Tin tin = surface();
  const double pass = height_at(tin, {1500, 1000});
  EXPECT_LT(pass, 109.5);
  EXPECT_GE(pass, 105);
  double before = pass;
  // Down to the valleys on both sides.
  for (const double side : {-1.0, 1.0}) {
    before = pass;
    for (double y = 150; y <= 850; y += 100) {
      const double z = height_at(tin, {1500, 1000 + side * y});
      EXPECT_LE(z, before + 0.2) << y;
      EXPECT_GE(z, 100) << y;
      before = z;
    }
  }
}

TEST_F(ContourRepair, LetsAValleyFallEvenlyFromTipToTip) {
  // Open lines, which end at the border of the ground.
  const ImportReport report =
      add({horseshoe({500, 2000}, 1000, 110), horseshoe({500, 1000}, 500, 100), horseshoe({500, 3000}, 1500, 120)});
  EXPECT_GT(report.flat_before, 0u);
  EXPECT_LT(report.flat_after, report.flat_before / 20 + 1);
  const Tin tin = surface();
  for (double y = 1050; y < 2000; y += 50) {
    EXPECT_NEAR(height_at(tin, {500, y}), 100 + 10 * (y - 1000) / 1000, 0.7) << y;
  }
  for (const Point3& p : inferred()) {
    EXPECT_GE(p.z, 95);
    EXPECT_LE(p.z, 120);
  }
}

TEST_F(ContourRepair, ReachesASpotHeightOnTop) {
  add({ellipse({1000, 1000}, 900, 500, 100), ellipse({1000, 1000}, 500, 150, 110)});
  test::write_lines(path("spot.geojson"), {});
  std::ofstream(path("spot.csv")) << "x,y,z\n1300,1000,118\n";
  ImportOptions options;
  options.sources = {path("spot.csv")};
  options.crs = "EPSG:27700";
  NoProgress progress;
  const ImportReport report = import_terrain(path("s.itin"), options, progress);
  EXPECT_EQ(report.flat_after, 0u);
  const Tin tin = surface();
  EXPECT_NEAR(height_at(tin, {1300, 1000}), 118, 0.01);
  // Evenly from the spot height to the far end of the contour.
  EXPECT_NEAR(height_at(tin, {900, 1000}), 114, 1);
}

TEST_F(ContourRepair, KeepsALakeFlat) {
  add({ellipse({1000, 1000}, 900, 700, 120), ellipse({1000, 1000}, 700, 500, 110)});
  LineFeature lake;  // a star, so that its triangles reach from shore to shore
  for (int i = 0; i <= 40; ++i) {
    const double angle = 2 * std::numbers::pi * (i % 40) / 40, r = i % 2 == 0 ? 300 : 180;
    lake.vertices.push_back({1000 + r * std::cos(angle), 1000 + r * std::sin(angle), 105});
  }
  lake.polygon = true;
  add({lake}, ThemeKind::Water);
  for (const Point3& p : inferred()) EXPECT_GT(std::hypot(p.x - 1000, p.y - 1000), 180);
  const Tin tin = surface();
  for (double x = 830; x <= 1170; x += 20) EXPECT_DOUBLE_EQ(height_at(tin, {x, 1000}), 105) << x;
}

TEST_F(ContourRepair, KeepsALakeFlatWhoseShoreIsAContour) {
  LineFeature shore = ellipse({1000, 1000}, 500, 150, 110);
  add({ellipse({1000, 1000}, 900, 500, 120), shore});
  EXPECT_FALSE(inferred().empty());
  shore.polygon = true;
  add({shore}, ThemeKind::Water);
  EXPECT_TRUE(inferred().empty());
  EXPECT_DOUBLE_EQ(height_at(surface(), {1000, 1000}), 110);
}

TEST_F(ContourRepair, LeavesNestedRingsAloneBetweenEachOther) {
  add({ellipse({1000, 1000}, 900, 900, 100), ellipse({1000, 1000}, 600, 600, 110),
       ellipse({1000, 1000}, 300, 300, 120)});
  for (const Point3& p : inferred()) EXPECT_LT(std::hypot(p.x - 1000, p.y - 1000), 300);
}

TEST_F(ContourRepair, DependsOnWhatWasImportedAlone) {
  const std::vector<LineFeature> one{horseshoe({500, 2000}, 1000, 110)},
      two{horseshoe({500, 1000}, 500, 100), horseshoe({500, 3000}, 1500, 120)};
  add(one, ThemeKind::Contours, true, "a.itin");
  add(two, ThemeKind::Contours, true, "a.itin");
  {
    set_thread_count(1);
    add(two, ThemeKind::Contours, true, "b.itin");
    add(one, ThemeKind::Contours, true, "b.itin");
    set_thread_count(0);
  }
  std::vector<LineFeature> both = one;
  both.insert(both.end(), two.begin(), two.end());
  add(both, ThemeKind::Contours, true, "c.itin");
  const Tin a = surface("a.itin");
  for (const char* other : {"b.itin", "c.itin"}) {
    const Tin b = surface(other);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.triangles, b.triangles);
  }
  EXPECT_EQ(inferred("a.itin").size(), inferred("b.itin").size());
}

TEST_F(ContourRepair, IsDoneUnlessAnImportOfContoursSaysOtherwise) {
  const std::vector<LineFeature> one{horseshoe({500, 2000}, 1000, 110)}, two{horseshoe({500, 1000}, 500, 100)},
      road{polyline({{450, 100}, {550, 300}}, 0)};
  ImportReport report = add(one, ThemeKind::Contours, true);
  report = add(two, ThemeKind::Contours, true, "s.itin", "more");
  EXPECT_GT(report.inferred, 0u);
  // Another import changes nothing in that.
  const ImportReport with_road = add(road, ThemeKind::Roads);
  EXPECT_EQ(with_road.inferred, report.inferred);
  const std::vector<SourceInfo> sources = Store(path("s.itin")).metadata().sources;
  ASSERT_EQ(sources.size(), 4u);
  EXPECT_EQ(sources.back().kind, "inferred");
  EXPECT_EQ(sources.back().path, "inferred from contours");
  EXPECT_EQ(sources.back().vertices, report.inferred);
  report = add(one, ThemeKind::Contours, false);
  EXPECT_EQ(report.inferred, 0u);
  EXPECT_GT(report.flat_before, 0u);
  EXPECT_EQ(report.flat_before, report.flat_after);
  EXPECT_EQ(Store(path("s.itin")).metadata().sources.size(), 4u);
  // Whichever came first.
  report = add(two, ThemeKind::Contours, true, "s.itin", "more");
  EXPECT_EQ(report.inferred, 0u);
  EXPECT_THAT(report.warnings, testing::Contains(testing::HasSubstr("`repair = false`")));
}

// Truth: OS Terrain 50 has the same tile as contours and as a grid.

struct Errors {
  double rms = 0, mean = 0, worst = 0;
  std::size_t posts = 0;
};

/// At all posts on ground, triangle by triangle.
Errors errors(const Tin& tin, const std::string& grid) {
  GDALAllRegister();
  auto* dataset = GDALDataset::Open(grid.c_str());
  if (dataset == nullptr) throw std::runtime_error("cannot open " + grid);
  double transform[6];
  dataset->GetGeoTransform(transform);
  const int columns = dataset->GetRasterXSize(), rows = dataset->GetRasterYSize();
  std::vector<double> heights(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, heights.data(), columns, rows,
                                                GDT_Float64, 0, 0),
            CE_None);
  GDALClose(dataset);
  std::vector<double> difference(heights.size(), std::nan(""));
  for (const Triangle& t : tin.triangles) {
    const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
    const auto index = [&](double v, int axis) {
      return (v - transform[axis == 0 ? 0 : 3]) / transform[axis == 0 ? 1 : 5] - 0.5;
    };
    const auto [west, east] = std::minmax({index(a.x, 0), index(b.x, 0), index(c.x, 0)});
    const auto [north, south] = std::minmax({index(a.y, 1), index(b.y, 1), index(c.y, 1)});
    for (int r = std::max(0, int(std::ceil(north))); r <= std::min(rows - 1, int(std::floor(south))); ++r) {
      for (int q = std::max(0, int(std::ceil(west))); q <= std::min(columns - 1, int(std::floor(east))); ++q) {
        const double x = transform[0] + (q + 0.5) * transform[1], y = transform[3] + (r + 0.5) * transform[5];
        const double wa = (b.x - x) * (c.y - y) - (c.x - x) * (b.y - y);
        const double wb = (c.x - x) * (a.y - y) - (a.x - x) * (c.y - y);
        const double wc = (a.x - x) * (b.y - y) - (b.x - x) * (a.y - y);
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const auto at = static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(q);
        difference[at] = (wa * a.z + wb * b.z + wc * c.z) / (wa + wb + wc) - heights[at];
      }
    }
  }
  Errors e;
  for (const double d : difference) {
    if (std::isnan(d)) continue;
    e.posts += 1;
    e.rms += d * d;
    e.mean += std::abs(d);
    e.worst = std::max(e.worst, std::abs(d));
  }
  e.rms = std::sqrt(e.rms / static_cast<double>(e.posts));
  e.mean /= static_cast<double>(e.posts);
  return e;
}

TEST_F(ContourRepair, BringsRealContoursCloserToTheGridOfTheSameGround) {
  const std::string folder = std::string(ITIN_DATA_DIR) + "/os-terrain50-contours-sk00/";
  if (!std::filesystem::exists(folder + "SK00.gml")) GTEST_SKIP() << folder << "SK00.gml is not there";
  std::array<Errors, 2> found;
  for (const bool repair : {false, true}) {
    const std::string store = path(repair ? "with.itin" : "without.itin");
    ImportOptions options;
    options.sources = {folder + "SK00.gml"};
    options.z_field = "propertyValue";
    options.tolerances = {1000};  // coarse levels are not looked at
    NoProgress progress;
    options.layer = "SpotHeight";
    import_terrain(store, options, progress);
    options.tolerances.clear();
    options.layer = "ContourLine";
    options.kind = ThemeKind::Contours;
    options.repair = repair;
    const ImportReport report = import_lines(store, options, progress);
    found[repair] =
        errors(surface(repair ? "with.itin" : "without.itin"), "/vsizip/" + folder + "sk00_grid.zip/SK00.asc");
    const Errors& e = found[repair];
    std::printf(
        "%s repair: rms %.3f m, mean %.3f m, greatest %.2f m at %zu posts; %llu flat triangles, %llu inferred\n",
        repair ? "with" : "without", e.rms, e.mean, e.worst, e.posts,
        static_cast<unsigned long long>(report.flat_after), static_cast<unsigned long long>(report.inferred));
    EXPECT_LE(report.flat_after, repair ? report.flat_before / 20 : report.flat_before);
  }
  EXPECT_LT(found[1].rms, 0.9 * found[0].rms);
  EXPECT_LT(found[1].mean, 0.95 * found[0].mean);
  EXPECT_LE(found[1].worst, found[0].worst);
}

}  // namespace
}  // namespace itin
