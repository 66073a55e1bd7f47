// itin site: the few best of many sites.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/file_digest.hpp>
#include <itin/new_folder.hpp>
#include <itin/output_file.hpp>
#include <itin/sources_in.hpp>
#include <itin/store.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/siting.hpp>

#include "options/memory_option.hpp"
#include "options/off_the_data.hpp"
#include "options/store_scale.hpp"

#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "program/verb.hpp"
#include "site/joint_coverage.hpp"
#include "site/site_checkpoint.hpp"
#include "site/site_inputs.hpp"
#include "site/site_links.hpp"
#include "site/site_maps.hpp"
#include "site/site_options.hpp"
#include "site/site_outputs.hpp"
#include "site/site_rasters.hpp"
#include "site/site_report.hpp"
#include "site/site_result.hpp"
#include "site/site_tables.hpp"
#include "site/site_warnings.hpp"
#include "site/site_wording.hpp"
#include "site/visible_heights.hpp"

namespace itin::cli {

namespace {

class SiteVerb final : public Verb {
 public:
  std::string name() const override { return "site"; }
  std::string summary() const override {
    return "Choose the few best of many sites, or where turbines are seen least, with proof";
  }
  void declare(CLI::App& app) override { options_.declare(app); }
  void complete() override { options_.apply_parameter_file(); }
  void validate() override { options_.validate(); }
  Document parameters() const override {
    Document parameters = options_.parameters();
    parameters["inputs"] = inputs_document_;
    return parameters;
  }

  Result execute(Progress& progress) override {
    // Files that a killed run has written may be replaced when it is resumed.
    policy_ = options_.policy;
    policy_.overwrite = policy_.overwrite || (options_.resume && std::filesystem::exists(options_.path("site.work")));
    const NewFolder folder(options_.directory);
    outputs_ = site_outputs(options_, policy_);
    const Store store(options_.store, cache_within(options_.memory_bytes));
    options_.earth.take_body_of(store.metadata());
    options_.themes.choice().check(store.metadata().themes);
    inputs_document_ = hash_inputs(progress);
    std::vector<std::string> warnings;
    options_.take_fields(warnings);
    const SiteInputs inputs = read_site_inputs(store, options_, progress);
    require_memory(store, inputs);
    const std::optional<viewshed::SitePosition> hub_position = hub(store, progress);
    viewshed::ChoiceGoal goal = this->goal(store, inputs, hub_position, progress);
    require_enough(inputs);
    viewshed::check_goal(inputs.options, goal);

    const bool heights = options_.placement.sums_heights();
    std::vector<double> heights_m;
    if (heights) heights_m = possible_heights(store, inputs, progress);
    const viewshed::Demand shown(heights_m);
    viewshed::SiteCoverage coverage(store, site_survey(options_, inputs), progress);
    SiteCheckpoint checkpoint(options_.path("site.work"), key(), options_.resume, inputs.positions.size(), coverage,
                              progress);
    coverage.on_refined = [&](std::size_t option, int stage, const viewshed::CoverageBounds& bounds) {
      checkpoint.add(option, stage, bounds);
    };
    SiteResult site{options_, inputs, coverage, heights ? shown : inputs.demand, {}, {}, {}, {}, {}, {}, {}};
    site.choice = heights ? choose_by_heights(inputs, coverage, shown, goal, progress)
                          : choose_by_coverage(store, inputs, coverage, goal, progress);
    coverage.release_surfaces();
    site.network = site_network(store, options_, inputs, site.choice, hub_position, progress);
    site.routes = site_routes(options_, site.network);
    site.ground_m = site_grounds(store, inputs, site.choice, progress);
    const JointCoverage joint = joint_coverage(store, options_, inputs, coverage, site.choice, progress);
    site.undecided = heights ? undecided_heights(store, site, heights_m, progress) : undecided_demand(site, joint);
    site.shares = demand_shares(options_, inputs, joint);
    site.rasters = site_rasters(
        store, options_, inputs, site.choice,
        inputs.targets.grid ? joint : joint_coverage_on_cells(store, options_, inputs, coverage, site.choice, progress),
        progress);
    Result result = write(store, site, std::move(warnings), progress);
    if (checkpoint.restored() > 0)
      result.text += fmt::format("taken over from an earlier run: {}\n", counted(checkpoint.restored(), "result"));
    checkpoint.remove();
    return result;
  }

