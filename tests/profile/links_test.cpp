// Batches of links against one report each.
#include <algorithm>
#include <fstream>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/coordinates.hpp>
#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <profile/clearance_error.hpp>
#include <profile/link_courses.hpp>
#include <profile/links.hpp>

#include "lines/links/link_sharing.hpp"
#include "support/impatient.hpp"
#include "support/raster_file.hpp"
#include "support/same_bits.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin::profile {
namespace {

class Links : public testing::Test {
 protected:
  void SetUp() override {
    test::write_raster(directory_.file("t.tif"), {300000, 200000, 10, 60, 60, 27700},
                       [](int c, int r) { return 100 + 8 * std::sin(c * 0.3) + 6 * std::cos(r * 0.23); });
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    NoProgress progress;
    import_terrain(directory_.file("s.itin"), options, progress);
    std::vector<test::LineFeature> houses;
    for (int i = 0; i < 30; ++i) {
      const double x = in(300020, 300540), y = in(199440, 199940), u = x + in(6, 30), v = y + in(6, 30);
      houses.push_back(test::box(x, y, u, v, in(3, 15)));
    }
    test::write_lines(directory_.file("b.geojson"), houses, true);
    options.sources = {directory_.file("b.geojson")};
    options.kind = ThemeKind::Buildings;
    options.height_field = "h";
    import_lines(directory_.file("s.itin"), options, progress);
    store_.emplace(directory_.file("s.itin"));
  }

  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 100000) / 100000; }

  std::vector<Link> links(int count) {
    std::vector<Link> links;
    for (int i = 0; i < count; ++i) {
      const auto place = [&] { return Point2{in(300010, 300580), in(199420, 199990)}; };
      links.push_back({fmt::format("{}", i), place(), in(0, 20), place(), in(0, 20)});
    }
    links[0].to = links[0].from;
    links[1].to = {400000, 200000};  // leaves the data
    return links;
  }

  LosReport report(const Link& link, const LinkQuery& query) const {
    LosQuery of_one;
    of_one.earth = query.earth, of_one.radio = query.radio;
    of_one.from_height_m = link.from_height, of_one.to_height_m = link.to_height;
    of_one.from_on_surface = query.from_on_surface, of_one.to_on_surface = query.to_on_surface;
    of_one.object = query.object;
    of_one.clearance_error_m = clearance_error(*store_, query.detail, query.themes, link.from, link.to);
    const auto along = [&](const ThemeChoice& themes) {
      return from_section(cross_section(*store_, link.from, link.to, query.detail, themes));
    };
    return analyse(along(query.themes), of_one, along(ThemeChoice::none()));
  }

  static void expect_same(const LineFindings& found, const LineFindings& expected) {
    EXPECT_EQ(found.verdict, expected.verdict);
    EXPECT_TRUE(test::same_bits(*found.clearance_m, *expected.clearance_m));
    EXPECT_EQ(found.critical->distance_m, expected.critical->distance_m);
    EXPECT_EQ(found.fresnel ? std::optional(found.fresnel->fraction) : std::nullopt,
              expected.fresnel ? std::optional(expected.fresnel->fraction) : std::nullopt);
    for (std::size_t i = 0; i < found.required.size(); ++i)
      EXPECT_EQ(found.required[i].heights.both_equal_m, expected.required[i].heights.both_equal_m);
  }

  void expect_reports(const std::vector<Link>& links, const LinkQuery& query) {
    NoProgress progress;
    const std::vector<LinkResult> results = survey_links(*store_, links, query, progress);
    ASSERT_EQ(results.size(), links.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(links.size(), 100); ++i) {
      SCOPED_TRACE(i);
      if (i == 1) {
        EXPECT_FALSE(results[i].found);
        EXPECT_FALSE(results[i].message.empty());
        continue;
      }
      const LosReport expected = report(links[i], query);
      expect_same(*results[i].found, expected);
      EXPECT_EQ(results[i].losses ? std::optional(results[i].losses->ld_db) : std::nullopt,
                expected.losses ? std::optional(expected.losses->ld_db) : std::nullopt);
      EXPECT_EQ(results[i].stands_on.to_m, expected.stands_on.to_m);
      ASSERT_EQ(results[i].reflection.has_value(), expected.reflection.has_value());
      if (expected.reflection) {
        EXPECT_EQ(results[i].reflection->distance_m, expected.reflection->distance_m);
        EXPECT_EQ(results[i].reflection->screen_depth_m, expected.reflection->screen_depth_m);
      }
      if (i < 10) expect_same(*survey_link(*store_, links[i], query).found, expected);
      ASSERT_EQ(results[i].visible.has_value(), expected.visible.has_value());
      if (expected.visible) {
        EXPECT_EQ(results[i].visible->tip.visible_m, expected.visible->tip.visible_m);
      }
    }
    undecided_ = std::count_if(results.begin(), results.end(), [](const LinkResult& r) {
      return r.found && r.found->verdict == SightVerdict::kUndecided;
    });
  }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  std::mt19937 random_{5};
  std::ptrdiff_t undecided_ = 0;  ///< how many of the links computed last are undecided
};

