// Compressed lidar, against an encoder written for the tests, against uncompressed twins of real files, and damaged.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>

#include "import/lidar/las_file.hpp"
#include "support/laz_writer.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::LasRecord;
using test::LazContents;
using test::LazRecordOf;
using test::LazWriter;
using test::TemporaryDirectory;
using ::testing::HasSubstr;

/// Points that mostly lie close to each other, in pulses of some returns, and sometimes anywhere.
std::vector<LazRecordOf> pulses(int count, bool modern, std::mt19937& random) {
  const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  std::vector<LazRecordOf> points;
  LazRecordOf record;
  for (int i = 0; i < count; ++i) {
    LasRecord& p = record.point;
    const unsigned width = below(20) == 0 ? 32 : below(12) + 1;
    const auto move = [&](std::int32_t& axis) {
      axis = static_cast<std::int32_t>(static_cast<std::uint32_t>(axis) +
                                       static_cast<std::uint32_t>(static_cast<std::int32_t>(random()) >> (32 - width)));
    };
    move(p.x), move(p.y), move(p.z);
    if (below(4) == 0) p.classification = static_cast<std::uint8_t>(modern ? below(256) : below(32));
    if (below(10) == 0) p.withheld = !p.withheld;
    if (below(3) == 0) record.user = static_cast<std::uint8_t>(below(256));
    record.new_time = below(3) != 0;
    if (modern && below(8) == 0) record.channel = below(4);
    // All combinations occur, also those that make no sense.
    const unsigned most = modern ? 16 : 8;
    if (below(2) == 0) record.pulse_return = {below(3) == 0 ? below(most) : 1, below(3) == 0 ? below(most) : 1};
    points.push_back(record);
  }
  return points;
}

LazContents some_laz(int format, int count, std::mt19937& random) {
  LazContents laz;
  laz.las.point_format = format;
  laz.las.minor_version = format >= 6 ? 4 : 2;
  laz.las.scale = {0.01, 0.001, 0.25};
  laz.las.offset = {300000, -7, 12.5};
  laz.points = pulses(count, format >= 6, random);
  laz.seed = static_cast<std::uint32_t>(random());
  return laz;
}

std::vector<LasPoint> points_of(const std::string& path) {
  std::vector<LasPoint> all;
  LasFile(path).read(
      [&](std::span<const LasPoint> points, double) { all.insert(all.end(), points.begin(), points.end()); });
  return all;
}

void expect_alike(const std::vector<LasPoint>& a, const std::vector<LasPoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].x, b[i].x) << i;
    ASSERT_EQ(a[i].y, b[i].y) << i;
    ASSERT_EQ(a[i].z, b[i].z) << i;
    ASSERT_EQ(a[i].classification, b[i].classification) << i;
    ASSERT_EQ(a[i].withheld, b[i].withheld) << i;
  }
}

/// The same points in a file that is not compressed.
std::string twin_of(const LazContents& laz) {
  test::LasContents las = laz.las;
  for (const LazRecordOf& record : laz.points) las.points.push_back(record.point);
  return las_bytes(las);
}

TEST(Laz, EveryPointFormatReadsAsItsTwin) {
  std::mt19937 random(test::seed());
  const TemporaryDirectory directory;
  for (const int format : {0, 1, 2, 3, 6, 7, 8}) {
    for (const bool variable : {false, true}) {
      for (const int extra : {0, 5}) {
        SCOPED_TRACE(
            fmt::format("format {}, {} chunks, {} extra bytes", format, variable ? "variable" : "equal", extra));
        LazContents laz = some_laz(format, 3000, random);
        laz.las.extra_bytes = extra, laz.variable = variable,
        laz.chunk_points = 1 + static_cast<std::uint32_t>(random() % 900);
        const std::string compressed = directory.write("a.laz", LazWriter(laz).bytes());
        EXPECT_TRUE(LasFile(compressed).header().compressed);
        expect_alike(points_of(compressed), points_of(directory.write("a.las", twin_of(laz))));
      }
    }
  }
}

