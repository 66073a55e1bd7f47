// Where wind turbines are visible from, as a folder of maps and tables.
//
//   wind_farm town.itin turbines.csv zone
#include <iostream>

#include <itin/itin.hpp>
#include <viewshed/zone_study.hpp>

namespace {

using namespace itin;

void study_wind_farm(const std::string& path, const std::string& turbines, const std::string& folder) {
  NoProgress progress;
  const Store store(path);
  const viewshed::ZoneStudy study = viewshed::study_zone(
      store,
      {.turbines = viewshed::read_turbines({.path = turbines}, store.metadata().crs_wkt), .zone = {.cell_size = 50}},
      progress);
  for (const viewshed::ZoneFile& file : viewshed::write_zone_study(folder, store, study, {}, progress))
    std::cout << file.name << ": " << file.what << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "wind_farm STORE.itin TURBINES.csv FOLDER\n";
    return 2;
  }
  try {
    study_wind_farm(argv[1], argv[2], argv[3]);
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
