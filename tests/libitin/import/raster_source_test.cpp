// Rasters of every format, made and real, against a slow reading that shares no code with the import.
#include "import/rasters/raster_source.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <random>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>

#include "libitin/import/raster_fixture.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::MadeRaster;
using test::TemporaryDirectory;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ImportPlan plan_of(const std::string& path, ImportOptions options = {}) {
  options.sources = {path};
  return plan_import(options, nullptr);
}

/// Hills with decimetres, some metres high.
MadeRaster hills(int columns, int rows) {
  MadeRaster made;
  made.columns = columns, made.rows = rows;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      made.posts.push_back(std::round(1000 * std::sin(column * 0.1) + 800 * std::cos(row * 0.07) + column) / 10);
  return made;
}

MadeRaster whole_metres(MadeRaster made) {
  made.type = GDT_Int16;
  for (double& post : made.posts) post = std::round(post);
  return made;
}

class RasterSource : public ::testing::Test {
 protected:
  /// Reads a raster and compares it with the slow reading.
  test::Reading expect_exact(const std::string& path, const test::SlowRules& rules = {}, ImportOptions options = {}) {
    plan_ = plan_of(path, std::move(options));
    EXPECT_EQ(plan_.sources.size(), 1U);
    test::Reading reading = test::read(*plan_.sources.at(0));
    test::expect_same(reading, test::read_slowly(path, plan_, rules));
    return reading;
  }

