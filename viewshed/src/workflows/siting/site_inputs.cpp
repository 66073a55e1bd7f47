#include "workflows/siting/site_inputs.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/data_extent.hpp>
#include <itin/error.hpp>
#include <viewshed/site_proposal.hpp>
#include <viewshed/turbine_layout.hpp>

#include "workflows/siting/request_rules.hpp"

namespace itin::viewshed {

namespace {

std::string proposed_as(const Proposal& proposal) {
  if (proposal.roof) return proposal.summit ? "highest roof" : "roof by visibility index";
  return proposal.summit ? "summit" : "visibility index";
}

class InputReader {
 public:
  InputReader(const Store& store, const SitePlanRequest& request, std::vector<std::string>& warnings,
              Progress& progress)
      : store_(store), request_(request), warnings_(warnings), progress_(progress) {}

  SiteInputs read() {
    if (request_.search_area) {
      propose();
    } else {
      take_candidates();
    }
    take_remarks(request_.existing);
    leave_out_forbidden();
    leave_out_near_dwellings();
    leave_out_near_existing();
    place_on_ground();
    if (inputs_.options.empty()) throw InputError(nothing_left(), "candidates");
    place_existing();
    add_demand(store_, request_, inputs_, warnings_, progress_);
    return std::move(inputs_);
  }

 private:
  void reject(const std::string& line) { inputs_.left_out.push_back(line); }

  void take_remarks(const SitePlaces& places) {
    inputs_.left_out.insert(inputs_.left_out.end(), places.left_out.begin(), places.left_out.end());
    warnings_.insert(warnings_.end(), places.warnings.begin(), places.warnings.end());
  }

  std::string nothing_left() const {
    if (inputs_.left_out.empty()) return "no candidate is left to choose from";
    return fmt::format("no candidate is left to choose from; the first left out: {}; the data is {}",
                       inputs_.left_out.front(), extent_of(store_.metadata()));
  }

  void propose() {
    if (request_.turbines) {
      for (const Point2 place : spaced_positions(*request_.search_area, request_.spacing))
        add_proposed(place, "spaced");
      return;
    }
    ProposalRequest proposal;
    proposal.spacing = request_.spacing;
    proposal.radius = request_.radius;
    proposal.mast_height = request_.masts.front().height;
    proposal.target_height = request_.demand.height;
    proposal.earth = request_.earth;
    proposal.themes = request_.themes;
    proposal.on_surface = request_.on_surface;
    proposal.targets_on_surface = request_.demand.on_surface;
    for (const Proposal& proposed : propose_sites(store_, *request_.search_area, proposal, progress_))
      add_proposed(proposed.position, proposed_as(proposed));
  }

  void add_proposed(Point2 position, const std::string& why) {
    inputs_.candidates.push_back({{.name = std::to_string(inputs_.candidates.size()), .position = position}, why});
  }

  void take_candidates() {
    take_remarks(request_.candidates);
    for (const SitePlace& place : request_.candidates.places) {
      if (!(place.cost >= 0)) {
        reject(name_of(request_.candidates, "candidate", place) + ": its cost is missing or negative");
      } else if (place.height && *place.height < 0) {
        reject(name_of(request_.candidates, "candidate", place) + ": its height is negative");
      } else {
        inputs_.candidates.push_back({place, {}});
      }
    }
  }

  /// Leaves out the candidates at `unfit` places. `why` tells the reason, and follows a candidate's name. Returns the
  /// number left out.
  template <class Unfit>
  std::size_t leave_out(const std::string& why, const Unfit& unfit) {
    const std::size_t first = inputs_.left_out.size();
    const std::size_t count = std::erase_if(inputs_.candidates, [&](const SiteCandidate& candidate) {
      const bool is_unfit = unfit(candidate.place.position);
      if (is_unfit) reject(fmt::format("candidate {}: {}", candidate.place.name, why));
      return is_unfit;
    });
    if (count > 0) inputs_.barred.push_back({why, first, count});
    return count;
  }

  void leave_out_forbidden() {
    if (!request_.forbidden) return;
    leave_out("lies in a forbidden area", [&](Point2 p) { return request_.forbidden->contains(p); });
  }

