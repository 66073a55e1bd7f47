// The text of a result is the document that the program prints.
#include <gtest/gtest.h>

#include <itin/triangulate.hpp>
#include <viewshed/documents.hpp>

#include "support/hills_and_town.hpp"

namespace itin::viewshed {
namespace {

TEST(Documents, OfViewshedsAndHorizons) {
  const test::HillsAndTown stores;
  const Store store(stores.hills());
  const StoreMetadata& metadata = store.metadata();
  NoProgress progress;
  Request request = test::HillsAndTown::over_hills();
  request.observers.resize(1);
  const Result result = compute(store, request, progress);
  const Document found = Document::parse(json_of(result, metadata));
  EXPECT_EQ(found.begin().key(), "itin");
  EXPECT_EQ(found["crs"], "EPSG:27700");
  EXPECT_EQ(found["cells"]["visible"], result.cells.visible);
  EXPECT_EQ(found["grid"]["columns"], result.grid.columns());
  EXPECT_EQ(found["refraction"]["k"], 0.13);
  EXPECT_EQ(found["statistics"]["lines"], result.statistics.lines);
  EXPECT_FALSE(found.contains("decided_percent"));
  EXPECT_TRUE(Document::parse(json_of(compute_certified(store, request, {}, progress).result, metadata))
                  .contains("decided_percent"));

  const Tin tin = triangulate(store, Window::all(), Detail::tolerance(0), progress);
  const Horizon sky = horizon(tin, tin, request, {.step_deg = 5, .targets = {{"t", {302000, 202000}, 3}}}, progress);
  const Document seen = Document::parse(json_of(sky, request, metadata));
  EXPECT_EQ(seen["sky_line"].size(), 72U);
  EXPECT_EQ(seen["observer"]["name"], "summit");
  EXPECT_EQ(seen["targets"], targets_document(sky));
}

}  // namespace
}  // namespace itin::viewshed
