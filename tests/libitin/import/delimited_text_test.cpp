#include "import/points/delimited_text.hpp"

#include <charconv>
#include <clocale>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <itin/error.hpp>

#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::TemporaryDirectory;
using ::testing::HasSubstr;

std::vector<Point3> read_file(const std::string& path, const std::string& z_field = "") {
  std::vector<Point3> points;
  DelimitedText text(path, z_field);
  text.read([&](PointBatch& batch, double) {
    for (std::size_t i = 0; i < batch.size(); ++i) points.push_back({batch.x[i], batch.y[i], batch.z[i]});
  });
  return points;
}

std::vector<Point3> read_text(std::string_view content, const std::string& z_field = "") {
  const TemporaryDirectory directory;
  return read_file(directory.write("p.csv", content), z_field);
}

template <class E>
std::string refusal(std::string_view content, const std::string& z_field = "") {
  const TemporaryDirectory directory;
  const std::string path = directory.write("p.csv", content);
  try {
    read_file(path, z_field);
  } catch (const E& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(path + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message.substr(path.size() + 2);
  }
  ADD_FAILURE() << "accepted: " << content;
  return {};
}

const std::vector<Point3> kTwo{{1.5, 2, -3}, {4, 5e2, 6.25}};

TEST(DelimitedText, EverySeparatorWithAndWithoutHeader) {
  EXPECT_EQ(read_text("1.5,2,-3\n4,5e2,6.25\n"), kTwo);
  EXPECT_EQ(read_text("1.5 ; 2;-3\r\n 4;5e2;+6.25"), kTwo);
  EXPECT_EQ(read_text("1.5\t2\t-3\n4\t5e2\t6.25\n"), kTwo);
  EXPECT_EQ(read_text("1,5;2;-3,0\n4;5e2;6,25\n"), kTwo);
  EXPECT_EQ(read_text("x\ty\tz\n1,5\t2\t-3\n4\t5e2\t6,25\n"), kTwo);
  EXPECT_EQ(read_text("  1.5  2 -3\n4 5e2 \t6.25  \n"), kTwo);
  EXPECT_EQ(read_text("x,y,z\n1.5,2,-3\n4,5e2,6.25\n"), kTwo);
  EXPECT_EQ(read_text("X Y Z\n1.5 2 -3\n4 5e2 6.25\n"), kTwo);
  EXPECT_EQ(read_text("\xef\xbb\xbf# a remark\n\n\"X\", \"Y\", \"Z\"\n \"1.5\" ,2,-3,more\n# one more\n4,5e2,6.25\n"),
            kTwo);
}

TEST(DelimitedText, ColumnsByName) {
  EXPECT_EQ(read_text("Height,name,Northing,EASTING\n-3,a,2,1.5\n6.25,\"b, c\",5e2,4\n"), kTwo);
  EXPECT_EQ(read_text("lat,long,id,elev\n2,1.5,7,-3\n5e2,4,8,6.25\n"), kTwo);
  EXPECT_EQ(read_text("x,y,z,od\n1.5,2,0,-3\n4,5e2,0,6.25\n", "OD"), kTwo);
  EXPECT_EQ(read_text("x,y,depth_m\n1.5,2,-3\n4,5e2,6.25\n"), kTwo);
  EXPECT_EQ(read_text("a,b,c\n1.5,2,-3\n4,5e2,6.25\n"), kTwo);
}

TEST(DelimitedText, SaysWhatItAssumes) {
  const TemporaryDirectory directory;
  const DelimitedText degrees(directory.write("a.csv", "longitude,latitude,h\n-3.1,51.4,5\n"), "");
  EXPECT_EQ(degrees.crs(), "EPSG:4326");
  EXPECT_EQ(degrees.centre(), (Point2{-3.1, 51.4}));
  EXPECT_TRUE(degrees.warnings().empty());
  const DelimitedText unnamed(directory.write("b.csv", "id,where,what\n1,2,3\n"), "");
  EXPECT_EQ(unnamed.crs(), "");
  ASSERT_EQ(unnamed.warnings().size(), 1u);
  EXPECT_THAT(unnamed.warnings()[0], HasSubstr("'id', 'where' and 'what'"));
}

TEST(DelimitedText, EmptyHeightIsAVoid) {
  const auto points = read_text("x,y,z\n1,2,\n3,4,5\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_TRUE(std::isnan(points[0].z));
  EXPECT_EQ(points[1], (Point3{3, 4, 5}));
}

TEST(DelimitedText, BadRowsAreNamed) {
  EXPECT_THAT(refusal<InputError>("x,y,z\n1,2,3\n4,five,6\n"),
              HasSubstr("line 3: 'five' is not a number in '4,five,6'"));
  EXPECT_THAT(refusal<InputError>("1,2,3\n\n# no\n4,5\n"), HasSubstr("line 4: 2 columns, but 3 are needed in '4,5'"));
  EXPECT_THAT(refusal<InputError>("P1,2,3\n"), HasSubstr("line 1: 'P1' is not a number"));
  // It may be one thousand or one.
  EXPECT_THAT(refusal<InputError>("1,000;2,5;3,5\n"), HasSubstr("'1,000' is not a number"));
  for (const std::string bad :
       {"nan", "inf", "-inf", "1e999", "0x10", "1.2.3", "12abc", "--1", "+-1", "1 2", "1_0", "\x01"})
    EXPECT_THAT(refusal<InputError>("1,2,3\n1,2," + bad + "\n"), HasSubstr("line 2: ")) << bad;
  EXPECT_THAT(refusal<InputError>("1,2,3\n,2,3\n"), HasSubstr("line 2: '' is not a number"));
  EXPECT_THAT(refusal<InputError>("1,2,3\n1,2,\x1b[31m\n"), HasSubstr("'?[31m'"));
  EXPECT_THAT(refusal<InputError>("1,2,3\n" + std::string(100'000, '7') + "\n"), HasSubstr("line 2: longer than"));
}

TEST(DelimitedText, BadColumnsAreNamed) {
  EXPECT_THAT(refusal<FileError>("x,y,z\n1,2,3\n", "height"),
              HasSubstr(R"(no column 'height'; it has ["x", "y", "z"])"));
  EXPECT_THAT(refusal<FileError>("1,2,3\n", "z"), HasSubstr("no header line"));
  EXPECT_THAT(refusal<FileError>("x,y\n1,2\n"), HasSubstr("`z_field`"));
  EXPECT_THAT(refusal<FileError>("name,x,y\na,2,3\n"), HasSubstr("`z_field`"));
  EXPECT_THAT(refusal<FileError>("what\n1\n"), HasSubstr("three columns"));
  EXPECT_THAT(refusal<FileError>(""), HasSubstr("holds no points"));
  EXPECT_THAT(refusal<FileError>("x,y,z\n# nothing\n"), HasSubstr("holds no points"));
  EXPECT_THROW(DelimitedText("/nowhere/p.csv", ""), FileError);
  EXPECT_THROW(DelimitedText("/tmp", ""), FileError);
}

TEST(DelimitedText, LongFilesCrossBufferEdges) {
  std::mt19937 random(test::seed());
  std::string content = "x y z\n";
  std::vector<Point3> written;
  while (content.size() < 3'500'000) {
    written.push_back({random() / 1000.0, random() / 7.0, random() / 1e6});
    content += fmt::format("{} {}{}{}\n", written.back().x, written.back().y, std::string(1 + random() % 9, ' '),
                           written.back().z);
  }
  EXPECT_EQ(read_text(content), written);
}

TEST(DelimitedText, LocaleDoesNotMatter) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8")) GTEST_SKIP() << "the locale de_DE.UTF-8 is not installed";
  EXPECT_EQ(read_text("1.5,2,-3\n4,5e2,6.25\n"), kTwo);
  std::setlocale(LC_NUMERIC, before.c_str());
}

double any_finite(std::mt19937_64& random) {
  for (;;)
    if (const double value = std::bit_cast<double>(random()); std::isfinite(value)) return value;
}

RC_GTEST_PROP(DelimitedText, AnyDoubleComesBackBitForBit, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  constexpr std::string_view kSeparators[] = {",", ";", "\t", " "};
  const std::string_view separator = kSeparators[random() % 4];
  std::vector<Point3> written;
  std::string content;
  for (int i = 0; i < 50; ++i) {
    written.push_back({any_finite(random), any_finite(random), any_finite(random)});
    content += fmt::format("{0}{3}{1}{3}{2}\n", written.back().x, written.back().y, written.back().z, separator);
  }
  RC_ASSERT(read_text(content) == written);
}

RC_GTEST_PROP(DelimitedText, RandomTextIsReadOrRefused, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  constexpr std::string_view kAlphabet = "0123456789.,;-+eE \t\r\n\"#xyz\0\xff";
  std::string content = random() % 2 ? "x,y,z\n1,2,3\n" : "1 2 3\n";
  for (auto left = random() % 60; left > 0; --left) content += kAlphabet[random() % kAlphabet.size()];
  try {
    for (const Point3& p : read_text(content)) RC_ASSERT(std::isfinite(p.x) && std::isfinite(p.y));
  } catch (const Error& error) {
    RC_ASSERT(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
}

}  // namespace
}  // namespace itin
