// itin los: line-of-sight verdicts and reports.

#include <algorithm>
#include <filesystem>
#include <span>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>
#include <profile/los.hpp>
#include <profile/profile.hpp>
#include <viewshed/map_image.hpp>

#include "los/los_case.hpp"
#include "los/los_links.hpp"
#include "los/los_people.hpp"
#include "los/los_query.hpp"
#include "los/los_reports.hpp"
#include "los/los_store.hpp"
#include "options/memory_option.hpp"
#include "options/radio/budget_options.hpp"
#include "options/radio/earth_options.hpp"
#include "options/radio/radio_options.hpp"
#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

class LosVerb final : public Verb {
 public:
  std::string name() const override { return "los"; }
  std::string summary() const override { return "Say whether two points see each other, and report why"; }

  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store (not with --profile-csv)"));
    line_.declare(app);
    begin_group(app, "A given profile");
    reads(app.add_option("--profile-csv", profile_csv_, "Work on this profile instead of a store: d_km,h_m[,clutter_m]")
              ->type_name("FILE"));
    app.add_option("--heights", heights_text_, "Heights of the two ends above that profile")->type_name("h1,h2");
    links_.declare(app);
    earth_.declare(app);
    earth_.declare_radius(app);
    radio_.declare(app);
    budget_.declare(app, {});
    reports_.declare(app);
    people_.declare(app);
    policy_.declare(app);
    line_.declare_memory(app);
  }

  void validate() override {
    earth_.validate();
    radio_.validate();
    budget_.validate();
    people_.validate(links_.given());
    if (links_.given()) {
      if (store_.empty() || line_.given())
        throw InputError("--links needs a STORE; leave out --from and --to, whose place it takes");
      reports_.validate_links();
      links_.validate(radio_.object());
      line_.validate_surface();
    } else {
      validate_line();
    }
    query_ = query_of(earth_, radio_, budget_, people_);
    if (links_.given()) {
      budget_.require_for_links();
    } else {
      budget_.require_frequency(query_.radio);
    }
  }

  Document parameters() const override {
    Document parameters = Document::object();
    if (store_.empty()) {
      parameters["profile_csv"] = profile_csv_;
      parameters["heights_m"] = heights_;
    } else {
      parameters["store"] = store_;
      if (links_.given()) parameters.update(links_.parameters());
      parameters.update(links_.given() ? line_.surface_parameters() : line_.parameters());
    }
    parameters.update(radio_.parameters());
    parameters.update(budget_.parameters());
    parameters.update(people_.parameters());
    return parameters;
  }

  Result execute(Progress& progress) override {
    if (links_.given()) return run_links(progress);
    for (const std::string& path : reports_.paths()) policy_.require_writable(path);
    LosCase one = store_.empty() ? run_profile() : run_store(progress);
    if (query_.radio) warn_of_refraction(query_.radio->effective_earth_km, one.result);
    reports_.write(one, command(), reports_.paths(), policy_.overwrite);
    one.result.document["outputs"] = reports_.paths();
    one.result.text = text_of(one.report);
    if (!one.foliage_text.empty()) one.result.text += one.foliage_text + "\n";
    return std::move(one.result);
  }

 private:
  void validate_line() {
    if (store_.empty() == profile_csv_.empty()) throw InputError("give a STORE with --from and --to, or --profile-csv");
    if (store_.empty()) {
      line_.require_none();
      if (heights_text_.empty()) throw InputError("--profile-csv needs --heights h1,h2");
      heights_ = parse_tuple("--heights", heights_text_, 2, "h1,h2");
      for (const double height : heights_) require_height(height, "--heights");
      if (heights_[0] < 0 || heights_[1] < 0)
        throw InputError("--heights: a height must not be negative; 0 is the ground itself");
    } else {
      if (!heights_text_.empty())
        throw InputError("--heights works only with --profile-csv; give heights in --from, --to");
      line_.validate(radio_.object() ? std::optional(radio_.object()->tip_m) : std::nullopt);
    }
    links_.require_none();
    radio_.require_frequency();
    reports_.validate(!store_.empty());
  }

  Document command() const {
    Document command{{"verb", name()}};
    command.update(parameters());
    return command;
  }

  LosHeader header() const {
    return {reports_.title(), people_.facts(), people_.from_name(), people_.to_name(), reports_.table_spacing_m()};
  }
  LosHeader header(const profile::Link& link) const {
    return {reports_.title(link.id), people_.facts(), link.from_name, link.to_name, reports_.table_spacing_m()};
  }

  void add_map(const Store& store, std::span<const profile::Link> others, LosCase& one, Progress& progress) const {
    one.report.location =
        viewshed::location_map(store, one.report, {.others = others, .themes = line_.themes()}, progress);
  }

  LosCase run_profile() {
    query_.from_height_m = heights_[0], query_.to_height_m = heights_[1];
    query_.points_as_given = true;
    std::vector<std::string> warnings;
    profile::LosReport report = profile::analyse(profile::read_profile_csv(profile_csv_, warnings), query_);
    report.facts = {{"Profile", fmt::format("{}, {}", std::filesystem::path(profile_csv_).filename().string(),
                                            counted(report.profile.points.size(), "point"))}};
    for (const auto& [end, lines] :
         {std::pair(report.from, &report.from_lines), std::pair(report.to, &report.to_lines)}) {
      *lines = {fmt::format("ground {:.2f} m, height {:.2f} m, elevation {:.2f} m", end.ground_m, end.height_m,
                            end.elevation_m),
                fmt::format("elevation angle {:.3f}\xC2\xB0", end.elevation_angle_deg)};
    }
    LosCase one = los_case(std::move(report), header());
    one.result.warnings.insert(one.result.warnings.begin(), warnings.begin(), warnings.end());
    return one;
  }

  LosCase run_store(Progress& progress) {
    const Store store(store_, cache_within(line_.memory_bytes()));
    line_.complete(store, progress);
    earth_.take_body_of(store.metadata());
    query_ = query_of(earth_, radio_, budget_, people_);
    LosCase one = los_case(store, line_.run(store, query_), header());
    if (reports_.show_location()) add_map(store, {}, one, progress);
    warn_of_grid(store.metadata(), one.result.warnings);
    warn_of_date(one.result);
    return one;
  }

  Result run_links(Progress& progress) {
    for (const std::string& output : links_.outputs()) policy_.require_writable(output);
    const Store store(store_, cache_within(line_.memory_bytes()));
    line_.complete(store, progress);
    earth_.take_body_of(store.metadata());
    query_ = query_of(earth_, radio_, budget_, people_);
    profile::LinkTable table = links_.table(store, line_);
    const bool radio = query_.radio || std::any_of(table.links.begin(), table.links.end(),
                                                   [](const profile::Link& l) { return l.frequency_ghz.has_value(); });
    if (query_.budget.asks() && !radio) throw InputError("a link budget needs a --frequency, or a column frequency");
    std::vector<LosReports::Job> jobs = reports_.jobs(table.links, policy_);
    const profile::LinkSurvey survey =
        profile::survey_link_table(store, std::move(table), LosLinks::query(query_, line_), progress);
    profile::LinkFileOptions files{reports_.title(), people_.facts(), policy_.overwrite};
    if (links_.writes_pages()) files.map = viewshed::links_map(store, survey, files.title, progress);
    profile::write_link_table(survey, links_.outputs(), files);
    Result result = links_.result_of(survey);
    const std::vector<profile::Link>& links = survey.table.links;
    if (radio) warn_of_refraction(profile::effective_earth_km(query_.earth), result);
    warn_of_grid(store.metadata(), result.warnings);
    warn_of_date(result);
    // A link without a verdict has no report; the table says why.
    std::erase_if(jobs, [&](const LosReports::Job& job) { return !survey.results[job.link].found; });
    const auto work = [&](std::size_t i) {
      const profile::Link& link = links[i];
      const LosStoreOptions::Ends ends{link.from, link.to, link.from_height, link.to_height};
      LosCase one = los_case(store, line_.run(store, profile::los_query(link, survey.query), ends), header(link));
      NoProgress quiet;  // reports are made side by side
      if (reports_.show_location()) add_map(store, links, one, quiet);
      one.result.document["link"] = link.id;
      return one;
    };
    reports_.write_all(jobs, work, command(), policy_.overwrite, progress, result);
    return result;
  }

  void warn_of_date(Result& result) const {
    const std::string warning = people_.warning();
    if (!warning.empty()) result.warnings.push_back(warning);
  }

  void warn_of_refraction(double effective_earth_km, Result& result) const {
    if (!earth_.is_default()) return;
    result.warnings.push_back(
        fmt::format("the refraction is that of light, with an effective Earth of {:.0f} km; radio links are usually "
                    "planned with --effective-earth 4/3",
                    effective_earth_km));
  }

  std::string store_, profile_csv_, heights_text_;
  std::vector<double> heights_;
  LosStoreOptions line_;
  LosLinks links_;
  LosReports reports_;
  LosPeople people_;
  EarthOptions earth_;
  RadioOptions radio_;
  BudgetOptions budget_;
  OutputPolicy policy_;
  profile::LosQuery query_;
};

}  // namespace

std::unique_ptr<Verb> make_los_verb() {
  return std::make_unique<LosVerb>();
}

}  // namespace itin::cli
