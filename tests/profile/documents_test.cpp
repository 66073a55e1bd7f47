// The text of a result is the document that the program prints.
#include <sstream>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/import.hpp>
#include <profile/documents.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin::profile {
namespace {

/// The text's document, which begins with the version.
Document found_in(const std::string& text) {
  Document document = Document::parse(text);
  EXPECT_EQ(document.begin().key(), "itin");
  EXPECT_EQ(text.back(), '\n');
  document.erase("itin");
  return document;
}

class Documents : public testing::Test {
 protected:
  Documents() {
    const std::vector<double> z = test::fractal_heights(65, 60, 0.55, 5);
    ImportOptions options;
    options.sources = {directory_.file("hills.tif")};
    test::write_raster(options.sources.front(), {300000, 210000, 20, 60, 60, 27700},
                       [&](int c, int r) { return z[static_cast<std::size_t>(r) * 65 + static_cast<std::size_t>(c)]; });
    NoProgress progress;
    import_terrain(directory_.file("hills.itin"), options, progress);
    store_.emplace(directory_.file("hills.itin"));
  }

  const StoreMetadata& metadata() const { return store_->metadata(); }

  const test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  const Point2 from_{300100, 209900}, to_{301100, 209000};
};

TEST_F(Documents, OfALineOverAStore) {
  LosQuery query;
  query.from_height_m = 10, query.to_height_m = 5;
  query.radio = RadioPath{.frequency_ghz = 7.5};
  const StoreLine line{.from = from_, .to = to_};
  const LosReport report = analyse(*store_, line, query);
  const Document found = found_in(json_of(*store_, line, report));
  EXPECT_EQ(found, los_document(metadata(), line, report));
  EXPECT_EQ(found["verdict"], name_of(report.verdict));
  EXPECT_EQ(found["from"]["x"], from_.x);
  EXPECT_EQ(found["surface"]["tolerance_m"], 0);
  EXPECT_EQ(found["statistics"]["points_read"], report.statistics.points_read);
  EXPECT_EQ(found["radio"]["frequency_ghz"], 7.5);
}

/// Without positions or a CRS.
TEST_F(Documents, OfALineOverAProfile) {
  std::istringstream csv("0,10\n1,80\n2,20\n");
  std::vector<std::string> warnings;
  LosQuery query;
  query.from_height_m = query.to_height_m = 2;
  const LosReport report = analyse(read_profile_csv(csv, "profile", warnings), query);
  const Document found = found_in(json_of(report));
  EXPECT_EQ(found, los_document(report));
  EXPECT_TRUE(found["crs"].is_null());
  EXPECT_TRUE(found["from"]["x"].is_null());
  EXPECT_EQ(found["verdict"], "hidden");
  EXPECT_FALSE(found.contains("surface"));
}

TEST_F(Documents, OfProfiles) {
  std::vector<SurfaceProfile> profiles;
  for (const double tolerance : {0.0, 4.0}) {
    const Detail detail = Detail::tolerance(tolerance);
    profiles.push_back({detail, "", from_section(cross_section(*store_, from_, to_, detail))});
  }
  const Document found = found_in(json_of(metadata(), ThemeChoice::none(), profiles));
  EXPECT_EQ(found, profile_document(metadata(), ThemeChoice::none(), profiles));
  EXPECT_EQ(found["profiles"].size(), 2U);
  EXPECT_EQ(found["profiles"][1]["tolerance_m"], 4);
  EXPECT_EQ(found["profiles"][0]["breakpoints"].size(), profiles[0].profile.points.size());
}

TEST_F(Documents, OfLinks) {
  LinkTable table;
  table.links = {{"near", from_, 30, {300150, 209900}, 30}, {"outside", from_, 10, {0, 0}, 10}};
  table.bad.resize(2);
  NoProgress progress;
  const LinkSurvey survey = survey_link_table(*store_, table, {}, progress);
  const Document found = found_in(json_of(survey));
  EXPECT_EQ(found, links_document(survey));
  EXPECT_EQ(found["links"]["visible"], 1);
  EXPECT_EQ(found["links"]["error"], 3);
}

}  // namespace
}  // namespace itin::profile
