#include "site/site_result.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace itin::cli {

namespace {

using viewshed::DemandSet;
using viewshed::SitePosition;
using viewshed::Verdict;

/// Finds the best server of each cell: the nearest site, whose signal is the strongest in the open.
class BestServer {
 public:
  BestServer(const RasterGrid& grid, const DemandSet& in_reach)
      : grid_(grid), nearest_(grid.cell_count(), std::numeric_limits<double>::infinity()) {
    rasters_ = {grid,
                std::vector<std::uint16_t>(grid.cell_count(), SiteRasters::kOutside),
                std::vector<std::uint16_t>(grid.cell_count(), SiteRasters::kOutside),
                {}};
    rasters_.served.reserve(grid.cell_count());
    for_each_cell(in_reach, [&](std::size_t i, Point2) { rasters_.redundancy[i] = rasters_.best_server[i] = 0; });
  }

  void add(const SitePosition& place, std::uint16_t number, const DemandSet& served) {
    for_each_cell(served, [&](std::size_t i, Point2 centre) {
      if (rasters_.redundancy[i] == SiteRasters::kOutside) return;
      ++rasters_.redundancy[i];
      const double distance = std::hypot(centre.x - place.position.x, centre.y - place.position.y);
      if (distance < nearest_[i]) nearest_[i] = distance, rasters_.best_server[i] = number;
    });
  }
  /// Returns the rasters. `undecided` holds the undecided ones of the cells that fewer than `cover` sites serve.
  SiteRasters rasters(int cover, const DemandSet& undecided) && {
    for (const std::uint16_t n : rasters_.redundancy)
      rasters_.served.push_back(n == SiteRasters::kOutside ? Verdict::kOutside
                                : n >= cover               ? Verdict::kVisible
                                                           : Verdict::kHidden);
    for_each_cell(undecided, [&](std::size_t i, Point2) {
      if (rasters_.served[i] == Verdict::kHidden) rasters_.served[i] = Verdict::kUndecided;
    });
    return std::move(rasters_);
  }

 private:
  void for_each_cell(const DemandSet& set, const auto& visit) const {
    for_each_element(set, [&](std::size_t element) {
      const RasterGrid::Cell cell = viewshed::cell_of(grid_, element);
      visit(grid_.index(cell), grid_.centre(cell.column, cell.row));
    });
  }

  const RasterGrid& grid_;
  std::vector<double> nearest_;
  SiteRasters rasters_;
};

}  // namespace

viewshed::SiteSurvey site_survey(const SiteOptions& options, const SiteInputs& inputs) {
  viewshed::SiteSurvey survey;
  survey.positions = inputs.positions;
  survey.targets = inputs.targets;
  survey.radius = options.radius;
  survey.earth = options.earth.earth();
  survey.nodata = options.nodata.rule();
  survey.open = options.open_targets();
  survey.themes = options.themes.choice();
  survey.fresnel = options.criterion();
  survey.tolerance = options.tolerance;
  survey.engine = options.engine.engine();
  survey.memory_bytes = options.memory_bytes;
  return survey;
}

const char* outcome_of(const SiteOptions& options, const SiteLink& link) {
  const profile::SightVerdict verdict = link.found().verdict;
  if (verdict != profile::SightVerdict::kVisible || !options.frequency_ghz) return name_of(verdict);
  return link_rules(options).met_by(link.found()) ? "clear" : "in sight, zone cut";
}

double SiteResult::served() const {
  return in_metric(choice.value + choice.existing);
}

double SiteResult::served_percent() const {
  return inputs.total == 0 ? 0 : 100 * served() / in_metric(inputs.total);
}

double SiteResult::undecided_percent() const {
  return inputs.total == 0 ? 0 : 100 * undecided / in_metric(inputs.total);
}

