#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/sites.hpp>

#include "import/points/delimited_text.hpp"
#include "support/seed.hpp"

namespace itin {

namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Sites : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "itin-sites-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    directory_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  SiteQuery file(const std::string& name, const std::string& contents) const {
    std::ofstream(directory_ / name) << contents;
    SiteQuery query;
    query.path = (directory_ / name).string();
    return query;
  }

  std::filesystem::path directory_;
  std::vector<std::string> warnings_;
};

std::vector<Site> sites_of(const SiteQuery& query, const std::string& to_crs) {
  std::vector<std::string> warnings;
  return read_sites(query, to_crs, warnings);
}

constexpr const char* kMasts =
    "name,x,y,mast_m\n"
    "Garth,310375,183525,12.5\n"
    "\"Machen, Mynydd\",322300,190000,30\n";

TEST_F(Sites, ComeFromCsvInTheFilesOrder) {
  SiteQuery query = file("masts.csv", kMasts);
  query.height_field = "mast_m";
  query.name_field = "name";
  const std::vector<Site> sites = sites_of(query, "EPSG:27700");
  ASSERT_EQ(sites.size(), 2u);
  EXPECT_EQ(sites[0].name, "Garth");
  EXPECT_EQ(sites[0].position, (Point2{310375, 183525}));
  EXPECT_EQ(sites[0].height, 12.5);
  EXPECT_EQ(sites[1].name, "Machen, Mynydd");
  EXPECT_EQ(sites[1].height, 30);
}

TEST_F(Sites, CarryFurtherNumbers) {
  SiteQuery query = file("masts.csv", "x,y,reach,from,note\n1,2,500,350.5,a\n3,4,,10,b\n");
  query.numbers = {{"reach"}, {"FROM"}, {"to", false}};
  const std::vector<Site> sites = sites_of(query, "");
  ASSERT_EQ(sites.size(), 2u);
  using Numbers = std::vector<std::optional<double>>;
  EXPECT_EQ(sites[0].numbers, (Numbers{500, 350.5, std::nullopt}));
  EXPECT_EQ(sites[1].numbers, (Numbers{std::nullopt, 10, std::nullopt}));
  query.numbers = {{"note"}};
  EXPECT_THAT([&] { sites_of(query, ""); },
              ThrowsMessage<FileError>(HasSubstr("feature 1: its field 'note' holds no number")));
  query.numbers = {{"to"}};
  EXPECT_THAT([&] { sites_of(query, ""); }, ThrowsMessage<FileError>(HasSubstr("no field 'to'")));
}

TEST_F(Sites, TakeDecimalCommasAndHaveNoHeightWhereTheFieldIsEmpty) {
  SiteQuery query = file("masts.csv", "x;y;mast;reach\n100,5;2;12,5;1,5\n3;4;;1.5\n5;6;7;\n");
  query.height_field = "mast";
  query.numbers = {{"reach"}};
  const std::vector<Site> sites = sites_of(query, "");
  ASSERT_EQ(sites.size(), 3u);
  EXPECT_EQ(sites[0].position, (Point2{100.5, 2}));
  EXPECT_EQ(sites[0].height, 12.5);
  EXPECT_EQ(sites[1].height, std::nullopt);
  EXPECT_EQ(sites[2].height, 7);
  using Numbers = std::vector<std::optional<double>>;
  EXPECT_EQ(sites[0].numbers, Numbers{1.5});
  EXPECT_EQ(sites[1].numbers, Numbers{1.5});
  EXPECT_EQ(sites[2].numbers, Numbers{std::nullopt});
}

TEST_F(Sites, InCsvHeadedLongitudeAndLatitudeAreGeographic) {
  for (const char* header : {"lon,lat", "Longitude,LATITUDE", "lng,lat", "long,lat"}) {
    const SiteQuery query = file("masts.csv", std::string(header) + "\n-3.2934,51.5437\n");
    const std::vector<Site> sites = sites_of(query, "EPSG:27700");
    ASSERT_EQ(sites.size(), 1u) << header;
    EXPECT_NEAR(sites[0].position.x, 310375, 200) << header;
    EXPECT_NEAR(sites[0].position.y, 183525, 200) << header;
  }
  // The CRS that the call names comes before that of a header.
  SiteQuery query = file("masts.csv", "lon,lat\n310375,183525\n");
  query.crs = "EPSG:27700";
  EXPECT_EQ(sites_of(query, "EPSG:27700").front().position, (Point2{310375, 183525}));
  EXPECT_THAT([&] { sites_of(file("m.csv", "lon,lat\n310375,183525\n"), "EPSG:27700"); },
              ThrowsMessage<FileError>(HasSubstr("cannot be transformed")));
}

