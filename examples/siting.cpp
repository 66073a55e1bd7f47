// Where to put three cameras so that they see the most: sites are proposed from the terrain, looked from, and chosen.
//
//   siting town.itin
#include <iomanip>
#include <iostream>

#include <itin/itin.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/site_proposal.hpp>
#include <viewshed/siting.hpp>

namespace {

using namespace itin;

/// The proposed sites, each with the height of the ground under it.
std::vector<viewshed::SitePosition> proposed_sites(const Store& store, double height, Progress& progress) {
  viewshed::ProposalRequest proposal;
  proposal.spacing = 120;
  proposal.radius = 150;
  proposal.mast_height = height;
  const StoreMetadata& metadata = store.metadata();
  const Window everywhere = Window::box(metadata.grid.box(metadata.bounds));
  std::vector<Point2> positions;
  for (const viewshed::Proposal& p : viewshed::propose_sites(store, everywhere, proposal, progress))
    positions.push_back(p.position);
  const auto ground = viewshed::ground_under(store, positions, ThemeChoice::none(), progress);
  std::vector<viewshed::SitePosition> sites;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (ground[i]) sites.push_back({"site " + std::to_string(i + 1), positions[i], height, *ground[i]});
  return sites;
}

void choose_cameras(const Store& store) {
  NoProgress progress;
  viewshed::SiteSurvey survey;
  survey.positions = proposed_sites(store, 6, progress);
  survey.radius = 150;
  survey.themes = ThemeChoice::all();
  survey.targets.height = 1.5;
  survey.targets.grid = viewshed::grid_of_reach(store, survey.positions, survey.radius, 2);

  viewshed::SiteCoverage coverage(store, survey, progress);
  coverage.explore();
  // Every cell counts as 1; every site is a place of its own and costs as much as the others.
  const viewshed::Demand demand(viewshed::element_count(*survey.targets.grid));
  std::vector<viewshed::SiteOption> options;
  for (std::size_t i = 0; i < survey.positions.size(); ++i) options.push_back({.place = i});
  const viewshed::Choice choice = viewshed::choose(demand, options, coverage, {.count = 3}, progress);

  std::cout << std::fixed << std::setprecision(1);
  for (const viewshed::ChosenSite& site : choice.chosen) {
    const viewshed::SitePosition& place = survey.positions[site.option];
    std::cout << place.name << " at " << place.position.x << ", " << place.position.y << " sees " << site.gain
              << " further cells\n";
  }
  std::cout << choice.value << " cells in all; no three of these sites see more than " << choice.upper_bound << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "siting STORE.itin\n";
    return 2;
  }
  try {
    choose_cameras(Store(argv[1]));
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
