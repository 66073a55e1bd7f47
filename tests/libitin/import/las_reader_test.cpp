#include "import/lidar/las_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <map>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>

#include "gdal/crs.hpp"
#include "import/lidar/las_file.hpp"
#include "import/lidar/las_projection.hpp"
#include "support/las_writer.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::geo_key_directory;
using test::las_bytes;
using test::LasContents;
using test::LasRecord;
using test::LittleEndian;
using test::TemporaryDirectory;
using ::testing::HasSubstr;

std::vector<LasRecord> some_points(int count, std::mt19937& random) {
  std::vector<LasRecord> points;
  for (int i = 0; i < count; ++i) {
    const auto any = [&] { return static_cast<std::int32_t>(random()); };
    points.push_back({any(), any(), any(), static_cast<std::uint8_t>(random() % 32), random() % 5 == 0});
  }
  return points;
}

struct Reading {
  std::vector<Point3> points;
  std::uint64_t filtered = 0;
};

Reading read_all(PointReader& reader) {
  Reading result;
  result.filtered = reader.read([&](PointBatch& batch, double) {
    for (std::size_t i = 0; i < batch.size(); ++i) result.points.push_back({batch.x[i], batch.y[i], batch.z[i]});
  });
  return result;
}

template <class E, class F>
std::string message_of(F&& call) {
  try {
    call();
  } catch (const E& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(LasFile, ReadsEveryVersionAndPointFormat) {
  const TemporaryDirectory directory;
  std::mt19937 random(1);
  for (int minor = 0; minor <= 4; ++minor)
    for (int format = 0; format <= 10; ++format)
      for (const int extra : {0, 7}) {
        SCOPED_TRACE(fmt::format("LAS 1.{} format {} extra {}", minor, format, extra));
        LasContents las;
        las.minor_version = minor;
        las.point_format = format;
        las.extra_bytes = extra;
        las.legacy_count_only = format < 6 && extra == 7;
        las.scale = {0.01, 0.001, 0.25};
        las.offset = {300000, -7, 12.5};
        las.points = some_points(40, random);
        if (format >= 6) las.points[0].classification = 200;
        const LasFile file(directory.write("a.las", las_bytes(las)));
        std::size_t i = 0;
        file.read([&](std::span<const LasPoint> points, double) {
          for (const LasPoint& p : points) {
            const LasRecord& r = las.points.at(i++);
            EXPECT_EQ(p.x, r.x * 0.01 + 300000);
            EXPECT_EQ(p.y, r.y * 0.001 - 7);
            EXPECT_EQ(p.z, r.z * 0.25 + 12.5);
            EXPECT_EQ(p.classification, r.classification);
            EXPECT_EQ(p.withheld, r.withheld);
          }
        });
        EXPECT_EQ(i, las.points.size());
      }
}

TEST(LasReader, LeavesOutNoiseAndWithheldPoints) {
  const TemporaryDirectory directory;
  LasContents las;
  las.minor_version = 4;
  las.point_format = 6;
  las.points = {{0, 0, 0, 2}, {1, 0, 0, 7}, {2, 0, 0, 18}, {3, 0, 0, 2, true}, {4, 0, 0, 9}, {5, 0, 0, 0}};
  const std::string path = directory.write("a.las", las_bytes(las));
  const auto kept = [&](std::vector<int> classes) {
    ImportOptions options;
    options.classes = std::move(classes);
    const Reading reading = read_all(*open_las_reader(path, options));
    EXPECT_EQ(reading.points.size() + reading.filtered, las.points.size());
    std::vector<int> xs;
    for (const Point3& p : reading.points) xs.push_back(static_cast<int>(std::lround(p.x * 100)));
    return xs;
  };
  EXPECT_EQ(kept({}), (std::vector{0, 4, 5}));
  EXPECT_EQ(kept({2}), (std::vector{0}));
  EXPECT_EQ(kept({7, 9}), (std::vector{1, 4}));
  EXPECT_THAT(message_of<InputError>([&] { kept({256}); }), HasSubstr("`classes` 256"));
}

TEST(LasReader, CentreDistrustsAnEmptyHeaderBox) {
  const TemporaryDirectory directory;
  LasContents las;
  las.points = {{100, 200, 0}, {300, 600, 0}};
  std::string bytes = las_bytes(las);
  EXPECT_EQ(open_las_reader(directory.write("a.las", bytes), {})->centre(), (Point2{2, 4}));
  for (std::size_t i = 0; i < 6; ++i) LittleEndian::put(bytes, 179 + 8 * i, 0.0);
  EXPECT_EQ(open_las_reader(directory.write("b.las", bytes), {})->centre(), (Point2{1, 2}));
}

LasProjection projection_of(const LasContents& las) {
  const TemporaryDirectory directory;
  return las_projection(LasFile(directory.write("a.las", las_bytes(las))));
}

LasContents with_keys(const std::vector<std::array<std::uint16_t, 2>>& keys) {
  LasContents las;
  las.vlrs = {{"other", 34735, "not ours"}, {"LASF_Projection", 34735, geo_key_directory(keys)}};
  las.points = {{}};
  return las;
}

TEST(LasProjection, ReadsGeoKeys) {
  EXPECT_EQ(projection_of(with_keys({{1024, 1}, {2048, 4326}, {3072, 27700}})).crs, "EPSG:27700");
  EXPECT_EQ(projection_of(with_keys({{1024, 2}, {2048, 4326}})).crs, "EPSG:4326");
  EXPECT_EQ(projection_of(with_keys({{1024, 1}, {2048, 4326}, {3072, 32767}})).crs, "");
  EXPECT_EQ(projection_of(with_keys({})).crs, "");
  EXPECT_FALSE(projection_of(with_keys({{3072, 27700}})).height_unit);
}

TEST(LasProjection, ReadsTheVerticalPart) {
  const auto heights = [](const std::vector<std::array<std::uint16_t, 2>>& keys) {
    return parse_any_crs(projection_of(with_keys(keys)).crs, "a").heights.value();
  };
  EXPECT_EQ(heights({{3072, 27700}, {4096, 5701}}), (HeightAxis{"Ordnance Datum Newlyn", "metre", 1, false}));
  EXPECT_EQ(heights({{3072, 32630}, {4096, 5715}}), (HeightAxis{"Mean Sea Level", "metre", 1, true}));
  EXPECT_TRUE(heights({{3072, 26917}, {4096, 6358}}).down);
  EXPECT_EQ(heights({{3072, 26912}, {3076, 9002}, {4096, 5703}}).datum, "North American Vertical Datum 1988");
  EXPECT_EQ(heights({{4096, 5703}}).unit, "metre");  // without a horizontal CRS
  EXPECT_EQ(parse_crs(projection_of(with_keys({{3072, 27700}, {4096, 5701}})).crs, "a").whole, "EPSG:27700+5701");
  EXPECT_EQ(projection_of(with_keys({{3072, 27700}, {4096, 5103}})).crs, "EPSG:27700");  // not known as a CRS
}

TEST(LasProjection, ReadsUnits) {
  const auto unit = [](const std::vector<std::array<std::uint16_t, 2>>& keys) {
    return projection_of(with_keys(keys)).height_unit.value().metres;
  };
  EXPECT_EQ(unit({{3072, 26912}, {3076, 9001}, {4099, 9003}}), 1200.0 / 3937.0);
  EXPECT_EQ(unit({{3072, 26912}, {4099, 9002}}), 0.3048);
  EXPECT_EQ(unit({{3072, 26912}, {4099, 9014}}), 1.8288);
  EXPECT_EQ(unit({{3072, 26912}, {4099, 1033}}), 0.01);
  EXPECT_NEAR(unit({{3072, 26912}, {4099, 9070}}), 0.3048008333, 1e-10);  // the foot of 1865, not of 1936
  EXPECT_EQ(unit({{3072, 2229}, {4096, 5703}, {4099, 9002}}), 0.3048);
  EXPECT_EQ(projection_of(with_keys({{3072, 26912}, {3076, 9001}})).crs, "EPSG:26912");
  const std::string feet = projection_of(with_keys({{3072, 26912}, {3076, 9002}})).crs;
  EXPECT_THAT(feet, HasSubstr("0.3048"));
  EXPECT_THAT(message_of<FileError>([] {
                projection_of(with_keys({{3072, 26912}, {4099, 9999}}));
              }),
              HasSubstr("EPSG:9999"));
}

TEST(LasProjection, ReadsWktFromEitherKindOfRecordAndHonoursThePreference) {
  LasContents las = with_keys({{3072, 27700}});
  las.minor_version = 4;
  las.point_format = 6;
  las.evlrs = {{"LASF_Projection", 2112, std::string("PROJCS[\"made up\"]\0\0", 19)}};
  EXPECT_EQ(projection_of(las).crs, "EPSG:27700");
  las.wkt_bit = true;
  EXPECT_EQ(projection_of(las).crs, "PROJCS[\"made up\"]");
  las.evlrs.clear();
  EXPECT_EQ(projection_of(las).crs, "EPSG:27700");
  las.vlrs = {{"LASF_Projection", 2112, "LOCAL"}};
  las.wkt_bit = false;
  EXPECT_EQ(projection_of(las).crs, "LOCAL");
}

// Damage -----------------------------------------------------------------------------------------------------------

LasContents small_las() {
  LasContents las = with_keys({{3072, 27700}});
  las.minor_version = 4;
  las.point_format = 7;
  las.evlrs = {{"LASF_Projection", 2112, "LOCAL"}};
  std::mt19937 random(2);
  las.points = some_points(5, random);
  return las;
}

std::string error_of(const std::string& bytes) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.las", bytes);
  const std::string message = message_of<FileError>([&] { read_all(*open_las_reader(path, {})); });
  EXPECT_TRUE(message.starts_with(path + ": ")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

template <class T>
std::string patched(std::size_t offset, T value) {
  std::string bytes = las_bytes(small_las());
  LittleEndian::put(bytes, offset, value);
  return bytes;
}

TEST(LasFile, LyingHeadersAreNamed) {
  EXPECT_THAT(error_of(patched(0, 'X')), HasSubstr("offset 0: not a LAS file"));
  EXPECT_THAT(error_of(patched(24, std::uint8_t{2})), HasSubstr("offset 24: LAS 2.4 is not supported"));
  EXPECT_THAT(error_of(patched(25, std::uint8_t{5})), HasSubstr("LAS 1.5 is not supported"));
  EXPECT_THAT(error_of(patched(94, std::uint16_t{227})), HasSubstr("offset 94"));
  EXPECT_THAT(error_of(patched(96, std::uint32_t{10})), HasSubstr("offset 96"));
  EXPECT_THAT(error_of(patched(96, std::uint32_t{4'000'000'000})), HasSubstr("offset 96"));
  EXPECT_THAT(error_of(patched(100, std::uint32_t{4'000'000'000})), HasSubstr("variable length record"));
  EXPECT_THAT(error_of(patched(104, std::uint8_t{11})), HasSubstr("point format 11"));
  EXPECT_THAT(error_of(patched(105, std::uint16_t{35})), HasSubstr("offset 105"));
  EXPECT_THAT(error_of(patched(105, std::uint16_t{0})), HasSubstr("offset 105"));
  EXPECT_THAT(error_of(patched(131, 0.0)), HasSubstr("offset 131"));
  EXPECT_THAT(error_of(patched(139, std::nan(""))), HasSubstr("offset 139"));
  EXPECT_THAT(error_of(patched(171, HUGE_VAL)), HasSubstr("offset 171"));
  EXPECT_THAT(error_of(patched(235, std::uint64_t{1} << 60)), HasSubstr("truncated or damaged"));
  EXPECT_THAT(error_of(patched(247, std::uint64_t{1} << 60)), HasSubstr("promises 1152921504606846976 points"));
  EXPECT_THAT(error_of(patched(247, std::uint64_t{0})), HasSubstr("holds no points"));
  EXPECT_THAT(error_of(""), HasSubstr("truncated"));
}

TEST(LasFile, MissingFileAndDirectory) {
  EXPECT_THAT(message_of<FileError>([] { LasFile("/nowhere/a.las"); }), HasSubstr("/nowhere/a.las"));
  EXPECT_THAT(message_of<FileError>([] { LasFile("/tmp"); }), HasSubstr("/tmp"));
}

TEST(LasFile, EveryTruncationIsAnErrorThatNamesAnOffset) {
  const TemporaryDirectory directory;
  const std::string whole = las_bytes(small_las());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string path = directory.write("cut.las", whole.substr(0, size));
    const std::string message = message_of<FileError>([&] { read_all(*open_las_reader(path, {})); });
    EXPECT_THAT(message, HasSubstr("offset ")) << size;
  }
}

TEST(LasFile, RandomDamageNeverDoesWorseThanAnError) {
  std::mt19937 random(test::seed());
  const TemporaryDirectory directory;
  int errors = 0, readings = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = las_bytes(small_las());
    // Half the damage goes to the header and the records behind it.
    for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips)
      bytes[random() % (random() % 2 ? 600 : bytes.size())] ^= static_cast<char>(1 << random() % 8);
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    const std::string path = directory.write("damaged.las", bytes);
    try {
      const auto reader = open_las_reader(path, {});
      const Reading reading = read_all(*reader);
      EXPECT_LE(reading.points.size() + reading.filtered, bytes.size() / 20);
      ++readings;
    } catch (const FileError& error) {
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
      ++errors;
    }
  }
  EXPECT_GT(errors, 300);
  EXPECT_GT(readings, 300);
}

// Real files -------------------------------------------------------------------------------------------------------

struct RealFile {
  std::string name;
  std::uint64_t points;
  Box bounds;
  double zmin, zmax;
  std::string crs;
};

class RealLas : public testing::TestWithParam<RealFile> {};

TEST_P(RealLas, CountsAndExtentsAreThoseOnRecord) {
  const RealFile& real = GetParam();
  const std::string path = std::string(ITIN_DATA_DIR) + "/" + real.name;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const LasFile file(path);
  std::uint64_t count = 0;
  Box bounds;
  double zmin = HUGE_VAL, zmax = -HUGE_VAL, last = 0;
  file.read([&](std::span<const LasPoint> points, double fraction) {
    EXPECT_LT(last, fraction);
    last = fraction;
    count += points.size();
    for (const LasPoint& p : points) {
      bounds.extend(Point2{p.x, p.y});
      zmin = std::min(zmin, p.z), zmax = std::max(zmax, p.z);
    }
  });
  EXPECT_EQ(last, 1);
  EXPECT_EQ(count, real.points);
  constexpr double kRounding = 1e-6;
  EXPECT_NEAR(bounds.xmin, real.bounds.xmin, kRounding);
  EXPECT_NEAR(bounds.ymin, real.bounds.ymin, kRounding);
  EXPECT_NEAR(bounds.xmax, real.bounds.xmax, kRounding);
  EXPECT_NEAR(bounds.ymax, real.bounds.ymax, kRounding);
  EXPECT_NEAR(zmin, real.zmin, kRounding);
  EXPECT_NEAR(zmax, real.zmax, kRounding);
  EXPECT_THAT(las_projection(file).crs, HasSubstr(real.crs));
}

INSTANTIATE_TEST_SUITE_P(, RealLas,
                         testing::Values(RealFile{"derived-las/ahn3_cropped_2.las",
                                                  208432,
                                                  {85000.001, 447412.8, 85072.299, 447641.299},
                                                  -0.606,
                                                  26.329,
                                                  ""},
                                         RealFile{"derived-las/ign_0299_6802.las",
                                                  278810,
                                                  {299000, 6801000, 300000, 6802000},
                                                  124.03,
                                                  177.85,
                                                  "AUTHORITY[\"EPSG\",\"2154\"]]"},
                                         RealFile{"derived-las/ign_0300_6802.las",
                                                  240482,
                                                  {300000, 6801000.01, 301000, 6802000},
                                                  124.51,
                                                  190.45,
                                                  "AUTHORITY[\"EPSG\",\"2154\"]]"},
                                         RealFile{"lidr-small/Topography.las",
                                                  73403,
                                                  {273357.14475, 5274357.1435, 273642.8565, 5274642.8475},
                                                  788.99325,
                                                  829.75825,
                                                  "EPSG:2949"}),
                         [](const auto& real) { return std::filesystem::path(real.param.name).stem().string(); });

TEST(LasReader, GroundOnlyIsLessThanAll) {
  const std::string path = std::string(ITIN_DATA_DIR) + "/derived-las/ign_0299_6802.las";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  std::map<int, std::uint64_t> histogram;
  std::uint64_t withheld = 0;
  LasFile(path).read([&](std::span<const LasPoint> points, double) {
    for (const LasPoint& p : points) p.withheld ? ++withheld : ++histogram[p.classification];
  });
  for (const auto& [c, n] : histogram)
    EXPECT_THAT((std::vector{1, 2, 3, 4, 5, 6, 9, 17, 64, 65, 66, 67}), testing::Contains(c)) << n;
  ImportOptions ground;
  ground.classes = {2};
  const Reading reading = read_all(*open_las_reader(path, ground));
  EXPECT_EQ(reading.points.size(), histogram[2]);
  EXPECT_EQ(reading.filtered, 278810 - histogram[2]);
  EXPECT_GT(histogram[2], 1000u);
}

TEST(LasReader, LaszipRecordAloneMarksCompression) {
  LasContents las = small_las();
  las.vlrs.push_back({"laszip encoded", 22204, "..."});
  EXPECT_THAT(error_of(las_bytes(las)), HasSubstr("a LASzip record of 3 bytes is damaged"));
}

TEST(LasReader, CompressionWithoutALaszipRecordIsDamage) {
  EXPECT_THAT(error_of(patched(104, std::uint8_t{128 + 7})), HasSubstr("a LASzip record of 0 bytes is damaged"));
}

TEST(LasReader, ReadsCompressedPointsAsItReadsOthers) {
  const std::string lidar = std::string(ITIN_SOURCE_DIR) + "/tests/libitin/import/lidar/";
  for (const char* name : {"ahn3", "ign"}) {
    const auto compressed = open_las_reader(lidar + name + ".laz", {}),
               plain = open_las_reader(lidar + name + ".las", {});
    EXPECT_EQ(compressed->centre(), plain->centre());
    EXPECT_EQ(compressed->extent(), plain->extent());
    const Reading one = read_all(*compressed), other = read_all(*plain);
    EXPECT_EQ(one.points, other.points);
    EXPECT_EQ(one.filtered, other.filtered);
    EXPECT_EQ(one.points.size() + one.filtered, 300U);
  }
}

}  // namespace
}  // namespace itin
