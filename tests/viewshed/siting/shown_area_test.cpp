// The area that maps of sites show.
#include <gtest/gtest.h>

#include "workflows/siting/output/site_map_objects.hpp"

namespace itin::viewshed {
namespace {

/// Lines of the search area never lie on the frame, whether the cells reach beyond them or not.
TEST(ShownArea, HasRoomAboutTheSearchArea) {
  for (const double side : {500.0, 3000.0}) {
    SitePlan plan;
    plan.rasters.grid = RasterGrid({1000, 2000}, 10, 10, 100, 100);
    const Box searched{1500 - side / 2, 1500 - side / 2, 1500 + side / 2, 1500 + side / 2};
    plan.request.search_area = Window::box(searched);
    plan.request.spacing = 100;
    for (const Point2 corner : {Point2{searched.xmin, searched.ymin}, Point2{searched.xmax, searched.ymax}})
      plan.inputs.candidates.push_back({.place = {.position = corner}, .proposed_as = {}});
    const Box shown = shown_area(plan);
    for (const double room : {searched.xmin - shown.xmin, searched.ymin - shown.ymin, shown.xmax - searched.xmax,
                              shown.ymax - searched.ymax})
      EXPECT_GT(room, 0.005 * side) << side;
  }
}

}  // namespace
}  // namespace itin::viewshed