std::string SiteResult::meaning() const {
  if (!coverage.leaves_open()) return options.meaning_of_served();
  return options.meaning_of_served() + "; what only ground without data could hide is undecided, and " +
         (options.placement.given() ? "counts as seen" : "does not count");
}

std::size_t SiteResult::refined() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < inputs.options.size(); ++i) count += coverage.stage(i) > 0;
  return count;
}

bool SiteResult::is_chosen(std::size_t option) const {
  return std::any_of(choice.chosen.begin(), choice.chosen.end(),
                     [&](const viewshed::ChosenSite& site) { return site.option == option; });
}

std::string SiteResult::reason(std::size_t option) const {
  if (is_chosen(option)) return "chosen";
  const bool exact = coverage.bounds(option).exact || options.placement.sums_heights();
  const std::optional<viewshed::Margin>& margin = choice.closest[option];
  if (!margin)
    return options.placement.given() ? "ruled out at every step by the spacing"
                                     : "ruled out at every step: by spacing, links, cost, or another mast at its place";
  const std::string at_step = fmt::format("at step {} of the first selection it ", margin->step + 1);
  using enum viewshed::Margin::Outcome;
  if (margin->outcome == kTaken)
    return fmt::format("taken at step {} of the first selection, and replaced by a better choice", margin->step + 1);
  const double unit = measure.in_metric(1);
  const std::string gains = fmt::format("would have added {} {:.10g}{}; the one taken added {:.10g}",
                                        exact                       ? "exactly"
                                        : options.placement.given() ? "at least"
                                                                    : "at most",
                                        margin->upper * unit,
                                        options.budget         ? " per unit of cost"
                                        : options.intervisible ? " per site, with the relays that it needs"
                                                               : "",
                                        margin->chosen * unit);
  if (margin->outcome == kOutbid) return at_step + gains;
  return at_step + (margin->outcome == kTooNear ? too_near(option) : "would have left too few places for the others") +
         "; it " + gains;
}

std::string SiteResult::too_near(std::size_t option) const {
  const Point2 place = inputs.positions[option].position;
  for (const viewshed::ChosenSite& site : choice.chosen)
    if (!options.may_both_stand(place, place_of(site).position)) return "stood too near " + place_of(site).name;
  return "stood too near one chosen before, which was replaced";
}

namespace {

/// Returns the cells of the rasters that are not outside.
DemandSet cells_in_reach(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                         const std::vector<std::size_t>& serving, const viewshed::SiteTargets& cells,
                         Progress& progress) {
  if (!inputs.cells.empty()) return inputs.cells;
  std::vector<SitePosition> sites;
  for (const std::size_t site : serving) sites.push_back(inputs.positions[site]);
  if (inputs.targets.grid || sites.empty()) sites = inputs.positions;
  return intersection(viewshed::with_ground(store, cells, progress),
                      viewshed::within_reach(cells, sites, options.radius));
}

}  // namespace

SiteRasters site_rasters(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                         const viewshed::Choice& choice, const JointCoverage& cells, Progress& progress) {
  const std::vector<std::size_t> sites = serving_sites(inputs, choice);
  BestServer best(*cells.targets.grid, cells_in_reach(store, options, inputs, sites, cells.targets, progress));
  for (std::size_t i = 0; i < sites.size(); ++i)
    best.add(inputs.positions[sites[i]], static_cast<std::uint16_t>(i + 1), cells.certain[i]);
  return std::move(best).rasters(options.cover, cells.undecided);
}

std::vector<double> site_grounds(const Store& store, const SiteInputs& inputs, const viewshed::Choice& choice,
                                 Progress& progress) {
  std::vector<Point2> positions;
  for (const viewshed::ChosenSite& site : choice.chosen) positions.push_back(inputs.positions[site.option].position);
  std::vector<double> grounds;
  for (const auto& ground : viewshed::ground_under(store, positions, ThemeChoice::none(), progress))
    grounds.push_back(ground.value());
  return grounds;
}

}  // namespace itin::cli
