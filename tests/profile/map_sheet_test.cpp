#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <profile/map_sheet.hpp>

namespace itin::profile {

namespace {

MapSheet sheet_of(PaperSize paper, double kilometres) {
  MapSheet sheet;
  sheet.paper = paper, sheet.area = {300000, 200000, 300000 + 1000 * kilometres, 200000 + 1000 * kilometres};
  return sheet;
}

TEST(MapSheet, TakesTheLargestUsualScaleThatHoldsTheArea) {
  // The frame on A3 is 273 mm high: 30 km are 273 mm at 1:109,890.
  EXPECT_EQ(scale_of(sheet_of(PaperSize::kA3, 30)), 125000);
  EXPECT_EQ(scale_of(sheet_of(PaperSize::kA3, 27)), 100000);
  EXPECT_EQ(scale_of(sheet_of(PaperSize::kA1, 27)), 50000);
}

TEST(MapSheet, TheFrameHoldsTheAreaInItsMiddle) {
  const MapSheet sheet = sheet_of(PaperSize::kA3, 30);
  const Box ground = ground_in_frame(sheet);
  EXPECT_NEAR((ground.xmin + ground.xmax) / 2, 315000, 1e-6);
  EXPECT_NEAR(ground.height(), 273 * 125, 0.01);
  EXPECT_GT(ground.width(), ground.height());
}

TEST(MapSheet, RefusesAScaleAtWhichTheAreaDoesNotFit) {
  MapSheet sheet = sheet_of(PaperSize::kA3, 30);
  sheet.scale = 100000;
  EXPECT_THROW(scale_of(sheet), InputError);
  sheet.scale = 250000;
  EXPECT_EQ(scale_of(sheet), 250000);
}

TEST(MapSheet, EqualSheetsGiveEqualBytes) {
  MapSheet sheet = sheet_of(PaperSize::kA3, 30);
  sheet.layers = {SheetCells{RasterGrid({300000, 230000}, 15000, 15000, 2, 2), {{255, 0, 0, 255}, {}, {}, {}}},
                  SheetMarks{SheetSymbol::kTurbine, {}, {{{310000, 210000}, "1"}}}};
  for (const char* name : {"a.pdf", "a.png"}) EXPECT_EQ(draw_map_sheet(sheet, name), draw_map_sheet(sheet, name));
  EXPECT_THROW(draw_map_sheet(sheet, "a.svg"), InputError);
}

TEST(MapSheet, ShowsAllColoursOfAPatch) {
  const auto drawn_with = [](std::vector<Rgba> colours) {
    MapSheet sheet = sheet_of(PaperSize::kA3, 30);
    sheet.legend = {{SheetKey::Sample::kPatch, std::move(colours), "Hidden"}};
    return draw_map_sheet(sheet, "a.png");
  };
  const Rgba red{200, 0, 0}, green{0, 200, 0};
  const std::string both = drawn_with({red, green});
  EXPECT_TRUE(both != drawn_with({red}) && both != drawn_with({green}));
}

}  // namespace

}  // namespace itin::profile