TEST(Laz, ChunksOfOnePointAndOfAllReadAlike) {
  std::mt19937 random(3);
  const TemporaryDirectory directory;
  for (const int format : {1, 6}) {
    LazContents laz = some_laz(format, 200, random);
    const std::vector<LasPoint> expected = points_of(directory.write("a.las", twin_of(laz)));
    for (const std::uint32_t size : {1U, 199U, 200U, 50000U}) {
      laz.chunk_points = size;
      expect_alike(points_of(directory.write("a.laz", LazWriter(laz).bytes())), expected);
    }
  }
}

TEST(Laz, AChunkTooLargeForOneBatchIsReadPieceByPiece) {
  std::mt19937 random(4);
  const TemporaryDirectory directory;
  LazContents laz = some_laz(0, 1 << 20, random);
  laz.chunk_points = 1 << 20;
  const std::string path = directory.write("a.laz", LazWriter(laz).bytes());
  std::size_t batches = 0;
  double last = 0;
  LasFile(path).read([&](std::span<const LasPoint>, double fraction) {
    EXPECT_LT(last, fraction);
    last = fraction, ++batches;
  });
  EXPECT_EQ(last, 1);
  EXPECT_EQ(batches, 2U);
  expect_alike(points_of(path), points_of(directory.write("a.las", twin_of(laz))));
}

TEST(Laz, ATableAtTheEndOfTheFileIsFound) {
  std::mt19937 random(5);
  const TemporaryDirectory directory;
  const LazContents laz = some_laz(1, 200, random);
  std::string bytes = LazWriter(laz).bytes();
  const std::size_t start = LasFile(directory.write("a.laz", bytes)).header().point_offset;
  bytes += bytes.substr(start, 8);
  test::LittleEndian::put(bytes, start, ~std::uint64_t{0});
  expect_alike(points_of(directory.write("b.laz", bytes)), points_of(directory.write("a.las", twin_of(laz))));
}

// Damage -----------------------------------------------------------------------------------------------------------

std::string complaint_about(const TemporaryDirectory& directory, const std::string& bytes) {
  const std::string path = directory.write("damaged.laz", bytes);
  try {
    points_of(path);
  } catch (const FileError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(path + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }
  return {};
}

TEST(Laz, EveryTruncationIsAnError) {
  std::mt19937 random(6);
  const TemporaryDirectory directory;
  for (const int format : {3, 7}) {
    const std::string whole = LazWriter(some_laz(format, 120, random)).bytes();
    for (std::size_t size = 0; size + 5 < whole.size();
         size += 3)  // the table's last bytes may be zeros that it can lack
      EXPECT_NE(complaint_about(directory, whole.substr(0, size)), "") << size;
  }
}

TEST(Laz, RandomDamageNeverDoesWorseThanAnError) {
  std::mt19937 random(test::seed());
  const TemporaryDirectory directory;
  int errors = 0;
  for (const int format : {3, 7}) {
    for (const bool variable : {false, true}) {
      LazContents laz = some_laz(format, 120, random);
      laz.variable = variable;
      const std::string whole = LazWriter(laz).bytes();
      for (int round = 0; round < 700; ++round) {
        std::string bytes = whole;
        for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips)
          bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
        errors += complaint_about(directory, bytes).empty() ? 0 : 1;
      }
    }
  }
  EXPECT_GT(errors, 300);
}

