// What the program writes, a few calls of the libraries write as well, to the last byte.
#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>
#include <profile/links.hpp>
#include <profile/path_profiles.hpp>

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
  profile::write_link_table(survey, {path("mine.csv"), path("mine.kml"), path("mine.pdf")});

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

}  // namespace
}  // namespace itin::test