TEST_F(Links, HaveTheAnswersOfTheirReports) {
  const std::vector<Link> few = links(5), many = links(3000);
  const Detail detail = Detail::tolerance(0);
  const SectionSurface surface(*store_, detail);
  EXPECT_TRUE(surface.is_lattice_at({300300, 199700}));
  EXPECT_FALSE(surface.is_lattice_at({1e300, 199700}));
  EXPECT_FALSE(sharing_pays(*store_, detail, few, surface));
  EXPECT_TRUE(sharing_pays(*store_, detail, many, surface));
  LinkQuery query;
  expect_reports(few, query);
  expect_reports(many, query);
  query.themes = ThemeChoice::all();
  query.radio = RadioPath{.frequency_ghz = 6, .effective_earth_km = 8500};
  for (const bool from : {false, true}) {
    query.from_on_surface = from, query.to_on_surface = !from;
    query.object = TallObject{60, 100};
    expect_reports(many, query);
    EXPECT_EQ(undecided_, 0);
  }
  query.detail = Detail::tolerance(4);
  expect_reports(many, query);
  EXPECT_GT(undecided_, 0);
}

TEST_F(Links, AtAHeightBelowTheGroundAreErrors) {
  NoProgress progress;
  const std::vector<Link> one = {{"low", {300100, 199700}, -1, {300200, 199700}, 2}};
  const std::vector<LinkResult> results = survey_links(*store_, one, {}, progress);
  EXPECT_FALSE(results[0].found);
  EXPECT_NE(results[0].message, "");
}

TEST(LinkCourses, AreGeodesicsBetweenPlacesOnTheEarth) {
  const Point2 eryri{261000, 354000}, bannau{301200, 221500};
  const std::vector<Link> links = {
      {"a", eryri, 2, bannau, 2}, {"b", eryri, 2, {1e9, 1e9}, 2}, {"c", bannau, 2, eryri, 2}};
  const LinkCourses courses = link_courses(links, "EPSG:27700", NoProgress());
  ASSERT_EQ(courses.size(), links.size());
  const CoordinateTransform to_geographic("EPSG:27700", "EPSG:4326");
  const Geodesic expected = geodesic(to_geographic(eryri), to_geographic(bannau));
  EXPECT_EQ(courses[0]->distance_m, expected.distance_m);
  EXPECT_EQ(courses[0]->azimuth_deg, expected.azimuth_deg);
  EXPECT_FALSE(courses[1]);
  EXPECT_EQ(courses[2]->from, courses[0]->to);
  EXPECT_NEAR(courses[2]->azimuth_deg, expected.back_azimuth_deg, 1e-6);
  EXPECT_THROW(link_courses(links, "EPSG:27700", test::Impatient(0)), Cancelled);
}

LinkTable table_of(const std::string& text) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory.file("l.csv")) << text;
  return read_link_table(directory.file("l.csv"), "EPSG:27700", {});
}

