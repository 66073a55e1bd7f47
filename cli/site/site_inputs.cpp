#include "site/site_inputs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/window_source.hpp>
#include <viewshed/site_proposal.hpp>
#include <viewshed/turbine_layout.hpp>

#include "options/off_the_data.hpp"
#include "options/site_list.hpp"
#include "site/site_demand.hpp"

namespace itin::cli {

namespace {

class InputReader {
 public:
  InputReader(const Store& store, const SiteOptions& options, Progress& progress)
      : store_(store), options_(options), crs_(store.metadata().crs_wkt), progress_(progress) {}

  SiteInputs read() {
    if (options_.candidates.path.empty()) {
      propose();
    } else {
      read_candidates();
    }
    require_any_candidate_on_the_data();
    const std::vector<Site> existing = read_existing();
    leave_out_forbidden();
    leave_out_near_dwellings();
    leave_out_near(existing);
    place_on_ground();
    if (inputs_.options.empty()) throw InputError(nothing_left());
    place_existing(existing);
    read_site_demand(store_, options_, inputs_, progress_);
    return std::move(inputs_);
  }

 private:
  void reject(const std::string& line) { inputs_.rejected.push_back(line); }

  std::string nothing_left() const {
    if (inputs_.rejected.empty())
      return options_.candidates.path.empty() ? "no candidate is left to choose from"
                                              : none_in(options_.candidates, "candidate");
    return fmt::format("no candidate is left to choose from; the first left out: {}; the data is {}",
                       inputs_.rejected.front(), extent_of(store_.metadata()));
  }

  void propose() {
    const Window area = window_from_polygon(options_.search_area, crs_, options_.in_crs.crs);
    if (options_.placement.given()) {
      for (const Point2 place : viewshed::spaced_positions(area, *options_.spacing))
        inputs_.candidates.push_back({.id = fmt::format("{}", inputs_.candidates.size()),
                                      .position = place,
                                      .height = std::nullopt,
                                      .cost = 0,
                                      .why = "spaced"});
      return;
    }
    viewshed::ProposalRequest request;
    request.spacing = *options_.spacing;
    request.radius = options_.radius;
    request.mast_height = options_.masts.front().height;
    request.target_height = options_.target_height;
    request.earth = options_.earth.earth();
    request.themes = options_.themes.choice();
    request.on_surface = options_.on_surface;
    request.targets_on_surface = options_.targets_on_surface;
    for (const viewshed::Proposal& proposal : viewshed::propose_sites(store_, area, request, progress_)) {
      inputs_.candidates.push_back({.id = fmt::format("{}", inputs_.candidates.size()),
                                    .position = proposal.position,
                                    .height = std::nullopt,
                                    .cost = 0,
                                    .why = reason_for(proposal)});
    }
  }

  static std::string reason_for(const viewshed::Proposal& proposal) {
    if (proposal.roof) return proposal.summit ? "highest roof" : "roof by visibility index";
    return proposal.summit ? "summit" : "visibility index";
  }

  void read_candidates() {
    SiteQuery query = options_.candidates;
    query.crs = options_.in_crs.crs;
    if (options_.cost_field.empty()) {
      warn_of_unused(query, LayerFields(query), "cost", "--cost-field", inputs_.warnings);
    } else {
      query.numbers.push_back({options_.cost_field});
    }
    for (const Site& site : read_sites(query, crs_, inputs_.warnings, inputs_.rejected)) {
      const std::string place = fmt::format("{}: {}", query.path, site.place);
      const double cost = site.numbers.empty() ? 0 : site.numbers.front().value_or(std::nan(""));
      if (!(cost >= 0)) {
        reject(place + ": its cost is missing or negative");
      } else if (site.height && *site.height < 0) {
        reject(place + ": its height is negative");
      } else {
        const std::string id = query.name_field.empty() ? fmt::format("{}", site.row) : site.name;
        inputs_.candidates.push_back({id, site.position, site.height, cost, {}});
      }
    }
  }

  /// Leaves out the candidates at `unfit` places. `why` tells the reason, and follows a candidate's name. Returns the
  /// number left out.
  template <class Unfit>
  std::size_t leave_out(const std::string& why, const Unfit& unfit) {
    const std::size_t first = inputs_.rejected.size();
    const std::size_t left_out = std::erase_if(inputs_.candidates, [&](const Candidate& candidate) {
      const bool is_unfit = unfit(candidate.position);
      if (is_unfit) reject(fmt::format("candidate {}: {}", candidate.id, why));
      return is_unfit;
    });
    if (left_out > 0) inputs_.barred.push_back({why, first, left_out});
    return left_out;
  }

  void leave_out_forbidden() {
    if (options_.forbidden.empty()) return;
    const Window area = window_from_polygon(options_.forbidden, crs_, options_.in_crs.crs);
    leave_out("lies in a forbidden area", [&](Point2 p) { return area.contains(p); });
  }

