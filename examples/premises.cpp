// Which buildings a mast can serve, and from where; and tables, layers and a map of that.
//
//   premises town.itin 321790 4297662 18 served
#include <iostream>
#include <string>

#include <itin/itin.hpp>
#include <viewshed/premises.hpp>

namespace {

using namespace itin;

void print(const viewshed::PremisesSurvey& survey) {
  for (const std::string& warning : survey.warnings) std::cerr << warning << '\n';
  for (const viewshed::Premises& house : survey.premises) {
    if (!house.best) continue;
    const viewshed::Mounting& antenna = house.best_mounting();
    std::cout << house.name << ": " << antenna.height_m << " m up "
              << (antenna.on == viewshed::MountedOn::kWall ? "before a wall, at " : "on the roof, at ")
              << antenna.position.x << ", " << antenna.position.y << '\n';
  }
  const viewshed::PremisesCounts counts = survey.counts();
  std::cout << counts.served() << " of " << counts.all << " buildings are served\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::cerr << "premises STORE.itin X Y HEIGHT FOLDER\n";
    return 2;
  }
  try {
    const Store store(argv[1]);
    NoProgress progress;
    viewshed::PremisesRequest request;
    request.masts.places = {
        {.name = "mast", .position = {std::stod(argv[2]), std::stod(argv[3])}, .height = std::stod(argv[4])}};
    request.frequency_ghz = 26, request.earth = Earth::effective_earth(4.0 / 3);
    const viewshed::PremisesSurvey survey = viewshed::survey_premises(store, request, progress);
    print(survey);
    viewshed::write_premises(argv[5], store, survey, {.overwrite = true}, progress);
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