TEST(LinkTable, TakesItsColumnsByNameWhereItHasThemAll) {
  for (const char* text : {"id,x1,y1,h1,x2,y2,h2\n\"a, \"\"b\"\"\",1,2,3,4,5,6\n", "\"a, \"\"b\"\"\",1,2,3,4,5,6",
                           "\n \nid,x1,y1,h1,x2,y2,h2\n\"a, \"\"b\"\"\",1,2,3,4,5,6\n",
                           "link,x1,y1,h1,x2,y2,h2\n\"a, \"\"b\"\"\",1,2,3,4,5,6\n",
                           "name,e,n,h,e,n,h\r\n\"a, \"\"b\"\"\", 1,2 ,3,4,5,6\r\n\r\n",
                           "\xEF\xBB\xBFH2,y2,X2,note,h1,y1,x1,id\n6,5,4,\"x,y\",3,2,1,\"a, \"\"b\"\"\"\n"}) {
    const LinkTable table = table_of(text);
    ASSERT_EQ(table.links.size(), 1U) << text;
    EXPECT_TRUE(table.bad.empty());
    const Link& link = table.links[0];
    EXPECT_EQ(link.id, "a, \"b\"");
    EXPECT_EQ(link.from, (Point2{1, 2}));
    EXPECT_EQ(link.to, (Point2{4, 5}));
    EXPECT_EQ(link.from_height, 3);
    EXPECT_EQ(link.to_height, 6);
  }
}

std::string refusal_of(const std::string& text) {
  try {
    table_of(text);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find(':') + 2);
  }
  return "";
}

TEST(LinkTable, TakesForAnIdOnlyWhatIsCalledSo) {
  for (const char* text : {"frequency,x1,y1,h1,x2,y2,h2\n7.5,1,2,3,4,5,6\n7.5,1,2,3,4,low,6\n7.5,1,2,3,4,5,6\n",
                           "x1,y1,h1,x2,y2,h2,frequency\n1,2,3,4,5,6,7.5\n1,2,3,4,low,6,7.5\n1,2,3,4,5,6,7.5\n"}) {
    const LinkTable table = table_of(text);
    ASSERT_EQ(table.links.size(), 2U) << text;
    ASSERT_EQ(table.bad.size(), 1U);
    EXPECT_EQ(table.links[0].id, "1");
    EXPECT_EQ(table.bad[0].id, "2");
    EXPECT_EQ(table.links[1].id, "3");
    EXPECT_EQ(table.links[1].frequency_ghz, 7.5);
    EXPECT_TRUE(table.other_columns.empty());
  }
  const LinkTable noted = table_of("path,x1,y1,h1,x2,y2,h2\na,1,2,3,4,5,6\n");
  EXPECT_EQ(noted.links.at(0).id, "1");
  EXPECT_EQ(noted.other_columns, (std::vector<std::string>{"path"}));
  EXPECT_EQ(noted.links.at(0).others, (std::vector<std::string>{"a"}));
  EXPECT_EQ(table_of("x1,y1,h1,x2,y2,h2,name\n1,2,3,4,5,6,a\n").links.at(0).id, "a");
  EXPECT_EQ(table_of("x1,y1,h1,x2,y2,h2,name,id\n1,2,3,4,5,6,a,b\n").links.at(0).id, "b");
  EXPECT_EQ(table_of("x1,y1,h1,x2,y2,h2\n1,2,3,4,5,6\n").links.at(0).to, (Point2{4, 5}));
}

TEST(LinkTable, NamesTheColumnsThatItsHeaderLacks) {
  EXPECT_EQ(refusal_of("x1,y1,h1,x2,y2,note\n1,2,3,4,5,7\n"),
            "its header has no column h2; name the columns id,x1,y1,h1,x2,y2,h2, in any order");
  EXPECT_EQ(refusal_of("id,x1,y1,x2,y2,power,note\na,1,2,3,4,5,6\n").substr(0, 31), "its header has no column h1, h2");
  EXPECT_EQ(refusal_of("id,e1,n1,h1,e3,n3,h2\na,1,2,3,4,5,6\n").substr(0, 31), "its header has no column x2, y2");
}

TEST(LinkTable, TellsWhatItTakesByPlace) {
  const LinkTable table = table_of("Site;Lat;Lon;Antenna Height;A;B;C\na;1;2;3,5;4;5;6\n");
  ASSERT_EQ(table.links.size(), 1U);
  EXPECT_EQ(table.links[0].from_height, 3.5);
  ASSERT_EQ(table.warnings.size(), 1U);
  EXPECT_NE(
      table.warnings[0].find("its header is not understood; columns are taken by their order: 'Site' as id, 'Lat' "
                             "as x1, 'Lon' as y1, 'Antenna Height' as h1"),
      std::string::npos);
  EXPECT_TRUE(table_of("name,e,n,h,e,n,h\na,1,2,3,4,5,6\n").warnings.empty());
  EXPECT_TRUE(table_of("a,1,2,3,4,5,6\n").warnings.empty());
}

