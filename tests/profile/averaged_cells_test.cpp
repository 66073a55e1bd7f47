#include <algorithm>

#include <gtest/gtest.h>

#include <profile/averaged_cells.hpp>
#include <profile/map_sheet.hpp>

namespace itin::profile {
namespace {

constexpr Rgba kBlue{0, 0, 200, 255};

TEST(AveragedCells, AreMeansOfColoursByTheirOpacity) {
  const std::vector<Rgba> cells{{200, 0, 0, 255}, kTransparent, kBlue, {0, 100, 0, 255},  //
                                kTransparent,     kTransparent, kBlue, {0, 100, 0, 255}};
  const std::vector<Rgba> few = averaged_cells(cells, {4, 2}, {2, 1});
  ASSERT_EQ(few.size(), 2U);
  EXPECT_EQ(few[0], (Rgba{200, 0, 0, 64}));
  EXPECT_EQ(few[1], (Rgba{0, 50, 100, 255}));
}

TEST(AveragedCells, TakeEachCellOnceWhereTheCountsDoNotDivide) {
  // Each of the seven cells is opaque in one of seven pictures; together their means are as opaque as the cells.
  double opacity = 0;
  for (std::size_t i = 0; i < 7; ++i) {
    std::vector<Rgba> cells(7, kTransparent);
    cells[i] = kBlue;
    const std::vector<Rgba> few = averaged_cells(cells, {7, 1}, {3, 1});
    EXPECT_EQ(std::count_if(few.begin(), few.end(), [](const Rgba& c) { return c.alpha > 0; }), 1);
    for (const Rgba& c : few) opacity += c.alpha / 255.0;
  }
  EXPECT_NEAR(opacity, 3, 0.01);
}

/// A picture of far more cells than pixels shows a single column of them.
TEST(AveragedCells, ThinThingsStayOnAMap) {
  MapSheet sheet;
  sheet.area = {0, 0, 2000, 2000};
  SheetCells cells{RasterGrid({0, 2000}, 1, 1, 2000, 2000), std::vector<Rgba>(4000000, kTransparent)};
  for (std::int64_t row = 0; row < 2000; ++row) cells.colours[cells.grid.index({777, row})] = kBlue;
  sheet.layers = {cells};
  const MapPicture picture = draw_map_picture(sheet, 400);
  std::size_t blue = 0;
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    const auto channel = [&](std::size_t c) { return static_cast<unsigned char>(picture.rgb[i + c]); };
    blue += channel(2) > channel(0) + 20;
  }
  EXPECT_GT(blue, 300U);
}

TEST(SymbolSvg, HasElementsAlone) {
  for (const SheetSymbol symbol : {SheetSymbol::kTurbine, SheetSymbol::kViewpoint, SheetSymbol::kHub}) {
    const std::string svg = symbol_svg(symbol, kBlue, 14);
    EXPECT_EQ(svg.find("<svg"), std::string::npos);
    EXPECT_NE(svg.find("#0000c8"), std::string::npos);
  }
  EXPECT_NE(symbol_svg(SheetSymbol::kTurbine, kBlue, 14), symbol_svg(SheetSymbol::kMast, kBlue, 14));
}

TEST(SampleSvg, DrawsEveryKind) {
  using enum SheetKey::Sample;
  const auto has = [](SheetKey::Sample sample, const char* what) {
    const std::string svg = sample_svg({sample, {kBlue}, "text"}, 24, 16);
    return svg.find(what) != std::string::npos;
  };
  EXPECT_TRUE(has(kPatch, "#0000c8"));
  EXPECT_TRUE(has(kLine, "stroke=\"#0000c8\""));
  EXPECT_TRUE(has(kDashes, "stroke-dasharray"));
  EXPECT_TRUE(has(kMark, "<circle"));
  EXPECT_TRUE(has(SheetKey::Sample::kVoid, "#aaaaaa"));
}

}  // namespace
}  // namespace itin::profile