  template <class E>
  std::string refusal(const std::string& path, const ImportOptions& options = {}) {
    try {
      for (const auto& source : plan_of(path, options).sources) test::read(*source);
    } catch (const E& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    ADD_FAILURE() << "no exception";
    return {};
  }

  TemporaryDirectory directory_;
  ImportPlan plan_;
};

TEST_F(RasterSource, ReadsGeoTiff) {
  MadeRaster made = hills(300, 200);
  made.nodata = -9999;
  for (std::size_t i = 0; i < made.posts.size(); i += 7) made.posts[i] = -9999;
  test::write_raster(directory_.file("a.tif"), made);
  const test::Reading reading = expect_exact(directory_.file("a.tif"));
  EXPECT_THAT(reading.counts.warnings, IsEmpty());
  EXPECT_THAT(plan_.warnings, IsEmpty());
  EXPECT_EQ(reading.counts.voids, (made.posts.size() + 6) / 7);
}

TEST_F(RasterSource, PlacesPostsAtCellCentres) {
  MadeRaster made = hills(2, 2);
  made.posts = {1, 2.5, 3.25, 4.01};
  test::write_raster(directory_.file("a.tif"), made);
  EXPECT_THAT(test::read(*plan_of(directory_.file("a.tif")).sources.at(0)).points,
              ElementsAre(GridPoint{30002500, 19992500, 325}, GridPoint{30002500, 19997500, 100},
                          GridPoint{30007500, 19992500, 401}, GridPoint{30007500, 19997500, 250}));
}

TEST_F(RasterSource, ReadsAsciiGrid) {
  MadeRaster made = hills(40, 30);
  made.driver = "AAIGrid";
  made.nodata = -9999;
  made.posts[17] = -9999;
  test::write_raster(directory_.file("a.asc"), made);
  expect_exact(directory_.file("a.asc"));
  std::filesystem::rename(directory_.file("a.asc"), directory_.file("a.txt"));
  std::filesystem::rename(directory_.file("a.prj"), directory_.file("a_.prj"));
  ImportOptions options;
  options.crs = "EPSG:27700";
  expect_exact(directory_.file("a.txt"), {1, "EPSG:27700"}, options);
}

TEST_F(RasterSource, ReadsDted) {
  MadeRaster made = whole_metres(hills(121, 121));
  made.driver = "DTED";
  made.crs = "EPSG:4326";
  made.transform = {7 - 1.0 / 240, 1.0 / 120, 0, 47 + 1.0 / 240, 0, -1.0 / 120};
  test::write_raster(directory_.file("a.dt0"), made);
  expect_exact(directory_.file("a.dt0"));
  EXPECT_EQ(plan_.crs_name, "EPSG:32632");
  EXPECT_TRUE(plan_.crs_chosen);
}

TEST_F(RasterSource, ReadsSrtmHgt) {
  MadeRaster made = whole_metres(hills(1201, 1201));
  made.driver = "SRTMHGT";
  made.crs = "EPSG:4326";
  made.nodata = -32768;
  made.transform = {-122 - 1.0 / 2400, 1.0 / 1200, 0, 47 + 1.0 / 2400, 0, -1.0 / 1200};
  made.posts[5] = -32768;
  test::write_raster(directory_.file("N46W122.hgt"), made);
  const test::Reading reading = expect_exact(directory_.file("N46W122.hgt"));
  EXPECT_THAT(reading.counts.warnings, IsEmpty());
  EXPECT_EQ(plan_.crs_name, "EPSG:32610");
}

TEST_F(RasterSource, ReadsVrtAndZip) {
  test::write_raster(directory_.file("a.tif"), hills(64, 48));
  MadeRaster zipped = hills(20, 30);
  zipped.transform[0] += 5000;
  test::write_raster(directory_.file("z.tif"), zipped);
  test::add_to_zip(directory_.file("b.zip"), "deep/b.tif", directory_.file("a.tif"));
  test::add_to_zip(directory_.file("b.zip"), "deep/a.tif", directory_.file("z.tif"));
  test::add_to_zip(directory_.file("b.zip"), "readme.txt", directory_.write("readme.txt", "heights"));
  test::copy_raster("VRT", directory_.file("a.tif"), directory_.file("a.vrt"));
  expect_exact(directory_.file("a.vrt"));
  expect_exact("/vsizip/" + directory_.file("b.zip") + "/deep/b.tif");

  ImportPlan plan = plan_of(directory_.file("b.zip"));
  ASSERT_EQ(plan.sources.size(), 2U);
  for (const auto& [k, name] : {std::pair{0, "/deep/a.tif"}, std::pair{1, "/deep/b.tif"}}) {
    const test::Reading reading = test::read(*plan.sources[static_cast<std::size_t>(k)]);
    EXPECT_EQ(reading.info.path, "/vsizip/" + directory_.file("b.zip") + name);
    EXPECT_EQ(reading.info.sha256, "");
    test::expect_same(reading, test::read_slowly(reading.info.path, plan));
  }
}

TEST_F(RasterSource, DoesNotDependOnBlocksOrThreads) {
  MadeRaster made = hills(1500, 300);  // more than a batch
  made.crs = "EPSG:4258";
  made.transform = {8, 0.001, 0, 50, 0, -0.001};
  test::write_raster(directory_.file("a.tif"), made);
  const test::Reading first = expect_exact(directory_.file("a.tif"));
  test::copy_raster("GTiff", directory_.file("a.tif"), directory_.file("t.tif"),
                    {"TILED=YES", "BLOCKXSIZE=128", "BLOCKYSIZE=64", "COMPRESS=DEFLATE"});
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    EXPECT_TRUE(test::read(*plan_of(directory_.file("t.tif")).sources.at(0)).points == first.points);
  }
  set_thread_count(0);
}

/// A file of one block of that many rows and columns, all of it absent.
void write_block(const std::string& path, int side) {
  CPLStringList options;
  for (const std::string& option : {std::string("TILED=YES"), fmt::format("BLOCKXSIZE={}", side),
                                    fmt::format("BLOCKYSIZE={}", side), std::string("SPARSE_OK=TRUE")})
    options.AddString(option.c_str());
  const GDALDatasetUniquePtr made(
      test::driver("GTiff").Create(path.c_str(), side, side, 1, GDT_Float32, options.List()));
  ASSERT_NE(made, nullptr);
  std::array<double, 6> transform = MadeRaster().transform;
  made->SetGeoTransform(transform.data());
  OGRSpatialReference crs;
  crs.importFromEPSG(27700);
  made->SetSpatialRef(&crs);
  made->GetRasterBand(1)->SetNoDataValue(-9999);
}

