// itin los: line-of-sight verdicts and reports.

#include <filesystem>
#include <set>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/store.hpp>
#include <profile/los.hpp>
#include <profile/profile_csv.hpp>
#include <profile/report.hpp>

#include "earth_options.hpp"
#include "los_document.hpp"
#include "los_links.hpp"
#include "los_store.hpp"
#include "output_path.hpp"
#include "radio_options.hpp"
#include "store_document.hpp"
#include "values.hpp"
#include "verb.hpp"

namespace itin::cli {

namespace {

std::string optional_metres(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f} m", *value) : "none is enough";
}

std::string text_of(const profile::LosReport& report) {
  std::string text = fmt::format("{}, {:.1f} m", name_of(report.verdict), report.profile.length_m);
  if (report.clearance_m && report.critical) {
    text += fmt::format("; least clearance {:.2f} m at {:.1f} m ({})", *report.clearance_m, report.critical->distance_m,
                        cause_of(report, report.critical->theme, report.critical->feature));
  }
  text += "\n";
  for (const profile::Obstruction& o : report.obstructions) {
    text += fmt::format("obstructed from {:.1f} to {:.1f} m, {:.2f} m deep at {:.1f} m ({})\n", o.from_m, o.to_m,
                        o.depth_m, o.peak_at_m, cause_of(report, o.theme, o.feature));
  }
  for (const profile::CriterionResult& c : report.criteria) {
    text += fmt::format("K = {:.4g}, {:g} F1: {}", c.criterion.k, c.criterion.fraction, name_of(c.verdict));
    if (c.clearance_f1) text += fmt::format(", {:.3f} F1", *c.clearance_f1);
    text += "\n";
  }
  for (const profile::NamedHeights& r : report.required) {
    text +=
        fmt::format("for {}: first end {}, second end {}, both {}\n", r.name, optional_metres(r.heights.from_alone_m),
                    optional_metres(r.heights.to_alone_m), optional_metres(r.heights.both_equal_m));
  }
  if (report.losses) {
    const profile::PathLosses& l = *report.losses;
    text += fmt::format("free space {:.1f} dB, diffraction (delta-Bullington) {:.1f} dB; least clearance {:.2f} F1\n",
                        l.free_space_db, l.ld_db, report.fresnel ? report.fresnel->fraction : 0);
  }
  if (report.visible) {
    text +=
        fmt::format("of the object at the second end {:.1f} m are seen ({:.0f} %), up to its hub {:.1f} m ({:.0f} %)\n",
                    report.visible->tip_visible_m, 100 * report.visible->tip_fraction, report.visible->hub_visible_m,
                    100 * report.visible->hub_fraction);
  }
  return text + report.query.earth.convention() + "\n";
}

class LosVerb final : public Verb {
 public:
  std::string name() const override { return "los"; }
  std::string summary() const override { return "Say whether two points see each other, and report why"; }

  void declare(CLI::App& app) override {
    app.add_option("STORE", store_, "The store (not with --profile-csv)");
    line_.declare(app);
    app.add_option("--profile-csv", profile_csv_, "Work on this profile instead of a store: d_km,h_m[,clutter_m]")
        ->type_name("FILE");
    app.add_option("--heights", heights_text_, "Heights of the two ends above that profile")->type_name("h1,h2");
    links_.declare(app);
    earth_.declare(app);
    earth_.declare_radius(app);
    radio_.declare(app);
    app.add_option(
           "--report", reports_,
           "Write the report, as its ending says: .json .csv .svg .pdf .png .html .kml .gpkg; may be given again. With "
           "--links one for each: {id} in the name stands for the link's")
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--title", title_, "The report's title")->type_name("TEXT");
    policy_.declare(app);
  }