TEST(LinkTable, TakesHeightsAndFrequenciesInOtherWords) {
  const LinkTable table = table_of(
      "id,x1,y1,Antenna height 1 (m),x2,y2,height_2,Freq (MHz)\na,1,2,3,4,5,6,\"7,500\"\nb,1,2,3,4,5,6,7500.5\n");
  ASSERT_EQ(table.links.size(), 1U);
  EXPECT_EQ(table.links[0].to_height, 6);
  EXPECT_EQ(table.links[0].frequency_ghz, 7.5005);
  ASSERT_EQ(table.bad.size(), 1U);
  EXPECT_EQ(table_of("id,x1,y1,h1,x2,y2,h2,freq\na,1,2,3,4,5,6,\"7,125\"\n").links.at(0).frequency_ghz, 7.125);
  EXPECT_EQ(
      refusal_of("id,x1,y1,observ_hgt,x2,y2,h2\na,1,2,3,4,5,6\n"),
      "its header has no column h1; name the columns id,x1,y1,h1,x2,y2,h2, in any order; 'observ_hgt' may be meant "
      "by h1 or h2");
}

TEST(LinkTable, ReadsDecimalCommasOfDegrees) {
  for (const char* text :
       {"id;lat1;lon1;h1;lat2;lon2;h2\na;51,543;-3,293;3;51,6;-3,1;6\n",
        "id,lat1,lon1,h1,lat2,lon2,h2\na,\"51\xC2\xB0 32,58' N\",\"3\xC2\xB0 17,58' W\",3,51.6,-3.1,6\n",
        "id,position1,h1,position2,h2\na,\"51,543N 3,293W\",3,\"51,6N 3,1W\",6\n"}) {
    const LinkTable table = table_of(text);
    ASSERT_EQ(table.links.size(), 1U) << text;
    EXPECT_NEAR(table.links[0].from.x, 310400, 100) << text;
    EXPECT_NEAR(table.links[0].from.y, 183450, 100) << text;
  }
  EXPECT_EQ(table_of("id;x1;y1;h1;x2;y2;h2\na;310,375;2;3;4;5;6\n").bad.at(0).message,
            "x1 '310,375' has a comma that may part thousands; write numbers with a decimal point");
}

TEST(LinkTable, InLongitudeAndLatitudeIsGeographic) {
  const LinkTable table = table_of("id,lon1,lat1,h1,lon2,lat2,h2\na,-3.2934,51.5437,3,-3.1,51.6,6\n");
  ASSERT_EQ(table.links.size(), 1U);
  EXPECT_NEAR(table.links[0].from.x, 310375, 200);
  EXPECT_NEAR(table.links[0].from.y, 183525, 200);
  EXPECT_EQ(table.links[0].to_height, 6);
  EXPECT_THROW(table_of("id,lon1,lat1,h1,x2,y2,h2\na,-3,51,3,4,5,6\n"), InputError);
}

TEST(LinkTable, NamesRowsOfHeightsBeyondAll) {
  const LinkTable table = table_of("id,x1,y1,h1,x2,y2,h2\na,1,2,3,4,5,2e6\n");
  ASSERT_EQ(table.bad.size(), 1U);
  EXPECT_EQ(table.bad[0].message.substr(0, 19), "h2: a height of 2e+");
}

TEST(LinkTable, NamesTheRowsThatItDoesNotUnderstand) {
  const LinkTable table = table_of("id,x1,y1,h1,x2,y2,h2\na,1,2,3,4,5,6\n\nb,1,2,3\nc,1,2,3,nan,5,6\nd,1,2,3,4,5,6\n");
  ASSERT_EQ(table.links.size(), 2U);
  ASSERT_EQ(table.bad.size(), 2U);
  EXPECT_EQ(table.bad[0].row, 2U);
  EXPECT_EQ(table.bad[0].place, "line 4");
  EXPECT_EQ(table.bad[0].id, "b");
  EXPECT_EQ(table.bad[1].row, 3U);
  EXPECT_EQ(table.bad[1].message, "x2 'nan' is no number");
}

}  // namespace
}  // namespace itin::profile