TEST_F(RasterSource, DoesNotDependOnMemory) {
  std::mt19937 random(test::seed());
  MadeRaster made = hills(700, 300);
  made.nodata = -9999;
  for (std::size_t i = 0; i < made.posts.size(); ++i)
    if (i % 700 / 64 % 3 == 0 && i / 700 / 32 % 2 == 0) made.posts[i] = -9999;
  test::write_raster(directory_.file("a.tif"), made);
  for (int run = 0; run < 12; ++run) {
    const auto side = [&] { return std::to_string(16 * (1 + random() % 30)); };
    std::vector<std::string> options{"SPARSE_OK=TRUE", "COMPRESS=DEFLATE"};
    const std::string width = side(), height = side();
    if (run % 3 != 0) options.insert(options.end(), {"TILED=YES", "BLOCKXSIZE=" + width, "BLOCKYSIZE=" + height});
    if (run % 3 == 0) options.push_back("BLOCKYSIZE=" + std::to_string(1 + random() % 300));
    SCOPED_TRACE(width + " by " + height);
    test::copy_raster("GTiff", directory_.file("a.tif"), directory_.file("b.tif"), options);
    ImportOptions little;
    little.memory_bytes = std::uint64_t{1} << (23 + random() % 8);
    expect_exact(directory_.file("b.tif"), {}, little);
  }
}

TEST_F(RasterSource, PassesOverWhatAVastRasterDoesNotHold) {
  MadeRaster made = hills(30, 20);
  made.nodata = -9999;
  made.posts[7] = -9999;
  test::write_raster(directory_.file("a.tif"), made);
  const auto part = [](int column, int row) {
    return fmt::format(
        R"(<SimpleSource><SourceFilename relativeToVRT="1">a.tif</SourceFilename><SourceBand>1</SourceBand>
      <SrcRect xOff="0" yOff="0" xSize="30" ySize="20"/><DstRect xOff="{}" yOff="{}" xSize="30" ySize="20"/>
      </SimpleSource>)",
        column, row);
  };
  const auto vast = [&](const std::string& nodata) {
    return directory_.write("vast.vrt",
                            R"(<VRTDataset rasterXSize="2000000000" rasterYSize="2000000000"><SRS>EPSG:27700</SRS>
      <GeoTransform>0,1,0,1000000,0,-1</GeoTransform><VRTRasterBand dataType="Float32" band="1">)" +
                                nodata + part(1000, 900) + part(400000, 300000) + "</VRTRasterBand></VRTDataset>");
  };
  ImportPlan plan = plan_of(vast("<NoDataValue>-9999</NoDataValue>"));
  const test::Reading reading = test::read(*plan.sources.at(0));
  EXPECT_EQ(reading.points.size(), 2 * made.posts.size() - 2);
  EXPECT_EQ(reading.counts.voids, 4'000'000'000'000'000'000U - reading.points.size());
  EXPECT_THAT(refusal<InputError>(vast("")), HasSubstr("declare a nodata value"));
}

TEST_F(RasterSource, RefusesBlocksBeyondMemory) {
  write_block(directory_.file("block.tif"), 16384);
  ImportOptions little;
  little.memory_bytes = std::uint64_t{1} << 30;
  const std::string expected = "block.tif: is stored in blocks of 16384 by 16384 posts, 1024 MB each";
  EXPECT_THAT(refusal<InputError>(directory_.file("block.tif"), little), HasSubstr(expected));
  test::copy_raster("VRT", directory_.file("block.tif"), directory_.file("block.vrt"));
  EXPECT_THAT(refusal<InputError>(directory_.file("block.vrt"), little), HasSubstr(expected));
  EXPECT_EQ(plan_of(directory_.file("block.vrt")).sources.size(), 1U) << "more memory";
}

TEST_F(RasterSource, HonoursMaskNodataAndNanTogether) {
  MadeRaster made = hills(10, 10);
  made.nodata = -5;
  made.posts[3] = -5;
  made.posts[4] = std::numeric_limits<double>::quiet_NaN();
  made.mask.assign(made.posts.size(), 255);
  made.mask[7] = made.mask[8] = 0;
  CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
  test::write_raster(directory_.file("a.tif"), made);
  CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", nullptr);
  const test::Reading reading = test::read(*plan_of(directory_.file("a.tif")).sources.at(0));
  EXPECT_EQ(reading.counts.voids, 4U);
  EXPECT_EQ(reading.points.size(), 96U);
  EXPECT_THAT(reading.counts.warnings, IsEmpty());
}