 private:
  /// Returns how much of its turbine each option may show.
  std::vector<double> possible_heights(const Store& store, const SiteInputs& inputs, Progress& progress) const {
    std::vector<std::size_t> all(inputs.options.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const NoData rule = options_.nodata.rule() == NoData::kBlock ? NoData::kBlock : NoData::kClear;
    return summed_visible_heights(store, {options_, inputs, all, rule}, progress);
  }

  /// Returns how much less the chosen turbines show if ground without data hides all behind it, metres. `possible` has
  /// a value for each option.
  double undecided_heights(const Store& store, const SiteResult& site, const std::vector<double>& possible,
                           Progress& progress) const {
    if (!site.coverage.leaves_open()) return 0;
    std::vector<std::size_t> chosen;
    for (const viewshed::ChosenSite& turbine : site.choice.chosen) chosen.push_back(turbine.option);
    const std::vector<double> certain =
        summed_visible_heights(store, {options_, site.inputs, chosen, NoData::kBlock}, progress);
    double sum = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) sum += possible[chosen[i]] - certain[i];
    return sum;
  }

  /// Returns the demand that ground without data leaves open: of turbines only what may see a chosen one.
  double undecided_demand(const SiteResult& site, const JointCoverage& joint) const {
    viewshed::DemandSet open = joint.undecided;
    if (options_.placement.given()) {
      viewshed::DemandSet possible;
      for (const viewshed::ChosenSite& turbine : site.choice.chosen)
        possible = set_union(possible, site.coverage.bounds(turbine.option).possible);
      open = intersection(open, possible);
    }
    return site.inputs.demand.in_metric(site.inputs.demand.weight(open));
  }

  /// Returns the hash of every file on which the result depends.
  Document hash_inputs(Progress& progress) const {
    Document inputs = Document::array();
    for (const std::string& path : {options_.store, options_.candidates.path, options_.search_area, options_.demand,
                                    options_.existing, options_.forbidden, options_.placement.dwellings}) {
      std::error_code none;
      if (path.empty() || !std::filesystem::is_regular_file(path, none)) continue;
      inputs.push_back({{"path", path}, {"sha256", file_sha256(path, progress)}});
    }
    return inputs;
  }

  /// Checks that the memory holds the maps besides the bounds of all sites. Where demand is points, the maps are of
  /// cells about the sites.
  void require_memory(const Store& store, const SiteInputs& inputs) const {
    const RasterGrid grid =
        inputs.targets.grid ? *inputs.targets.grid
                            : viewshed::grid_of_reach(store, inputs.positions, options_.radius, options_.cell_size());
    const std::uint64_t needed =
        bytes_of_site_maps(store, grid) + viewshed::bytes_of_coverage(site_survey(options_, inputs));
    if (needed <= options_.memory_bytes) return;
    throw InputError(fmt::format(
        "maps of {} cells, and what {} may serve of them, take some {:.2g} GB, more than the {:.2g} GB of --memory: "
        "give a greater --cell, a smaller --radius, fewer sites, or more memory",
        grouped(grid.cell_count()), counted(inputs.positions.size(), "site"), static_cast<double>(needed) / 1e9,
        static_cast<double>(options_.memory_bytes) / 1e9));
  }

  /// Checks that there are as many candidates as turbines; distances between candidates are not considered yet.
  void require_enough(const SiteInputs& inputs) const {
    if (!options_.placement.given() || inputs.candidates.size() >= *options_.count) return;
    std::string why;
    for (const Barred& barred : inputs.barred)
      why += fmt::format("{} each of {} {}", why.empty() ? ":" : ",", counted(barred.count, "other"), barred.why);
    throw Error(
        fmt::format("--count: {} asked for, but only {} may carry a turbine{}; ask for fewer, or give more places",
                    counted(*options_.count, "turbine"), counted(inputs.candidates.size(), "candidate"), why));
  }

  /// Returns a key that differs for runs whose results could differ.
  std::string key() const {
    Document hashes = Document::array();
    for (const Document& input : inputs_document_) hashes.push_back(input.at("sha256"));
    return fmt::format("{} {} {} {}", ITIN_VERSION, json_text(hashes), json_text(options_.parameters()),
                       json_text(earth_document(options_.earth.earth())));
  }

  std::optional<viewshed::SitePosition> hub(const Store& store, Progress& progress) const {
    if (!options_.hub) return std::nullopt;
    const Point2 p = on_the_data("--hub", *options_.hub, options_.in_crs, store.metadata());
    const auto ground = viewshed::ground_under(
        store, {p}, options_.on_surface ? options_.themes.choice() : ThemeChoice::none(), progress);
    if (!ground.front()) throw InputError("--hub: there is no data there; move it onto the data");
    return viewshed::SitePosition{"hub", p, options_.hub->height.value_or(20), *ground.front()};
  }

