// Where to put three cameras so that they see the most: sites are proposed from the terrain, looked from, and chosen;
// and tables, layers, rasters and maps of what they see.
//
//   siting town.itin cameras
#include <iomanip>
#include <iostream>

#include <itin/itin.hpp>
#include <viewshed/site_plan.hpp>

namespace {

using namespace itin;

viewshed::SitePlanRequest three_cameras(const StoreMetadata& metadata) {
  return {.search_area = Window::box(metadata.grid.box(metadata.bounds)),
          .spacing = 120,
          .masts = {{.height = 6}},
          .demand = {.height = 1.5},
          .radius = 150,
          .cell_size = 2,
          .count = 3,
          .themes = ThemeChoice::all()};
}

void print(const viewshed::SitePlan& plan) {
  for (const std::string& warning : plan.warnings) std::cerr << warning << '\n';
  std::cout << std::fixed << std::setprecision(1);
  for (const viewshed::ChosenSite& site : plan.choice.chosen) {
    const viewshed::SitePosition& place = plan.place_of(site);
    std::cout << "site " << place.name << " at " << place.position.x << ", " << place.position.y << " sees "
              << site.gain << " further cells\n";
  }
  std::cout << plan.choice.value << " cells in all; no three of these sites see more than " << plan.choice.upper_bound
            << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "siting STORE.itin FOLDER\n";
    return 2;
  }
  try {
    const Store store(argv[1]);
    NoProgress progress;
    const viewshed::SitePlan plan = viewshed::plan_sites(store, three_cameras(store.metadata()), progress);
    print(plan);
    for (const viewshed::PlanFile& file :
         viewshed::write_site_plan(argv[2], plan, store, progress, {.overwrite = true}))
      std::cout << file.path << ": " << file.what << '\n';
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