TEST_F(RasterSource, AppliesScaleAndOffset) {
  MadeRaster made = whole_metres(hills(30, 20));
  made.scale = 0.1, made.offset = 300;
  made.nodata = 12;  // a raw value
  test::write_raster(directory_.file("a.tif"), made);
  expect_exact(directory_.file("a.tif"));
}

TEST_F(RasterSource, FollowsRotatedRasters) {
  MadeRaster made = hills(30, 20);
  made.transform = {300000, 40, 30, 200000, 30, -40};
  test::write_raster(directory_.file("a.tif"), made);
  const test::Reading reading = expect_exact(directory_.file("a.tif"));
  EXPECT_THAT(reading.info.gap_basis, ElementsAre(60, 45, 45, -60));
  EXPECT_DOUBLE_EQ(reading.info.spacing, 50);
}

TEST_F(RasterSource, ConvertsStatedFeet) {
  for (const auto& [unit, metres] :
       {std::pair{"ft", 0.3048}, std::pair{"US survey foot", 1200.0 / 3937}, std::pair{"dm", 0.1},
        std::pair{"centimetres", 0.01}, std::pair{"Fathom", 1.8288}, std::pair{"Foot_US", 1200.0 / 3937},
        std::pair{"[m]", 1.0}, std::pair{"metre", 1.0}}) {
    MadeRaster made = hills(30, 20);
    made.unit = unit;
    test::write_raster(directory_.file("a.tif"), made);
    expect_exact(directory_.file("a.tif"), {.metres_per_height = metres});
    if (metres == 1) {
      EXPECT_THAT(plan_.warnings, IsEmpty());
    } else {
      EXPECT_THAT(plan_.warnings, ElementsAre(HasSubstr("converted to metres"))) << unit;
    }
  }
}

TEST_F(RasterSource, TakesTheUnitOfACompoundCrs) {
  test::write_raster(directory_.file("a.tif"), hills(30, 20));
  ImportOptions options;
  options.crs = "EPSG:27700+6360";  // NAVD88 height (ftUS)
  expect_exact(directory_.file("a.tif"), {.metres_per_height = 1200.0 / 3937}, options);
  EXPECT_EQ(plan_.crs_name, "EPSG:27700");
  EXPECT_THAT(plan_.warnings, ElementsAre(HasSubstr("converted to metres")));
}

TEST_F(RasterSource, RefusesAUnitThatIsNotUnderstood) {
  MadeRaster made = hills(30, 20);
  made.unit = "cubit";
  test::write_raster(directory_.file("a.tif"), made);
  EXPECT_THAT(refusal<InputError>(directory_.file("a.tif")),
              HasSubstr("a.tif: the unit of heights, 'cubit', is not understood; give `crs` the CRS of heights"));
  ImportOptions options;
  options.crs = "EPSG:5703";
  const test::Reading reading = expect_exact(directory_.file("a.tif"), {}, options);
  EXPECT_EQ(plan_.crs_name, "EPSG:27700");
  EXPECT_EQ(height_axis(reading.info.source_crs),
            (HeightAxis{"North American Vertical Datum 1988", "metre", 1, false}));
}

TEST_F(RasterSource, TurnsDepthsOver) {
  MadeRaster made = hills(30, 20);
  made.crs = "EPSG:27700+5715";
  test::write_raster(directory_.file("a.tif"), made);
  test::copy_raster("GTiff", directory_.file("a.tif"), directory_.file("old.tif"), {"GEOTIFF_VERSION=1.0"});
  for (const char* name : {"a.tif", "old.tif"}) {
    const test::Reading reading = expect_exact(directory_.file(name), {.metres_per_height = -1});
    EXPECT_THAT(plan_.warnings, ElementsAre(HasSubstr("heights are depths"))) << name;
    EXPECT_EQ(height_axis(reading.info.source_crs), (HeightAxis{"Mean Sea Level", "metre", 1, true})) << name;
  }
  made.crs = "EPSG:27700+6358";
  test::write_raster(directory_.file("b.tif"), made);
  expect_exact(directory_.file("b.tif"), {.metres_per_height = -1200.0 / 3937});
}