  /// Returns the goal, except for what existing sites serve. It refers to the inputs.
  viewshed::ChoiceGoal goal(const Store& store, const SiteInputs& inputs,
                            const std::optional<viewshed::SitePosition>& hub_position, Progress& progress) const {
    viewshed::ChoiceGoal goal;
    goal.count = options_.count;
    goal.budget = options_.budget;
    if (options_.share) goal.wanted = 0;
    goal.cover = options_.cover;
    goal.exact_chosen = options_.exact_final;
    goal.swaps = options_.swaps;
    goal.objective = options_.objective();
    if (options_.min_spacing || options_.placement.spacing())
      goal.compatible = [this, &inputs](std::size_t a, std::size_t b) {
        return options_.may_both_stand(inputs.positions[a].position, inputs.positions[b].position);
      };
    if (options_.intervisible) goal.network = link_network(store, options_, inputs, hub_position, progress);
    return goal;
  }

  static void refine_fully(viewshed::SiteCoverage& coverage, std::size_t option) {
    while (!coverage.bounds(option).exact) coverage.refine({&option, 1});
  }

  /// Returns what each existing site certainly serves of the demand.
  std::vector<viewshed::DemandSet> existing_coverage(const Store& store, const SiteInputs& inputs,
                                                     viewshed::SiteCoverage& coverage, Progress& progress) const {
    std::vector<viewshed::DemandSet> served;
    if (coverage.leaves_open() && options_.open_targets() == viewshed::OpenTargets::kServed) {
      coverage.release_surfaces();  // --memory holds those of one survey
      served = served_by_existing(store, options_, inputs, progress);
    } else {
      for (std::size_t i = inputs.options.size(); i < inputs.positions.size(); ++i) {
        refine_fully(coverage, i);
        served.push_back(coverage.bounds(i).certain);
      }
    }
    if (!inputs.cells.empty())
      for (viewshed::DemandSet& set : served) set = intersection(set, inputs.cells);
    return served;
  }

  /// Chooses by coverage of the demand that existing sites do not certainly serve.
  viewshed::Choice choose_by_coverage(const Store& store, const SiteInputs& inputs, viewshed::SiteCoverage& coverage,
                                      viewshed::ChoiceGoal& goal, Progress& progress) const {
    coverage.explore();
    goal.existing = existing_coverage(store, inputs, coverage, progress);
    if (options_.share) goal.wanted = wanted(inputs, goal);
    return viewshed::choose(inputs.demand, inputs.options, coverage, goal, progress);
  }

  /// Chooses by the heights shown; coverage is for the maps alone.
  static viewshed::Choice choose_by_heights(const SiteInputs& inputs, viewshed::SiteCoverage& coverage,
                                            const viewshed::Demand& shown, const viewshed::ChoiceGoal& goal,
                                            Progress& progress) {
    OwnElements own(inputs.options.size());
    viewshed::Choice choice = viewshed::choose(shown, inputs.options, own, goal, progress);
    for (const viewshed::ChosenSite& chosen : choice.chosen) refine_fully(coverage, chosen.option);
    for (std::size_t i = inputs.options.size(); i < inputs.positions.size(); ++i) refine_fully(coverage, i);
    return choice;
  }

  /// Returns the value wanted. The share is of all demand, and the demand that existing sites serve counts towards it.
  viewshed::Weight wanted(const SiteInputs& inputs, const viewshed::ChoiceGoal& goal) const {
    const viewshed::Weight all = inputs.demand.at_least(*options_.share * inputs.demand.in_metric(inputs.total));
    return std::max<viewshed::Weight>(0, all - viewshed::served_by(inputs.demand, goal.existing, goal.cover));
  }