TEST(Laz, LyingNumbersAreNamed) {
  std::mt19937 random(7);
  const TemporaryDirectory directory;
  const std::string whole = LazWriter(some_laz(6, 120, random)).bytes();
  const std::uint64_t start = LasFile(directory.write("a.laz", whole)).header().point_offset;
  const std::size_t record = 375 + 54;
  const auto table = test::LittleEndian::get<std::uint64_t>(whole, start);
  const auto patched = [&](std::size_t offset, auto value) {
    std::string bytes = whole;
    test::LittleEndian::put(bytes, offset, value);
    return complaint_about(directory, bytes);
  };
  EXPECT_THAT(patched(start, std::uint64_t{1} << 60), HasSubstr("the chunk table is said to be at"));
  EXPECT_THAT(patched(start, std::uint64_t{0}), HasSubstr("the chunk table is said to be at 0"));
  EXPECT_THAT(patched(table, std::uint32_t{7}), HasSubstr("a chunk table of 3 chunks is damaged"));
  EXPECT_THAT(patched(table + 4, std::uint32_t{4'000'000'000}),
              HasSubstr("a chunk table of 4000000000 chunks is damaged"));
  EXPECT_THAT(patched(table + 4, std::uint32_t{2}), HasSubstr("promises 120 points, but the chunks hold 100"));
  EXPECT_THAT(patched(247, std::uint64_t{1} << 60), HasSubstr("promises 1152921504606846976 points, but"));
  EXPECT_THAT(patched(start + 8 + 30, std::uint32_t{9}), HasSubstr("a chunk of 9 points has 50 in the chunk table"));
  EXPECT_THAT(patched(start + 8 + 34, ~std::uint32_t{0}), HasSubstr("a chunk of 50 points ends early"));
  EXPECT_THAT(patched(record, std::uint16_t{1}), HasSubstr("compressed (LAZ) in a way, 1 by 0, that is not read"));
  EXPECT_THAT(patched(record + 12, std::uint32_t{0}), HasSubstr("chunks of no points"));
  EXPECT_THAT(patched(record + 32, std::uint16_t{99}), HasSubstr("a LASzip record of 40 bytes is damaged"));
  EXPECT_THAT(patched(record + 34, std::uint16_t{6}), HasSubstr("a part 6 of version 3"));
  EXPECT_THAT(patched(record + 36, std::uint16_t{31}), HasSubstr("does not fit points of format 6 and 30 bytes"));
  EXPECT_THAT(patched(record + 38, std::uint16_t{1}), HasSubstr("las2las -i in.laz -o out.las"));
}

// Real files -------------------------------------------------------------------------------------------------------

TEST(Laz, FilesOfSurveysReadAsTheirTwins) {
  const std::string lidar = std::string(ITIN_SOURCE_DIR) + "/tests/libitin/import/lidar/";
  for (const char* name : {"ahn3", "ign"})
    expect_alike(points_of(lidar + name + ".laz"), points_of(lidar + name + ".las"));
}

struct RealTwin {
  const char* compressed;
  const char* plain;
};
class RealLaz : public testing::TestWithParam<RealTwin> {};

TEST_P(RealLaz, ReadsAsItsTwin) {
  const std::string data = std::string(ITIN_DATA_DIR) + "/";
  const std::string compressed = data + GetParam().compressed, plain = data + GetParam().plain;
  for (const std::string& path : {compressed, plain})
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  expect_alike(points_of(compressed), points_of(plain));
}

INSTANTIATE_TEST_SUITE_P(
    , RealLaz,
    testing::Values(RealTwin{"ahn3-bgt-delft/ahn3/ahn3_cropped_2.laz", "derived-las/ahn3_cropped_2.las"},
                    RealTwin{"ign-lidarhd-0299-0300/pointcloud/test_semis_2023_0299_6802_LA93_IGN69.laz",
                             "derived-las/ign_0299_6802.las"},
                    RealTwin{"ign-lidarhd-0299-0300/pointcloud/test_semis_2023_0300_6802_LA93_IGN69.laz",
                             "derived-las/ign_0300_6802.las"},
                    RealTwin{"lidr-small/Topography.laz", "lidr-small/Topography.las"}),
    [](const auto& twin) {
      std::string name = std::filesystem::path(twin.param.plain).stem().string();
      return name;
    });

}  // namespace
}  // namespace itin