  void leave_out_near_dwellings() {
    if (!request_.turbines || !request_.turbines->dwellings) return;
    const SiteDwellings& given = *request_.turbines->dwellings;
    warnings_.insert(warnings_.end(), given.warnings.begin(), given.warnings.end());
    const Dwellings dwellings(given.points, given.polygons);
    const std::size_t left_out = leave_out(fmt::format("stands nearer than {:g} m to a dwelling", given.setback),
                                           [&](Point2 p) { return dwellings.any_within(p, given.setback); });
    if (left_out == 0)
      warnings_.push_back(
          fmt::format("{}: the dwellings keep no candidate away: all stand at least {:g} m from each; check where the "
                      "dwellings are, or leave out `dwellings`",
                      given.source.empty() ? "`dwellings`" : given.source, given.setback));
  }

  /// Leaves out candidates too near existing turbines.
  void leave_out_near_existing() {
    if (!request_.turbines) return;
    const std::vector<SitePlace>& existing = request_.existing.places;
    leave_out("stands too near an existing turbine", [&](Point2 p) {
      return std::any_of(existing.begin(), existing.end(),
                         [&](const SitePlace& site) { return !may_both_stand(request_, p, site.position); });
    });
  }

  std::vector<std::optional<double>> grounds_of(const std::vector<Point2>& positions) const {
    return ground_under(store_, positions, request_.on_surface ? request_.themes : ThemeChoice::none(), progress_);
  }

  /// Places the candidates on their ground, and makes an option of each with every mast.
  void place_on_ground() {
    std::vector<Point2> positions;
    for (const SiteCandidate& candidate : inputs_.candidates) positions.push_back(candidate.place.position);
    const auto ground = grounds_of(positions);
    std::vector<SiteCandidate> kept;
    for (std::size_t i = 0; i < ground.size(); ++i) {
      const SitePlace& place = inputs_.candidates[i].place;
      if (!ground[i]) {
        const bool on = is_on_the_data(place.position, store_.metadata());
        reject(fmt::format("candidate {} at {:.10g},{:.10g}: {}", place.name, place.position.x, place.position.y,
                           on ? "there is no data there" : "it lies off the data"));
        continue;
      }
      add_options(place, kept.size(), *ground[i]);
      kept.push_back(inputs_.candidates[i]);
    }
    inputs_.candidates = std::move(kept);
  }

  void add_options(const SitePlace& place, std::size_t number, double ground) {
    std::vector<Mast> masts = masts_of(request_);
    if (place.height) masts = {{*place.height, masts.front().cost}};
    for (const Mast& mast : masts) {
      if (!(place.cost + mast.cost > 0))
        throw InputError(fmt::format("candidate {}: its cost is 0; costs must be positive", place.name), "candidates");
      inputs_.options.push_back({number, place.cost + mast.cost});
      inputs_.positions.push_back({place.name, place.position, mast.height, ground, sectors_of(place)});
    }
  }

  /// The antennas of a place, completed by that of the request.
  std::vector<SiteSector> sectors_of(const SitePlace& place) const {
    std::vector<SiteSector> sectors = place.sectors;
    for (SiteSector& sector : sectors) sector.antenna = completed(sector.antenna, request_.link_budget.from_antenna);
    return sectors;
  }

  void place_existing() {
    std::vector<Point2> positions;
    for (const SitePlace& site : request_.existing.places) positions.push_back(site.position);
    const auto ground = grounds_of(positions);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const SitePlace& site = request_.existing.places[i];
      const double height = site.height.value_or(masts_of(request_).front().height);
      if (!ground[i] || height < 0) {
        reject(name_of(request_.existing, "existing site", site) +
               (ground[i] ? ": its height is negative" : ": there is no data there"));
      } else {
        inputs_.positions.push_back({site.name, site.position, height, *ground[i], sectors_of(site)});
      }
    }
  }

  const Store& store_;
  const SitePlanRequest& request_;
  std::vector<std::string>& warnings_;
  Progress& progress_;
  SiteInputs inputs_;
};

}  // namespace

SiteInputs understood(const Store& store, const SitePlanRequest& request, std::vector<std::string>& warnings,
                      Progress& progress) {
  return InputReader(store, request, warnings, progress).read();
}

}  // namespace itin::viewshed