  /// Writes the outputs. `warnings` are those about the input files.
  Result write(const Store& store, const SiteResult& site, std::vector<std::string> warnings, Progress& progress) {
    const std::string& crs = store.metadata().crs_wkt;
    Result result;
    result.warnings = std::move(warnings);
    warn_of(site, store, result.warnings);
    warn_of_grid(store.metadata(), result.warnings);
    result.document = site_document(site, store.metadata());
    for (const SiteOutput& output : outputs_)
      result.document["outputs"].push_back({{"path", output.path}, {"what", output.what}});
    write_site_maps(store, site, policy_.overwrite, progress, result.warnings);
    write_site_rasters(site, crs, json_text(parameters()), policy_.overwrite);
    write_site_tables(site, policy_.overwrite);
    write_site_layers(site, crs, policy_.overwrite);
    const auto profiles = write_site_profiles(store, site, policy_.overwrite, progress);
    for (const SiteProfile& profile : profiles)
      result.document["outputs"].push_back({{"path", profile.path}, {"what", "profile of the link " + profile.what}});
    const std::vector<SourceInfo> sources = sources_in(store, looked_at(site), options_.themes.choice());
    result.document["sources"] = sources_document(sources);
    const std::vector<std::string> in_words = described(sources, store.metadata());
    write_site_sheets(store, site, in_words, policy_.overwrite, progress);
    write_site_report(site, {site_figures(store, site, progress), profiles, parameters(), in_words}, policy_.overwrite);
    if (policy_.overwrite) remove_former_outputs(options_, result.document["outputs"]);
    Document whole = call_document(*this);
    whole.update(result.document);
    write_file(options_.path("site.json"), json_text(whole, 2) + "\n", policy_.overwrite);
    Document given = options_.given();
    given["inputs"] = inputs_document_;
    write_file(options_.path("parameters.json"), json_text(given, 2) + "\n", policy_.overwrite);
    result.document["statistics"] = viewshed::statistics_document(site.coverage.statistics());
    result.text = text(site, result.document["outputs"].size());
    return result;
  }

  /// The box that all sight lines between sites and to targets lie in.
  Box looked_at(const SiteResult& site) const {
    Box box = site.rasters.grid.bounds();
    for (const viewshed::SitePosition& place : site.inputs.positions) box.extend(place.position);
    for (const LinkEnd& end : site.network.ends) box.extend(end.place.position);
    const viewshed::SiteTargets& targets = site.inputs.targets;
    if (targets.grid) return box;
    for_each_element(viewshed::within_reach(targets, site.inputs.positions, options_.radius),
                     [&](std::size_t point) { box.extend(targets.points[point]); });
    return box;
  }

  std::string outcome(const SiteResult& site) const {
    if (options_.placement.given()) return least_in_words(site) + "\n";
    return fmt::format(
        "{0}served: {1:.10g} of {2:.10g} ({3:.1f} %){4}; no choice {0}serves more than {5:.10g} (gap {6:.1f} %)\n",
        certainly(site), site.served(), site.in_metric(site.inputs.total), site.served_percent(),
        site.choice.existing > 0
            ? fmt::format(", {:.10g} of it by existing sites", site.in_metric(site.choice.existing))
            : "",
        site.in_metric(site.choice.upper_bound + site.choice.existing), viewshed::gap_percent(site.choice));
  }

  std::string text(const SiteResult& site, std::size_t files) const {
    const bool places_turbines = options_.placement.given();
    std::string text = fmt::format("{:<16} {:>12} {:>12}  {:>7}  {:<11} {}\n", places_turbines ? "turbine" : "site",
                                   "easting", "northing", places_turbines ? "height" : "mast", "adds", "together");
    for (const viewshed::ChosenSite& chosen : site.choice.chosen) {
      const viewshed::SitePosition& place = site.place_of(chosen);
      text +=
          fmt::format("{:<16} {:>12.2f} {:>12.2f}  {:>5g} m  +{:<10.10g} {:.10g}\n", place.name, place.position.x,
                      place.position.y, place.height, site.in_metric(chosen.gain), site.in_metric(chosen.cumulative));
    }
    text += options_.heights_text() + outcome(site);
    if (site.undecided > 0) text += "undecided: " + undecided_in_words(site) + "\n";
    const std::size_t candidates = site.inputs.candidates.size(), options = site.inputs.options.size();
    text += counted(candidates, "candidate");
    if (options != candidates) text += fmt::format(", {} with their masts", counted(options, "option"));
    text += site.all_exact() ? ", all surveyed exactly"
                             : fmt::format(", {} surveyed more closely", grouped(site.refined()));
    text += fmt::format("; {} left out\n", grouped(site.inputs.rejected.size()));
    if (options_.hub) text += routes_text(site);
    return text + fmt::format("{}: {}; open report.html\n", options_.directory, counted(files, "file"));
  }

  static std::string routes_text(const SiteResult& site) {
    std::size_t reached = 0, hops = 0;
    for (const SiteRoute& route : site.routes) reached += !route.hops.empty(), hops = std::max(hops, route.hops.size());
    return fmt::format("routes to the hub: {} of {}, of at most {}\n", reached, counted(site.routes.size(), "site"),
                       counted(hops, "hop"));
  }

  SiteOptions options_;
  OutputPolicy policy_;
  std::vector<SiteOutput> outputs_;
  Document inputs_document_ = Document::array();
};

}  // namespace

std::unique_ptr<Verb> make_site_verb() {
  return std::make_unique<SiteVerb>();
}

}  // namespace itin::cli