  void validate() override {
    earth_.validate();
    radio_.validate();
    if (links_.given()) {
      if (store_.empty() || line_.given()) throw InputError("--links takes a STORE, and the place of --from and --to");
      for (const std::string& path : reports_) {
        profile::require_report_format(path, true);
        if (path.find(kId) == std::string::npos)
          throw InputError(
              fmt::format("--report '{}': with --links give each link a file of its own, such as "
                          "reports/{}.pdf",
                          path, kId));
      }
      links_.validate();
      line_.validate_surface();
      query_.earth = earth_.earth();
      query_.radio = radio_.radio(query_.earth);
      query_.criteria = radio_.criteria();
      return;
    }
    if (store_.empty() == profile_csv_.empty()) throw InputError("give a STORE with --from and --to, or --profile-csv");
    if (store_.empty()) {
      if (line_.given()) throw InputError("--from and --to take a STORE; with --profile-csv give --heights h1,h2");
      if (heights_text_.empty()) throw InputError("--profile-csv takes --heights h1,h2");
      heights_ = parse_tuple("--heights", heights_text_, 2, "h1,h2");
      if (heights_[0] < 0 || heights_[1] < 0) throw InputError("--heights: a height must not be negative");
    } else {
      if (!heights_text_.empty())
        throw InputError("--heights is of use with --profile-csv; give heights in --from, --to");
      line_.validate(radio_.object() ? std::optional(radio_.object()->tip_m) : std::nullopt);
    }
    for (const std::string& path : reports_) profile::require_report_format(path, !store_.empty());
    query_.earth = earth_.earth();
    query_.radio = radio_.radio(query_.earth);
    query_.criteria = radio_.criteria();
    query_.object = radio_.object();
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
    return parameters;
  }

  Result execute(Progress& progress) override {
    if (links_.given()) return run_links(progress);
    for (const std::string& path : reports_) policy_.require_writable(path);
    Result result = store_.empty() ? run_profile() : run_store();
    add_warnings(result);
    write_reports(result, reports_);
    result.document["outputs"] = reports_;
    result.text = text_of(report_);
    return result;
  }

 private:
  /// Of a link, in names of files.
  static constexpr const char* kId = "{id}";

  void write_reports(const Result& result, const std::vector<std::string>& paths) const {
    Document whole{{"itin", ITIN_VERSION}, {"command", {{"verb", name()}}}};
    whole["command"].update(parameters());
    whole.update(result.document);
    whole["warnings"] = result.warnings;
    for (const std::string& path : paths) profile::write_report(report_, whole.dump(2) + "\n", path, policy_.overwrite);
  }

  Result run_profile() {
    query_.from_height_m = heights_[0], query_.to_height_m = heights_[1];
    query_.points_as_given = true;
    report_ = profile::analyse(profile::read_profile_csv(profile_csv_), query_);
    LosEnd from, to;
    from.ground_m = report_.stands_on.from_m, to.ground_m = report_.stands_on.to_m;
    from.height_m = heights_[0], to.height_m = heights_[1];
    from.elevation_angle_deg = report_.elevation_angle_from_deg;
    to.elevation_angle_deg = report_.elevation_angle_to_deg;
    report_.facts = {{"Profile", fmt::format("{}, {} points", std::filesystem::path(profile_csv_).filename().string(),
                                             report_.profile.points.size())}};
    for (const auto& [end, lines] : {std::pair(from, &report_.from_lines), std::pair(to, &report_.to_lines)}) {
      *lines = {fmt::format("ground {:.2f} m, height {:.2f} m, elevation {:.2f} m", end.ground_m, end.height_m,
                            end.ground_m + end.height_m),
                fmt::format("elevation angle {:.3f}\xC2\xB0", end.elevation_angle_deg)};
    }
    Result result;
    result.document["crs"] = nullptr;
    complete(result, from, to);
    return result;
  }

  Result run_links(Progress& progress) {
    policy_.require_writable(links_.output());
    const Store store(store_);
    const std::vector<profile::Link> links = links_.links(store, line_);
    const std::vector<std::vector<std::string>> reports = reports_of(links);
    Result result = links_.run(store, links, line_, query_, policy_.overwrite, progress);
    result.document["refraction"] = earth_.document();
    add_warnings(result);
    for (std::size_t i = 0; i < links.size() && !reports_.empty(); ++i) {
      progress.throw_if_cancelled();
      progress.report("reports", static_cast<double>(i) / static_cast<double>(links.size()));
      report_link(store, links[i], reports[i], result);
    }
    return result;
  }

