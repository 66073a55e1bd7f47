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
    const itin::profile::StoreLine line{
        .from = {number(2), number(3)}, .to = {number(5), number(6)}, .themes = itin::ThemeChoice::all()};
    itin::profile::LosQuery query;
    query.from_height_m = number(4), query.to_height_m = number(7);
    query.earth = itin::Earth::effective_earth(4.0 / 3);
    query.radio = itin::profile::RadioPath{.frequency_ghz = 26};
    const itin::profile::LosReport report = itin::profile::analyse(store, line, query);
    std::cout << name_of(report.verdict) << ", " << report.profile.length_m << " m\n";
    if (report.clearance_m) std::cout << "clearance " << *report.clearance_m << " m\n";
    if (report.critical)
      std::cout << "tightest at " << report.critical->distance_m << " m, over "
                << cause_of(report, report.critical->theme, report.critical->feature) << '\n';
    if (report.losses) std::cout << "diffraction loss " << report.losses->ld_db << " dB\n";

    // A coarse surface is read faster. Where its certified error leaves it open, the verdict is undecided.
    itin::profile::StoreLine coarse = line;
    coarse.detail = itin::Detail::tolerance(4);
    std::cout << "at a tolerance of 4 m " << name_of(itin::profile::analyse(store, coarse, query).verdict) << '\n';

    // Any number of links at once is faster than one by one. Here there is the way there and back.
    itin::profile::LinkQuery surface;
    surface.earth = query.earth, surface.themes = line.themes;
    const std::vector<itin::profile::Link> links = {{"there", line.from, number(4), line.to, number(7)},
                                                    {"back", line.to, number(7), line.from, number(4)}};
    itin::NoProgress progress;
    for (const itin::profile::LinkResult& link : survey_links(store, links, surface, progress))
      std::cout << (link.found ? name_of(link.found->verdict) : link.message) << '\n';

    // The surface under the line: every breakpoint of its triangles, nothing sampled.
    itin::profile::Chart chart;
    chart.title = "A to B";
    chart.series = {{"full detail", report.profile}};
    std::ofstream("profile.svg") << itin::profile::draw_chart(chart, "profile.svg");
  } catch (const itin::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
