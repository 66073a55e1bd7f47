// Whether two antennas see each other, what the radio path between them loses, and a drawing of the ground between.
//
//   line_of_sight town.itin 321590 4297655 10 321790 4297662 12
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <itin/itin.hpp>
#include <profile/chart.hpp>
#include <profile/links.hpp>

int main(int argc, char** argv) {
  if (argc != 8) {
    std::cerr << "line_of_sight STORE.itin EASTING NORTHING HEIGHT EASTING NORTHING HEIGHT\n";
    return 2;
  }
  const auto number = [&](int i) { return std::atof(argv[i]); };
  try {
    const itin::Store store(argv[1]);
    itin::NoProgress progress;
    const itin::Point2 from{number(2), number(3)}, to{number(5), number(6)};

    itin::profile::LinkQuery query;
    query.earth = itin::Earth::effective_earth(4.0 / 3);
    query.themes = itin::ThemeChoice::all();
    query.radio = itin::profile::RadioPath{.frequency_ghz = 26};
    // Any number of links at once; here there is one.
    const itin::profile::LinkResult link =
        itin::profile::survey_links(store, {{"A to B", from, number(4), to, number(7)}}, query, progress).front();
    if (!link.verdict) {
      std::cerr << link.message << '\n';  // no ground under an end, for instance
      return 1;
    }
    std::cout << itin::profile::name_of(*link.verdict) << ", " << link.distance_m << " m\n";
    if (link.clearance_m) std::cout << "least clearance " << *link.clearance_m << " m\n";
    if (link.ld_db) std::cout << "diffraction loss " << *link.ld_db << " dB\n";

    // The surface under the line: every breakpoint of its triangles, nothing sampled.
    itin::profile::Chart chart;
    chart.title = "A to B";
    chart.series = {{"full detail", itin::profile::from_section(itin::cross_section(
                                        store, from, to, itin::Detail::tolerance(0), query.themes))}};
    std::ofstream("profile.svg") << itin::profile::draw_chart(chart, "profile.svg");
  } catch (const itin::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
