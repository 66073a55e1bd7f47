// What the program writes, a few calls of the libraries write as well, to the last byte.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>
#include <profile/links.hpp>
#include <profile/path_profiles.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/zone_study.hpp>

#include "cli/shell.hpp"

namespace itin::test {
namespace {

class LibraryCalls : public testing::Test {
 protected:
  void run(const std::string& command) const {
    const Outcome outcome = shell_.run(command);
    ASSERT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
  }
  void import_hills() const {
    run("gdal_translate -q -srcwin 160 320 200 200 \"$DEMO/cardiff.tif\" garth.tif && "
        "itin import store.itin garth.tif && itin import store.itin \"$DEMO/lanes.geojson\" --kind roads --theme "
        "lanes");
  }
  std::string path(const std::string& file) const { return (shell_.directory() / file).string(); }

  const Shell shell_;
  NoProgress progress_;
};

TEST_F(LibraryCalls, WriteTheLinksOfTheProgram) {
  import_hills();
  // The last link ends off the data.
  run("awk 'BEGIN { print \"id,x1,y1,h1,x2,y2,h2,note\"; for (i = 0; i < 60; ++i) print i \",\" 310000 + i * 37 % 4000 "
      "\",\" 188000 + i * 53 % 3000 \",5,\" 310000 + i * 71 % 4000 \",\" 188000 + i * 29 % 3000 \",20,\" i % 7; "
      "print \"off,310000,188000,5,0,0,20,\" }' >links.csv");
  const Outcome program = shell_.run(
      "itin los store.itin --links links.csv --frequency 6 --effective-earth 4/3 -o seen.csv -o seen.kml -o seen.pdf");
  EXPECT_EQ(program.status, 1);

  const Store store(path("store.itin"));
  profile::LinkTable table = profile::read_link_table(path("links.csv"), store.metadata().crs_wkt, {2, 2});
  profile::LinkQuery query;
  query.earth = Earth::effective_earth(4.0 / 3);
  query.radio = RadioPath{.frequency_ghz = 6, .effective_earth_km = effective_earth_km(query.earth)};
  const profile::LinkSurvey survey = profile::survey_link_table(store, std::move(table), query, progress_);
  profile::LinkFileOptions options;
  options.map = viewshed::links_map(store, survey, options.title, progress_);
  profile::write_link_table(survey, {path("mine.csv"), path("mine.kml"), path("mine.pdf")}, options);

  EXPECT_EQ(profile::counts_of(survey).error, 1U);
  ASSERT_EQ(survey.warnings.size(), 1U);
  EXPECT_NE(survey.warnings.front().find("the column 'note' is not understood"), std::string::npos);
  for (const std::string ending : {".csv", ".kml", ".pdf"})
    EXPECT_EQ(shell_.read("mine" + ending), shell_.read("seen" + ending)) << ending;
  EXPECT_FALSE(shell_.read("mine.csv").empty());
}

TEST_F(LibraryCalls, WriteTheProfilesOfTheProgram) {
  import_hills();
  run("itin profile store.itin --from 310000,184000 --via 311000,186000 --to 313500,188500 --tolerance 0,4 -o seen.csv "
      "-o seen.geojson -o seen.svg");
  const Store store(path("store.itin"));
  const profile::PathProfiles along =
      profile::profiles_along(store,
                              {.corners = {{310000, 184000}, {311000, 186000}, {313500, 188500}},
                               .details = {Detail::tolerance(0), Detail::tolerance(4)}},
                              progress_);
  for (const std::string ending : {".csv", ".geojson", ".svg"}) {
    profile::write_profiles(along, path("mine" + ending));
    EXPECT_EQ(shell_.read("mine" + ending), shell_.read("seen" + ending)) << ending;
  }
  EXPECT_FALSE(shell_.read("mine.csv").empty());
  EXPECT_THROW(profile::write_profiles(along, path("mine.txt")), InputError);
  EXPECT_THROW(profile::write_profiles(along, path("mine.csv")), FileError);
  EXPECT_THROW(profile::profiles_along(store, {.corners = {{310000, 184000}}}, progress_), InputError);
}

TEST_F(LibraryCalls, WriteTheZoneStudyOfTheProgram) {
  import_hills();
  std::ofstream(path("t.csv")) << "x,y,hub_height,rotor_diameter,farm\n310600,185000,80,90,A\n313500,187000,60,60,B\n"
                                  "0,0,60,60,B\n313500,187000,,,B\n";
  std::ofstream(path("v.csv")) << "x,y,name,height\n310900,185500,Garth,3\n0,0,off,\n";
  std::ofstream(path("r.csv")) << "name,WKT\nHigh Road,\"LINESTRING (310100 184000, 313400 188400)\"\n";
  std::ofstream(path("l.csv")) << "id,x1,y1,h1,x2,y2,h2\na,310000,184000,5,313500,188000,20\n";
  run("itin ztv store.itin --turbines t.csv --viewpoints v.csv --route r.csv --every 400 --links l.csv --frequency 7.5 "
      "--radar 310900,185500,20 --radius 3000 --cell 100 --wireline-hidden --sheets A3 --date today -o program");

  const Store store(path("store.itin"));
  const std::string& crs = store.metadata().crs_wkt;
  viewshed::ZoneStudyRequest request;
  request.turbines = viewshed::read_turbines(
      {.path = path("t.csv"), .radius = {.source = "--radius", .steps = {}, .fixed = 3000}}, crs);
  request.zone.cell_size = 100;
  request.zone.radar = viewshed::Observer{"radar", {310900, 185500}, 20};
  request.viewpoints = viewshed::read_viewpoints({.path = path("v.csv")}, crs);
  request.routes = viewshed::read_routes(path("r.csv"), crs);
  request.route_step = 400;
  request.links = profile::read_link_table(path("l.csv"), crs, {});
  request.frequency_ghz = 7.5;
  const viewshed::ZoneStudy study = viewshed::study_zone(store, request, progress_);
  viewshed::ZoneStudyFileOptions options;
  options.wirelines.hidden_dashed = true;
  options.sheets = {.papers = {profile::PaperSize::kA3}, .date = "today"};
  options.decides_missing_ground = "--nodata block or clear";
  const std::vector<viewshed::ZoneFile> files =
      viewshed::write_zone_study(path("mine"), store, study, options, progress_);

  EXPECT_EQ(study.viewpoints.size(), 1U);
  EXPECT_EQ(study.request.viewpoints.bad.size(), 1U);
  EXPECT_EQ(study.request.turbines.bad.size(), 2U);
  EXPECT_EQ(study.routes.front().title(), "High Road");
  EXPECT_EQ(study.link_clearances.size(), 2U);
  EXPECT_GT(files.size(), 40U);
  for (const viewshed::ZoneFile& file : files) {
    // GeoPackages have the time in them, and the text on methods has the path of the turbines' file.
    if (file.name.ends_with(".gpkg") || file.name == "methods.md") continue;
    EXPECT_EQ(shell_.read("mine/" + file.name), shell_.read("program/" + file.name)) << file.name;
  }
  EXPECT_FALSE(shell_.read("mine/methods.md").empty());
  EXPECT_NE(shell_.read("mine/ztv.json").find("\"outputs\""), std::string::npos);
  EXPECT_THROW(viewshed::write_zone_study(path("mine"), store, study, options, progress_), FileError);
  options.overwrite = true, options.wirelines.viewpoints = {"nobody"};
  EXPECT_THROW(viewshed::write_zone_study(path("mine"), store, study, options, progress_), InputError);
}

/// Turbines and viewpoints that are in no file.
TEST_F(LibraryCalls, StudyTurbinesThatAreInNoFile) {
  import_hills();
  const Store store(path("store.itin"));
  viewshed::ZoneStudyRequest request;
  request.turbines.turbines = {{.number = 2, .position = {310600, 185000}, .tip_height = 120, .radius = 2000}};
  request.zone.cell_size = 100;
  request.zone.themes = ThemeChoice::none();
  request.viewpoints.viewpoints = {{1, "here", {310900, 185500}, 2, 0}, {2, "nowhere", {0, 0}, 2, 0}};
  const viewshed::ZoneStudy study = viewshed::study_zone(store, request, progress_);
  EXPECT_FALSE(study.zone.screened);
  ASSERT_EQ(study.viewpoints.size(), 1U);
  EXPECT_GT(study.viewpoints.front().viewpoint.ground, 0);
  ASSERT_EQ(study.request.viewpoints.bad.size(), 1U);
  EXPECT_EQ(study.request.viewpoints.bad.front().number, 2U);
  viewshed::ZoneStudyFileOptions options;
  options.wirelines.none = true;
  viewshed::write_zone_study(path("out"), store, study, options, progress_);
  EXPECT_NE(shell_.read("out/turbines.csv").find("\n2,,"), std::string::npos);
  EXPECT_NE(shell_.read("out/methods.md").find("extends to 2 km from every turbine"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("out/radius-preset.json")));
  request.zone.cell_size.reset();
  request.zone.grid = RasterGrid({312500, 184000}, 100, 100, 5, 5);
  EXPECT_THROW(viewshed::study_zone(store, request, progress_), InputError);
}

}  // namespace
}  // namespace itin::test