TEST_F(Sites, TakeTheColumnsOfOnePair) {
  EXPECT_EQ(sites_of(file("a.csv", "lat,lon,easting,northing\n51,-3,7,8\n"), "EPSG:27700").front().position,
            (Point2{7, 8}));
  EXPECT_EQ(sites_of(file("b.csv", "lat,y,x\n51,8,7\n"), "EPSG:27700").front().position, (Point2{7, 8}));
  EXPECT_EQ(sites_of(file("c.csv", "\xEF\xBB\xBFx;y\r\n7;8\r\n"), "EPSG:27700").front().position, (Point2{7, 8}));
  EXPECT_THAT([&] { sites_of(file("d.csv", "x,lat\n7,8\n"), "EPSG:27700"); },
              ThrowsMessage<FileError>(HasSubstr("must name x and y, easting and northing, or lon and lat")));
}

TEST_F(Sites, AreReadFromCsvAsPointsToImportAre) {
  const std::vector<std::string> names{"x",        "y",       "lon",      "lat", "Longitude",
                                       "LATITUDE", "easting", "northing", "e",   "n"};
  std::mt19937 random(test::seed());
  for (int turn = 0; turn < 60; ++turn) {
    std::vector<std::string> columns = names;
    std::shuffle(columns.begin(), columns.end(), random);
    columns.resize(2 + random() % 5);
    columns.push_back("z");
    std::string header, row;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      header += (i == 0 ? "" : ",") + columns[i];
      row += fmt::format("{}{}", i == 0 ? "" : ",", 0.5 + static_cast<double>(i));
    }
    SCOPED_TRACE(header);
    const SiteQuery query = file("p.csv", header + "\n" + row + "\n");
    const DelimitedText points(query.path, "");
    std::vector<std::string> rejected;
    const std::vector<Site> sites = read_sites(query, "EPSG:32630", warnings_, rejected);
    // Without columns of a pair points have the first ones, with a warning.
    EXPECT_EQ(sites.empty(), !points.warnings().empty());
    if (sites.empty()) continue;
    const Point2 expected =
        points.crs().empty() ? points.centre() : CoordinateTransform(points.crs(), "EPSG:32630")(points.centre());
    EXPECT_EQ(sites[0].position, expected);
  }
}

TEST_F(Sites, RefuseHeightsBeyondAll) {
  SiteQuery query = file("masts.csv", "x,y,h\n1,2,3\n1,2,-2e6\n");
  query.height_field = "h";
  EXPECT_THAT([&] { sites_of(query, ""); },
              ThrowsMessage<InputError>(HasSubstr("feature 2: field 'h': a height of -2e+06 m is beyond 1000000 m")));
  std::vector<std::string> rejected;
  EXPECT_EQ(read_sites(query, "", warnings_, rejected).size(), 1u);
  EXPECT_EQ(rejected.size(), 1u);
}

TEST_F(Sites, HaveNoHeightUnlessAsked) {
  const std::vector<Site> sites = sites_of(file("masts.csv", kMasts), "EPSG:27700");
  ASSERT_EQ(sites.size(), 2u);
  EXPECT_EQ(sites[0].height, std::nullopt);
  EXPECT_EQ(sites[0].name, std::to_string(sites[0].feature));
}

TEST_F(Sites, TakePositionsAsPeopleWriteThem) {
  const auto expect_garth = [](const std::vector<Site>& sites) {
    ASSERT_EQ(sites.size(), 1U);
    EXPECT_NEAR(sites[0].position.x, 310375, 200);
    EXPECT_NEAR(sites[0].position.y, 183525, 200);
  };
  expect_garth(sites_of(file("a.csv", "lat,lon\n\"51\xC2\xB0 32,6' N\",\"3\xC2\xB0 17,6' W\"\n"), "EPSG:27700"));
  expect_garth(sites_of(file("b.csv", "lat;lon\n51,5437;-3,2934\n"), "EPSG:27700"));
  expect_garth(sites_of(file("c.csv", "lat,lon\n\"51,5437\",\"-3,2934\"\n"), "EPSG:27700"));
  expect_garth(sites_of(file("d.csv", "name,Grid reference\nGarth,ST 103 835\n"), "EPSG:27700"));
  expect_garth(sites_of(file("e.csv", "position\n\"51 32 37N, 3 17 36W\"\n"), "EPSG:27700"));
  expect_garth(sites_of(file("f.csv", "MGRS\n30U VC 79658 10346\n"), "EPSG:27700"));
  EXPECT_NEAR(sites_of(file("g.csv", "locator\nIO81im\n"), "EPSG:27700")[0].position.y, 183525, 5000);
  EXPECT_THAT([&] { sites_of(file("h.csv", "ngr\nsomewhere\n"), "EPSG:27700"); },
              ThrowsMessage<FileError>(HasSubstr("feature 1: its position 'somewhere' is no grid reference")));
}