/// The meaning of heights is found again in the store, whichever part of the file it came from.
TEST_F(RasterSource, KeepsWhatHeightsMean) {
  struct Said {
    const char *crs, *unit, *option;
    HeightAxis axis;
  };
  for (const Said& said :
       {Said{"EPSG:27700", "", "", {}}, Said{"EPSG:27700", "ft", "", {"", "foot", 0.3048, false}},
        Said{"EPSG:27700", "", "EPSG:27700+5701", {"Ordnance Datum Newlyn", "metre", 1, false}},
        Said{"EPSG:27700", "ft", "EPSG:5715", {"Mean Sea Level", "metre", 1, true}},
        Said{"EPSG:27700+5715", "", "EPSG:27700", {"Mean Sea Level", "metre", 1, true}},
        Said{"EPSG:2229", "", "", {"", "US survey foot", 1200.0 / 3937, false}}, Said{"EPSG:2229", "m", "", {}}}) {
    MadeRaster made = hills(3, 2);
    made.crs = said.crs, made.unit = said.unit;
    made.transform = {6561000, 50, 0, 2000000, 0, -50};
    if (made.crs.find("27700") != std::string::npos) made.transform = {300000, 50, 0, 200000, 0, -50};
    test::write_raster(directory_.file("a.tif"), made);
    ImportOptions options;
    options.crs = said.option;
    const HeightAxis axis = height_axis(plan_of(directory_.file("a.tif"), options).sources.at(0)->info().source_crs);
    EXPECT_EQ(axis.datum, said.axis.datum) << said.crs;
    EXPECT_EQ(axis.unit, said.axis.unit) << said.crs;
    EXPECT_NEAR(axis.factor(), said.axis.factor(), 1e-12) << said.crs;
  }
}

TEST_F(RasterSource, TakesUndeclaredMarkersForVoids) {
  MadeRaster made = whole_metres(hills(30, 20));
  made.posts[0] = -32768, made.posts[1] = -32767, made.posts[2] = -9999, made.posts[3] = -13000, made.posts[4] = 21000;
  test::write_raster(directory_.file("a.tif"), made);
  const auto is_void = [](double raw) { return raw < -9000 || raw > 20000; };
  const test::Reading reading = expect_exact(directory_.file("a.tif"), {1, "", is_void});
  EXPECT_THAT(reading.counts.warnings,
              ElementsAre(HasSubstr("2 heights below -12000 m or above 20000 m"), HasSubstr("3 posts of -9999")));

  made.nodata = -1;  // then -9999 is a depth
  test::write_raster(directory_.file("b.tif"), made);
  expect_exact(directory_.file("b.tif"), {1, "", [](double raw) { return raw < -12000 || raw > 20000; }});
}

TEST_F(RasterSource, AsksWhichOfSeveralBands) {
  MadeRaster made = hills(30, 20);
  made.bands = 3;
  test::write_raster(directory_.file("a.tif"), made);
  EXPECT_THAT(refusal<InputError>(directory_.file("a.tif")), HasSubstr("has 3 bands, 1, 2, 3; say with `band` N"));
  ImportOptions options;
  options.band = 1;
  expect_exact(directory_.file("a.tif"), {}, options);
  EXPECT_THAT(plan_.warnings, ElementsAre());
  options.band = 4;
  EXPECT_THAT(refusal<InputError>(directory_.file("a.tif"), options), HasSubstr("has no band 4, only bands 1 to 3"));
}

