// itin site: the few best of many sites.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <itin/document.hpp>
#include <itin/file_digest.hpp>
#include <itin/new_folder.hpp>
#include <itin/output_file.hpp>
#include <itin/sources_in.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/site_document.hpp>
#include <viewshed/site_plan.hpp>
#include <viewshed/site_tasks.hpp>

#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "program/verb.hpp"
#include "site/site_checkpoint.hpp"
#include "site/site_maps.hpp"
#include "site/site_options.hpp"
#include "site/site_outputs.hpp"
#include "site/site_profiles.hpp"
#include "site/site_report.hpp"
#include "site/site_request.hpp"
#include "site/site_wording.hpp"

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

  std::unique_ptr<viewshed::Tasks> divide(std::uint64_t most_sites, Progress& progress) override {
    if (options_.resume) throw InputError("--resume goes on with a run by itself, and a job divides it; leave it out");
    std::vector<std::string> warnings;
    open_store(warnings, progress);
    return std::make_unique<viewshed::SiteTasks>(*opened_, complete_request(options_, opened_->metadata()), most_sites,
                                                 progress);
  }
  void take_answers(viewshed::Tasks& answered) override { answered_ = &dynamic_cast<viewshed::SiteTasks&>(answered); }

  Result execute(Progress& progress) override {
    // Files that a killed run has written may be replaced when it is resumed.
    policy_ = options_.policy;
    policy_.overwrite = policy_.overwrite || (options_.resume && was_killed());
    if (options_.resume) require_unfinished();
    const NewFolder folder(options_.directory);
    outputs_ = site_outputs(options_, policy_);
    Result result;
    open_store(result.warnings, progress);
    inputs_document_ = hash_inputs(progress);
    if (answered_ != nullptr) {
      write(answered_->take(progress), result, progress);
    } else {
      plan_and_write(result, progress);
    }
    return result;
  }

 private:
  /// Opens the store, and completes the options by what it and the files of places say.
  void open_store(std::vector<std::string>& warnings, Progress& progress) {
    const Store& store = opened_.emplace(options_.store, cache_within(options_.request.memory_bytes));
    options_.earth.take_body_of(store.metadata());
    options_.themes.choice().check(store.metadata().themes);
    options_.themes.complete(store, progress);
    options_.request.themes = options_.themes.choice();
    options_.take_posting(store.metadata());
    options_.take_fields(warnings);
  }

  /// Makes the plan, from what an earlier run has found where it is resumed, and writes it.
  void plan_and_write(Result& result, Progress& progress) {
    viewshed::SitePlanRequest request = complete_request(options_, opened_->metadata());
    std::optional<SiteCheckpoint> checkpoint;
    request.on_survey = [&](viewshed::SiteCoverage& coverage, std::size_t sites) {
      checkpoint.emplace(options_.path("site.work"), key(), options_.resume, sites, coverage, progress);
      coverage.on_refined = [&](std::size_t option, int stage, const viewshed::CoverageBounds& bounds) {
        checkpoint->add(option, stage, bounds);
      };
    };
    write(plan_sites(*opened_, std::move(request), progress), result, progress);
    if (checkpoint->restored() > 0)
      result.text += fmt::format("taken over from an earlier run: {}\n", counted(checkpoint->restored(), "result"));
    checkpoint->remove();
  }

  /// Tells whether the folder has the results of a run that has not ended.
  bool was_killed() const { return std::filesystem::exists(options_.path("site.work")); }

  void require_unfinished() const {
    const std::string document = options_.path("site.json");
    if (!policy_.overwrite && !was_killed() && std::filesystem::exists(document))
      throw FileError(document,
                      "the run has finished, and --resume has nothing to go on with; give --overwrite to run it again");
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

  /// Returns a key that differs for runs whose results could differ.
  std::string key() const {
    Document hashes = Document::array();
    for (const Document& input : inputs_document_) hashes.push_back(input.at("sha256"));
    return fmt::format("{} {} {} {}", ITIN_VERSION, json_text(hashes), json_text(options_.parameters()),
                       json_text(earth_document(options_.earth.earth())));
  }

  /// Adds the library's warnings, in the words of the command line.
  void warn(const Store& store, const viewshed::SitePlan& plan, std::vector<std::string>& warnings) const {
    if (options_.request.frequency_ghz) options_.earth.warn_of_light(warnings);
    for (std::string warning : plan.warnings) {
      constexpr std::string_view kLeftOut = "`left_out`";
      if (const std::size_t at = warning.find(kLeftOut); at != std::string::npos)
        warning.replace(at, kLeftOut.size(), options_.path("site.json"));
      warnings.push_back(std::move(warning));
    }
    warn_of_grid(store.metadata(), warnings);
  }

  /// Adds the tables that depend on what the demand was read from, of which the options do not tell.
  void complete_outputs(const viewshed::SitePlan& site) {
    for (const viewshed::PlanFile& file : viewshed::site_plan_files(options_.directory, site.request)) {
      const auto same = [&](const viewshed::PlanFile& known) { return known.path == file.path; };
      if (std::any_of(outputs_.begin(), outputs_.end(), same)) continue;
      policy_.claim(file.path);
      outputs_.push_back(file);
    }
  }

  /// Writes the outputs and tells about them.
  void write(const viewshed::SitePlan& site, Result& result, Progress& progress) {
    const Store& store = *opened_;
    warn(store, site, result.warnings);
    result.document = site_document(site, store.metadata());
    if (site.leaves_open) result.document["undecided"]["decided_by"] = kDecidesMissingGround;
    complete_outputs(site);
    result.document["outputs"] = viewshed::outputs_document(outputs_);
    write_site_plan(options_.directory, site, store, progress,
                    {.metadata = {{"itin", ITIN_VERSION}, {"parameters", json_text(parameters())}},
                     .overwrite = policy_.overwrite,
                     .sheets = options_.sheets.choice()});
    const auto profiles = write_site_profiles(store, site, options_.path(kLinkFolder), policy_.overwrite, progress);
    for (const SiteProfile& profile : profiles)
      result.document["outputs"].push_back({{"path", profile.path}, {"what", "profile of the link " + profile.what}});
    const std::vector<SourceInfo> sources = sources_in(store, looked_at(site), options_.themes.choice());
    result.document["sources"] = sources_document(sources);
    const std::vector<std::string> in_words = described(sources, store.metadata());
    write_site_sheets(store, options_, site, in_words, policy_.overwrite, progress);
    write_site_report(options_.path("report.html"), site,
                      {site_figures(store, site, progress), profiles, parameters(), in_words}, policy_.overwrite);
    if (policy_.overwrite) remove_former_outputs(options_, result.document["outputs"]);
    Document whole = call_document(*this);
    whole.update(result.document);
    write_file(options_.path("site.json"), json_text(whole, 2) + "\n", policy_.overwrite);
    Document given = options_.given();
    given["inputs"] = inputs_document_;
    write_file(options_.path("parameters.json"), json_text(given, 2) + "\n", policy_.overwrite);
    result.document["statistics"] = viewshed::statistics_document(site.statistics);
    result.text = text(site, result.document["outputs"].size());
  }

  /// The box that all sight lines between sites and to targets lie in.
  Box looked_at(const viewshed::SitePlan& site) const {
    Box box = site.rasters.grid.bounds();
    for (const viewshed::SitePosition& place : site.inputs.positions) box.extend(place.position);
    for (const viewshed::LinkEnd& end : site.network.ends) box.extend(end.place.position);
    const viewshed::SiteTargets& targets = site.inputs.targets;
    if (targets.grid) return box;
    for_each_element(viewshed::within_reach(targets, site.inputs.positions, options_.request.radius),
                     [&](std::size_t point) { box.extend(targets.points[point]); });
    return box;
  }

  std::string outcome(const viewshed::SitePlan& site) const {
    if (options_.placement.given()) return least_in_words(site) + "\n";
    return fmt::format(
        "{0}served: {1:.10g} of {2:.10g} ({3:.1f} %){4}; no choice {0}serves more than {5:.10g} (gap {6:.1f} %)\n",
        certainly(site), site.served(), site.in_metric(site.inputs.total), site.served_percent(),
        site.choice.existing > 0
            ? fmt::format(", {:.10g} of it by existing sites", site.in_metric(site.choice.existing))
            : "",
        site.in_metric(site.choice.upper_bound + site.choice.existing), viewshed::gap_percent(site.choice));
  }

  std::string text(const viewshed::SitePlan& site, std::size_t files) const {
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
    if (const std::string cost = cost_in_words(site); !cost.empty()) text += cost + "\n";
    if (site.undecided > 0) text += "undecided: " + undecided_in_words(site) + "\n";
    const std::size_t candidates = site.inputs.candidates.size(), options = site.inputs.options.size();
    text += counted(candidates, "candidate");
    if (options != candidates) text += fmt::format(", {} with their masts", counted(options, "option"));
    text += site.all_exact() ? ", all surveyed exactly"
                             : fmt::format(", {} surveyed more closely", grouped(site.refined()));
    text += fmt::format("; {} left out\n", grouped(site.inputs.left_out.size()));
    if (options_.hub) text += routes_text(site);
    return text + fmt::format("{}: {}; open report.html\n", options_.directory, counted(files, "file"));
  }

  static std::string routes_text(const viewshed::SitePlan& site) {
    std::size_t reached = 0, hops = 0;
    for (const viewshed::SiteRoute& route : site.routes)
      reached += !route.hops.empty(), hops = std::max(hops, route.hops.size());
    return fmt::format("routes to the hub: {} of {}, of at most {}\n", reached, counted(site.routes.size(), "site"),
                       counted(hops, "hop"));
  }

  SiteOptions options_;
  std::optional<Store> opened_;
  viewshed::SiteTasks* answered_ = nullptr;  ///< what others have found, in place of computing it
  OutputPolicy policy_;
  std::vector<viewshed::PlanFile> outputs_;
  Document inputs_document_ = Document::array();
};

}  // namespace

std::unique_ptr<Verb> make_site_verb() {
  return std::make_unique<SiteVerb>();
}

}  // namespace itin::cli