  /// The files of each link's reports. Throws InputError where two would be one, FileError where one cannot be written.
  std::vector<std::vector<std::string>> reports_of(const std::vector<profile::Link>& links) const {
    std::vector<std::vector<std::string>> result(links.size());
    std::set<std::string> names;
    for (std::size_t i = 0; i < links.size(); ++i) {
      for (std::string path : reports_) {
        path.replace(path.find(kId), std::string_view(kId).size(), file_name(links[i].id));
        if (!names.insert(path).second)
          throw InputError(fmt::format("--report: two links' reports would be {}; give links different ids", path));
        policy_.require_writable(path);
        result[i].push_back(std::move(path));
      }
    }
    return result;
  }

  /// A link without a verdict has no report; the table says why.
  void report_link(const Store& store, const profile::Link& link, const std::vector<std::string>& paths,
                   Result& result) {
    Result one;
    try {
      one = run_line(store, line_.run(store, query_, {link.from, link.to, link.from_height, link.to_height}));
    } catch (const InputError&) {
      return;
    }
    if (title_.empty()) report_.title = "Line-of-sight report: " + link.id;
    one.document["link"] = link.id;
    write_reports(one, paths);
    for (const std::string& path : paths) result.document["outputs"].push_back(path);
  }

  Result run_store() {
    const Store store(store_);
    return run_line(store, line_.run(store, query_));
  }

  Result run_line(const Store& store, LosStoreOptions::Result line) {
    report_ = std::move(line.report);
    Result result;
    result.warnings = std::move(line.warnings);
    result.document["crs"] = crs_identifier(store.metadata().crs_wkt);
    result.document["surface"] = std::move(line.surface);
    complete(result, line.from, line.to);
    result.document["statistics"] = {{"points_read", line.statistics.points_read},
                                     {"blocks_read", line.statistics.blocks_read},
                                     {"triangles", line.triangles}};
    return result;
  }

  void complete(Result& result, const LosEnd& from, const LosEnd& to) {
    report_.title = title_.empty() ? "Line-of-sight report" : title_;
    report_.facts.emplace_back("Refraction", query_.earth.convention());
    if (query_.radio) {
      const profile::RadioPath& radio = *query_.radio;
      report_.facts.emplace_back(
          "Radio", fmt::format("{:g} GHz, {} polarisation, effective Earth {:.1f} km, {:.0f} % over sea; wavelength "
                               "0.299792458 / f",
                               radio.frequency_ghz,
                               radio.polarisation == profile::Polarisation::kVertical ? "vertical" : "horizontal",
                               radio.effective_earth_km, 100 * radio.over_sea));
    }
    result.document["refraction"] = earth_.document();
    result.document["from"] = end_document(from);
    result.document["to"] = end_document(to);
    result.document.update(los_document(report_));
  }

  void add_warnings(Result& result) const {
    if (query_.radio && earth_.is_default()) {
      result.warnings.push_back(
          fmt::format("radio at the refraction of light, an effective Earth of {:.0f} km; the usual one of radio is "
                      "--effective-earth 4/3",
                      query_.radio->effective_earth_km));
    }
  }

  std::string store_, profile_csv_, heights_text_, title_;
  std::vector<std::string> reports_;
  std::vector<double> heights_;
  LosStoreOptions line_;
  LosLinks links_;
  EarthOptions earth_;
  RadioOptions radio_;
  OutputPolicy policy_;
  profile::LosQuery query_;
  profile::LosReport report_;
};

}  // namespace

std::unique_ptr<Verb> make_los_verb() {
  return std::make_unique<LosVerb>();
}

}  // namespace itin::cli