  void leave_out_near_dwellings() {
    const PlacementOptions& placement = options_.placement;
    if (placement.dwellings.empty()) return;
    const viewshed::Dwellings dwellings = read_dwellings();
    const std::size_t left_out = leave_out(fmt::format("stands nearer than {:g} m to a dwelling", placement.setback()),
                                           [&](Point2 p) { return dwellings.any_within(p, placement.setback()); });
    if (left_out == 0)
      inputs_.warnings.push_back(
          fmt::format("{}: the dwellings keep no candidate away: all stand at least {:g} m from each; check where the "
                      "dwellings are, or leave out --dwellings",
                      placement.dwellings, placement.setback()));
  }

  /// Reads the dwellings, which are points or polygons. No dwelling may be left out.
  viewshed::Dwellings read_dwellings() {
    SiteQuery query;
    query.path = options_.placement.dwellings;
    query.crs = options_.in_crs.crs;
    std::vector<std::string> no_points;
    std::vector<Point2> points;
    for (const Site& site : read_sites(query, crs_, inputs_.warnings, no_points)) points.push_back(site.position);
    if (points.empty() && no_points.empty()) throw InputError(none_in(query, "dwelling"));
    if (points.empty()) return {{}, window_from_polygon(query.path, crs_)};
    if (!no_points.empty())
      throw InputError(fmt::format("{}; give dwellings that are all points, or all polygons", no_points.front()));
    return {std::move(points), std::nullopt};
  }

  /// Leaves out candidates too near existing turbines.
  void leave_out_near(const std::vector<Site>& existing) {
    if (!options_.placement.given()) return;
    leave_out("stands too near an existing turbine", [&](Point2 p) {
      return std::any_of(existing.begin(), existing.end(),
                         [&](const Site& site) { return !options_.may_both_stand(p, site.position); });
    });
  }

  ThemeChoice ground_themes() const { return options_.on_surface ? options_.themes.choice() : ThemeChoice::none(); }

  std::vector<Point2> candidate_positions() const {
    std::vector<Point2> positions;
    for (const Candidate& candidate : inputs_.candidates) positions.push_back(candidate.position);
    return positions;
  }

  void require_any_candidate_on_the_data() const {
    require_any_on_the_data(options_.candidates.path + ": the first candidate", candidate_positions(), options_.in_crs,
                            store_.metadata());
  }

  /// Places the candidates on their ground, and makes an option of each with every mast.
  void place_on_ground() {
    const auto ground = viewshed::ground_under(store_, candidate_positions(), ground_themes(), progress_);
    std::vector<Candidate> kept;
    for (std::size_t i = 0; i < ground.size(); ++i) {
      const Candidate& candidate = inputs_.candidates[i];
      if (!ground[i]) {
        const bool on = is_on_the_data(candidate.position, store_.metadata());
        reject(fmt::format("candidate {} at {:.10g},{:.10g}: {}", candidate.id, candidate.position.x,
                           candidate.position.y, on ? "there is no data there" : "it lies off the data"));
        continue;
      }
      std::vector<Mast> masts = options_.masts;
      if (candidate.height) masts = {{*candidate.height, options_.masts.front().cost}};
      for (const Mast& mast : masts) {
        if (!(candidate.cost + mast.cost > 0))
          throw InputError(fmt::format("candidate {}: its cost is 0; costs must be positive", candidate.id));
        inputs_.options.push_back({kept.size(), candidate.cost + mast.cost});
        inputs_.positions.push_back({candidate.id, candidate.position, mast.height, *ground[i]});
      }
      kept.push_back(candidate);
    }
    inputs_.candidates = std::move(kept);
  }

  std::vector<Site> read_existing() {
    if (options_.existing.empty()) return {};
    SiteQuery query;
    query.path = options_.existing;
    query.height_field = options_.existing_height_field;
    query.crs = options_.in_crs.crs;
    const std::size_t rejected = inputs_.rejected.size();
    const std::vector<Site> sites = read_sites(query, crs_, inputs_.warnings, inputs_.rejected);
    if (sites.empty() && inputs_.rejected.size() == rejected) throw InputError(none_in(query, "site"));
    return sites;
  }

  void place_existing(const std::vector<Site>& sites) {
    std::vector<Point2> positions;
    for (const Site& site : sites) positions.push_back(site.position);
    const auto ground = viewshed::ground_under(store_, positions, ground_themes(), progress_);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const double height = sites[i].height.value_or(options_.masts.front().height);
      if (!ground[i] || height < 0) {
        reject(fmt::format("{}: {}: {}", options_.existing, sites[i].place,
                           ground[i] ? "its height is negative" : "there is no data there"));
      } else {
        inputs_.positions.push_back({sites[i].name, sites[i].position, height, *ground[i]});
      }
    }
  }

  const Store& store_;
  const SiteOptions& options_;
  std::string crs_;
  Progress& progress_;
  SiteInputs inputs_;
};

}  // namespace

SiteInputs read_site_inputs(const Store& store, const SiteOptions& options, Progress& progress) {
  return InputReader(store, options, progress).read();
}

}  // namespace itin::cli