TEST_F(RasterSource, TakesAnAlphaBandForAMask) {
  const std::string path = directory_.file("a.tif");
  {
    const char* const options[] = {"ALPHA=YES", nullptr};
    const GDALDatasetUniquePtr made(test::driver("GTiff").Create(path.c_str(), 8, 8, 2, GDT_Float32, options));
    std::array<double, 6> transform{300000, 50, 0, 200000, 0, -50};
    made->SetGeoTransform(transform.data());
    OGRSpatialReference crs;
    crs.SetFromUserInput("EPSG:27700");
    made->SetSpatialRef(&crs);
    made->GetRasterBand(1)->Fill(7);
    made->GetRasterBand(2)->Fill(255);
    float hidden = 0;
    ASSERT_EQ(made->GetRasterBand(2)->RasterIO(GF_Write, 3, 3, 1, 1, &hidden, 1, 1, GDT_Float32, 0, 0, nullptr),
              CE_None);
    made->GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand);
  }
  const ImportPlan plan = plan_of(path, {});
  const test::Reading reading = test::read(*plan.sources.at(0));
  EXPECT_EQ(reading.points.size(), 63U);
  ImportOptions options;
  options.band = 2;
  EXPECT_THAT(refusal<FileError>(path, options), HasSubstr("band 2 is a mask, and holds no heights"));
}

TEST_F(RasterSource, RefusesHeightsBeyondAll) {
  MadeRaster made = hills(8, 8);
  made.posts[9] = 1.5e6;
  test::write_raster(directory_.file("a.tif"), made);
  EXPECT_THAT(refusal<InputError>(directory_.file("a.tif")),
              HasSubstr("a.tif: at 300075,199925: a height of 1.5e+06 m is beyond 1000000 m"));
  // A value that marks missing data is no height, even where the file does not declare it.
  made.posts[9] = -3.4028234663852886e38;
  test::write_raster(directory_.file("b.tif"), made);
  const ImportPlan plan = plan_of(directory_.file("b.tif"), {});
  const test::Reading reading = test::read(*plan.sources.at(0));
  EXPECT_EQ(reading.points.size(), 63U);
  EXPECT_THAT(reading.counts.warnings, ElementsAre(HasSubstr("customarily marks missing data")));
}

TEST_F(RasterSource, GivesItsLatticeSteps) {
  test::write_raster(directory_.file("a.tif"), hills(30, 20));
  const SourceInfo info = expect_exact(directory_.file("a.tif")).info;
  EXPECT_THAT(info.gap_basis, ElementsAre(75, 0, 0, -75));
  EXPECT_DOUBLE_EQ(info.spacing, 50);
  EXPECT_EQ(info.path, directory_.file("a.tif"));
  EXPECT_EQ(info.kind, "terrain");
  EXPECT_EQ(info.source_crs, "EPSG:27700");
  EXPECT_EQ(info.imported.size(), 20U);
}

TEST_F(RasterSource, BoundsProjectedSteps) {
  MadeRaster made = hills(100, 80);
  made.crs = "EPSG:4326";
  made.transform = {8.5, 0.01, 0, 47, 0, -0.01};
  test::write_raster(directory_.file("a.tif"), made);
  const test::Reading reading = expect_exact(directory_.file("a.tif"));
  EXPECT_THAT(reading.counts.warnings, IsEmpty());
  // Every edge and diagonal of the lattice is ground, two steps in a row are not.
  const auto [ux, uy, vx, vy] = reading.info.gap_basis;
  OGRSpatialReference from, to;
  from.importFromEPSG(4326);
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  to.SetFromUserInput(plan_.crs_wkt.c_str());
  to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> transformation(OGRCreateCoordinateTransformation(&from, &to));
  const auto post = [&](int column, int row) {
    double x = 8.505 + column * 0.01, y = 46.995 - row * 0.01;
    transformation->Transform(1, &x, &y);
    return Point2{x, y};
  };
  const auto is_ground = [&, ux = ux, uy = uy, vx = vx, vy = vy](Point2 p, Point2 q) {
    const double ex = q.x - p.x, ey = q.y - p.y, cell = ux * vy - uy * vx;
    return std::abs((ex * vy - ey * vx) / cell) <= 1 && std::abs((ux * ey - uy * ex) / cell) <= 1;
  };
  for (int row = 0; row < 78; ++row) {
    for (int column = 0; column < 98; ++column) {
      const Point2 p = post(column, row);
      ASSERT_TRUE(is_ground(p, post(column + 1, row)));
      ASSERT_TRUE(is_ground(p, post(column, row + 1)));
      ASSERT_TRUE(is_ground(p, post(column + 1, row + 1)));
      ASSERT_TRUE(is_ground(post(column + 1, row), post(column, row + 1)));
      ASSERT_FALSE(is_ground(p, post(column + 2, row)));
      ASSERT_FALSE(is_ground(p, post(column, row + 2)));
      ASSERT_FALSE(is_ground(p, post(column + 2, row + 2)));
    }
  }
}

