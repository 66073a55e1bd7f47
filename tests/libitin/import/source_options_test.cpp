#include "import/source/source_options.hpp"

#include <gmock/gmock.h>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>

namespace itin {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using enum SourceKind;

void check(const ImportOptions& options, const std::vector<SourceKind>& sources) {
  require_useful_options(options, sources);
}

TEST(SourceOptions, AreRefusedByNameWhereNoSourceUsesThem) {
  ImportOptions options;
  for (const SourceKind kind :
       {raster, las, text, points, contours, terrain_lines, ground_lines, buildings, walls, city_model})
    EXPECT_NO_THROW(check(options, {kind}));
  options.classes = {2};
  EXPECT_THAT([&] { check(options, {raster}); },
              ThrowsMessage<InputError>("`classes`: does nothing for rasters, only for LAS; leave it out"));
  EXPECT_THAT(
      [&] {
        check(options, {raster, text});
      },
      ThrowsMessage<InputError>(HasSubstr("does nothing for rasters and delimited text, only for LAS")));
  EXPECT_NO_THROW(check(options, {raster, las}));
}

TEST(SourceOptions, MeanSomethingForTheirOwnSources) {
  const auto expect = [](const ImportOptions& options, const std::vector<SourceKind>& served) {
    for (const SourceKind kind :
         {raster, las, text, points, contours, terrain_lines, ground_lines, buildings, walls, city_model}) {
      const bool serves = std::find(served.begin(), served.end(), kind) != served.end();
      if (serves) {
        EXPECT_NO_THROW(check(options, {kind})) << static_cast<int>(kind);
      } else {
        EXPECT_THROW(check(options, {kind}), InputError) << static_cast<int>(kind);
      }
    }
  };
  ImportOptions options;
  expect((options = {}, options.band = 1, options), {raster});
  expect((options = {}, options.max_gap = 5, options), {las, text, points, contours});
  expect((options = {}, options.z_field = "z", options), {text, points, contours, terrain_lines});
  expect((options = {}, options.layer = "l", options),
         {points, contours, terrain_lines, ground_lines, buildings, walls});
  expect((options = {}, options.where = "a > 1", options),
         {points, contours, terrain_lines, ground_lines, buildings, walls});
  expect((options = {}, options.replace = true, options), {raster, las, text, points});
  expect((options = {}, options.repair = false, options), {contours});
  expect((options = {}, options.height = 3, options), {buildings, walls});
  expect((options = {}, options.thickness = 3, options), {buildings, walls});
  expect((options = {}, options.storey = 3, options), {buildings, walls});
  expect((options = {}, options.roof = RoofKind::flat, options), {buildings});
  expect((options = {}, options.base = BaseRule::minimum, options), {buildings, city_model});
  expect((options = {}, options.to_crs = "EPSG:27700", options),
         {raster, las, text, points, contours, terrain_lines, ground_lines});
}

}  // namespace
}  // namespace itin