TEST_F(Sites, ComeFromTablesOfExcel) {
  SiteQuery query =
      file("masts.csv", ";;;\n# masts\n\nName;x;y;Height (m)\nGarth;310375,5;183525;12,5\n;;;\nHut;1;2;\n");
  query.height_field = "height";
  query.name_field = "name";
  const std::vector<Site> sites = sites_of(query, "EPSG:27700");
  ASSERT_EQ(sites.size(), 2U);
  EXPECT_EQ(sites[0].position, (Point2{310375.5, 183525}));
  EXPECT_EQ(sites[0].height, 12.5);
  EXPECT_EQ(sites[0].place, "feature 1");
  EXPECT_EQ(sites[1].place, "feature 2, line 7");
  std::string utf16 = "\xFF\xFE";
  for (const char c : std::string("x\ty\r\n310375\t183525\r\n")) utf16 += {c, '\0'};
  EXPECT_EQ(sites_of(file("u.csv", utf16), "EPSG:27700")[0].position, (Point2{310375, 183525}));
}

TEST_F(Sites, KeepNamesAsTheyAreWritten) {
  SiteQuery query = file("masts.csv", "x,y,name\n1,2,007\n3,4,1.10\n5,6,Caf\xE9\n");
  query.name_field = "name";
  const std::vector<Site> sites = read_sites(query, "", warnings_);
  EXPECT_EQ(sites[0].name, "007");
  EXPECT_EQ(sites[1].name, "1.10");
  EXPECT_EQ(sites[2].name, "Caf\xC3\xA9");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_THAT(warnings_[0], HasSubstr("masts.csv: line 4: not written in UTF-8"));
}

TEST_F(Sites, AreAllPointsOfAMultipointWithAWordOfItsZ) {
  SiteQuery query =
      file("masts.geojson", R"({"type":"FeatureCollection",)"
                            R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::27700"}},)"
                            R"("features":[{"type":"Feature","properties":{"name":"Garth"},"geometry":)"
                            R"({"type":"MultiPoint","coordinates":[[1,2,30],[3,4,50]]}}]})");
  query.name_field = "name";
  const std::vector<Site> sites = read_sites(query, "EPSG:27700", warnings_);
  ASSERT_EQ(sites.size(), 2U);
  EXPECT_EQ(sites[0].name, "Garth (1)");
  EXPECT_EQ(sites[1].name, "Garth (2)");
  EXPECT_EQ(sites[1].position, (Point2{3, 4}));
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_THAT(warnings_[0], HasSubstr("the Z of its points is not used (feature 0: 30)"));
}

TEST_F(Sites, AreFilteredByAttributes) {
  SiteQuery query = file("masts.csv", kMasts);
  query.where = "mast_m > 20";
  const std::vector<Site> sites = sites_of(query, "EPSG:27700");
  ASSERT_EQ(sites.size(), 1u);
  EXPECT_EQ(sites[0].position, (Point2{322300, 190000}));
}

TEST_F(Sites, AreTransformedFromTheFilesOwnSystem) {
  const SiteQuery query =
      file("masts.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
                            R"("geometry":{"type":"Point","coordinates":[-3.2934,51.5437]}}]})");
  const std::vector<Site> sites = sites_of(query, "EPSG:27700");
  ASSERT_EQ(sites.size(), 1u);
  EXPECT_NEAR(sites[0].position.x, 310375, 200);
  EXPECT_NEAR(sites[0].position.y, 183525, 300);
}

TEST_F(Sites, OfAFileWithoutSystemAreInTheOneGiven) {
  SiteQuery query = file("masts.csv", "lon,lat\n-3.2934,51.5437\n");
  query.crs = "EPSG:4326";
  const std::vector<Site> sites = sites_of(query, "EPSG:27700");
  ASSERT_EQ(sites.size(), 1u);
  EXPECT_NEAR(sites[0].position.x, 310375, 200);
}

TEST_F(Sites, NameWhatIsWrong) {
  const auto message_of = [](const SiteQuery& query) { return [query] { sites_of(query, "EPSG:27700"); }; };
  const auto says = [](const char* text) { return ThrowsMessage<FileError>(HasSubstr(text)); };

  SiteQuery missing;
  missing.path = (directory_ / "none.gpkg").string();
  EXPECT_THAT(message_of(missing), says("none.gpkg"));

  SiteQuery masts = file("masts.csv", kMasts);
  SiteQuery query = masts;
  query.layer = "towers";
  EXPECT_THAT(message_of(query), says("no layer 'towers'"));
  query = masts;
  query.height_field = "tower_m";
  EXPECT_THAT(message_of(query), says("no field 'tower_m'"));
  query = masts;
  query.name_field = "label";
  EXPECT_THAT(message_of(query), says("no field 'label'"));
  query = masts;
  query.where = "tower_m > 2";
  EXPECT_THAT(message_of(query), says("`where` tower_m > 2"));
  query = masts;
  query.height_field = "name";
  EXPECT_THAT(message_of(query), says("feature 1: its height field 'name' holds no number"));

  EXPECT_THAT(message_of(file("places.csv", "name,where\nGarth,here\n")), says("has no point"));
  EXPECT_THAT(message_of(file("line.geojson", R"({"type":"Feature","properties":{},"geometry":)"
                                              R"({"type":"LineString","coordinates":[[0,51],[1,52]]}})")),
              says("is a LINESTRING, not a point"));
}

}  // namespace

}  // namespace itin