TEST_F(RasterSource, SaysWhenStepsVary) {
  MadeRaster made = hills(20, 60);
  made.crs = "EPSG:4326";
  made.transform = {8, 0.1, 0, 60, 0, -1};
  test::write_raster(directory_.file("a.tif"), made);
  EXPECT_THAT(test::read(*plan_of(directory_.file("a.tif")).sources.at(0)).counts.warnings,
              ElementsAre(HasSubstr("steps between posts vary")));
}

TEST_F(RasterSource, DigestsPlainFiles) {
  test::write_raster(directory_.file("a.tif"), hills(30, 20));
  const std::string digest = expect_exact(directory_.file("a.tif")).info.sha256;
  ASSERT_EQ(
      std::system(("sha256sum " + directory_.file("a.tif") + " | cut -c1-64 > " + directory_.file("sum")).c_str()), 0);
  std::string expected;
  std::ifstream(directory_.file("sum")) >> expected;
  EXPECT_EQ(digest, expected);
}

TEST_F(RasterSource, StopsWhenCancelled) {
  class Cancelling final : public Progress {
   public:
    void report(std::string_view, double) override {}
    bool cancelled() const override { return true; }
  } progress;
  test::write_raster(directory_.file("a.tif"), hills(30, 20));
  ImportPlan plan = plan_of(directory_.file("a.tif"));
  EXPECT_THROW(plan.sources[0]->read([](std::span<const GridPoint>) {}, progress), Cancelled);
}

TEST_F(RasterSource, RefusesWhatHoldsNoHeights) {
  MadeRaster plain = hills(8, 8);
  plain.transform = {};
  test::write_raster(directory_.file("plain.tif"), plain);
  EXPECT_THAT(refusal<InputError>(directory_.file("plain.tif")), HasSubstr("plain.tif: has no georeference"));

  MadeRaster homeless = hills(8, 8);
  homeless.crs.clear();
  test::write_raster(directory_.file("homeless.tif"), homeless);
  EXPECT_EQ(refusal<InputError>(directory_.file("homeless.tif")),
            directory_.file("homeless.tif") + ": does not say its CRS; give it with `crs` EPSG:xxxx");

  MadeRaster complex = hills(8, 8);
  complex.type = GDT_CFloat32;
  test::write_raster(directory_.file("complex.tif"), complex);
  EXPECT_THAT(refusal<FileError>(directory_.file("complex.tif")), HasSubstr("holds complex numbers"));

  const GDALDatasetUniquePtr picture(
      test::driver("GTiff").Create(directory_.file("map.tif").c_str(), 8, 8, 1, GDT_Byte, nullptr));
  GDALColorTable colours;
  const GDALColorEntry green{0, 255, 0, 255};
  colours.SetColorEntry(0, &green);
  picture->GetRasterBand(1)->SetColorTable(&colours);
  picture->FlushCache();
  EXPECT_THAT(refusal<FileError>(directory_.file("map.tif")), HasSubstr("holds colours of a palette, not heights"));
}

TEST_F(RasterSource, RefusesDamagedFiles) {
  test::write_raster(directory_.file("a.tif"), hills(300, 300));
  std::filesystem::resize_file(directory_.file("a.tif"), 200000);
  EXPECT_THAT(refusal<FileError>(directory_.file("a.tif")), HasSubstr("cannot be read"));
  std::filesystem::resize_file(directory_.file("a.tif"), 6);
  EXPECT_THAT(refusal<FileError>(directory_.file("a.tif")), HasSubstr("a.tif: cannot be read"));
}

}  // namespace
}  // namespace itin
