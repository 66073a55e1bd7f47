// itin ztv: what is seen of wind turbines from where, as an application for planning needs it.

#include <algorithm>
#include <filesystem>
#include <future>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/beside.hpp>
#include <itin/coordinates.hpp>
#include <itin/csv_cell.hpp>
#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/output_file.hpp>
#include <itin/sources_in.hpp>
#include <itin/store.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>

#include "options/detail_options.hpp"
#include "options/earth_options.hpp"
#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/off_the_data.hpp"
#include "options/radius_preset.hpp"
#include "options/sheet_options.hpp"
#include "options/store_scale.hpp"
#include "options/surface_options.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"
#include "ztv/ztv_folder.hpp"
#include "ztv/ztv_methods.hpp"
#include "ztv/ztv_radio.hpp"
#include "ztv/ztv_route.hpp"
#include "ztv/ztv_sheets.hpp"
#include "ztv/ztv_turbines.hpp"
#include "ztv/ztv_undecided.hpp"
#include "ztv/ztv_viewpoints.hpp"

namespace itin::cli {

namespace {

using viewshed::Turbine;
using viewshed::Zone;
using viewshed::ZoneFile;

constexpr double kDefaultCell = 50;

class ZtvVerb final : public Verb {
 public:
  std::string name() const override { return "ztv"; }
  std::string summary() const override {
    return "Write where wind turbines are visible from: maps, sheets, tables, wirelines";
  }

  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    turbines_.declare(app);
    begin_group(app, kOutputs);
    replaces(app.add_option("-o,--output", output_, "The folder to write")->required()->type_name("DIR"));
    begin_group(app, "Area and cells");
    app.add_option("--cell", cell_text_, "Size of the rasters' cells (default: 50)")->type_name("METRES");
    reads(app.add_option("--like", like_, "Take the cells of this raster")->type_name("FILE"));
    app.add_option("--bands", bands_text_,
                   "Greatest number of turbines in each band of maps and tables, ascending (default: at most seven "
                   "bands of equal width)")
        ->type_name("N,...");
    app.add_option("--observer-height", observer_text_,
                   "Height of the observer's eyes above the bare ground (default: 2)")
        ->type_name("METRES");
    radius_.declare(app);
    viewpoints_.declare(app);
    route_.declare(app);
    radio_.declare(app);
    sheets_.declare(app);
    detail_.declare(app, "");
    themes_.declare(app);
    earth_.declare(app);
    nodata_.declare(app);
    memory_.declare(app,
                    "Memory to work in, for example 2G. Surfaces that exceed it are read in parts, and rasters that do "
                    "are refused; "
                    "the result does not depend on it (default: no limit)");
    policy_.declare(app);
  }

  void validate() override {
    turbines_.validate();
    sheets_.validate();
    viewpoints_.validate(turbines_.in_crs(), sheets_);
    route_.validate();
    radio_.validate();
    radius_.validate();
    detail_.validate();
    if (detail_.has_rings()) throw InputError("--rings lie about one observer; a ztv takes --tolerance");
    themes_.validate();
    earth_.validate();
    request_.earth = earth_.earth();
    if (!observer_text_.empty())
      request_.observer_height = parse_height("--observer-height", observer_text_, Range::kNotNegative);
    if (!bands_text_.empty()) request_.count_bands = parse_bands();
    if (!cell_text_.empty() && !like_.empty()) throw InputError("--cell and --like exclude each other");
    if (like_.empty())
      request_.cell_size = cell_text_.empty() ? kDefaultCell : parse_number("--cell", cell_text_, Range::kPositive);
    request_.memory_bytes = memory_.bytes();
    request_.nodata = nodata_.rule();
  }

  std::vector<std::size_t> parse_bands() const {
    std::vector<std::size_t> bands;
    for (const int most : parse_wholes("--bands", bands_text_, 1, 65534)) {
      if (!bands.empty() && static_cast<std::size_t>(most) <= bands.back())
        throw InputError("--bands: give ascending numbers");
      bands.push_back(static_cast<std::size_t>(most));
    }
    return bands;
  }

  Document parameters() const override {
    Document parameters{{"store", store_}};
    parameters.update(turbines_.parameters());
    parameters["observer_height_m"] = request_.observer_height;
    if (request_.cell_size) parameters["cell_m"] = *request_.cell_size;
    if (!request_.count_bands.empty()) parameters["bands"] = request_.count_bands;
    if (!like_.empty()) parameters["like"] = like_;
    parameters["radius_preset"] = radius_.document();
    parameters.update(viewpoints_.parameters());
    parameters.update(route_.parameters());
    parameters.update(radio_.parameters());
    parameters.update(sheets_.parameters());
    parameters.update(detail_.parameters());
    parameters.update(themes_.parameters());
    parameters["nodata"] = nodata_.text();
    return parameters;
  }

  cli::Result execute(Progress& progress) override {
    const std::future<void> rasters = beside(make_gdal_ready);
    ZtvFolder::require_writable(output_, policy_);
    radius_.load();
    const Store store(store_, cache_within(request_.memory_bytes));
    const StoreMetadata& metadata = store.metadata();
    earth_.take_body_of(metadata);
    request_.earth = earth_.earth();
    complete_request(metadata);
    Zone zone = viewshed::survey_turbines(store, request_, progress);
    for (const viewshed::Misplaced& m : zone.misplaced)
      list_.bad.push_back({m.number, list_.places[m.number - 1].first, list_.places[m.number - 1].second, m.message});
    sources_ = sources_in(store, looked_at(zone), request_.themes.value_or(ThemeChoice::none()));
    missing_ = viewshed::missing_ground(zone);
    if (missing_.study_m2() == 0)
      throw InputError(
          fmt::format("{}: none of the cells lies within the radius of a turbine; move them there, or give a "
                      "larger --radius",
                      like_.empty() ? "--cell" : "--like " + like_));
    ZtvFolder folder(output_, policy_);
    cli::Result result;
    result.document = document(zone, metadata);
    write(store, zone, folder.working(), result.document, progress);
    result.warnings = warnings(zone);
    warn_of_grid(metadata, result.warnings);
    write_manifest(folder.working(), result);
    folder.publish();
    result.text = text(zone);
    return result;
  }

 private:
  /// The box that all sight lines from cells to turbines and from the radar lie in.
  static Box looked_at(const Zone& zone) {
    Box box = zone.grid.bounds();
    for (const Turbine& turbine : zone.request.turbines) box.extend(turbine.position);
    if (zone.request.radar) box.extend(zone.request.radar->position);
    return box;
  }

  /// Completes the request by the options that need the store.
  void complete_request(const StoreMetadata& metadata) {
    list_ = turbines_.read(metadata, [&](double tip) { return radius_.radius(tip); });
    std::vector<Point2> places;
    for (const Turbine& turbine : list_.turbines) places.push_back(turbine.position);
    require_any_on_the_data(turbines_.path() + ": the first turbine", places, turbines_.in_crs(), metadata);
    radio_.load(turbines_.in_crs(), metadata);
    request_.turbines = list_.turbines;
    request_.radar = radio_.radar();
    request_.detail = detail_.detail({});
    themes_.choice().check(metadata.themes);
    if (themes_.choice().includes_raised(metadata.themes)) request_.themes = themes_.choice();
    if (!like_.empty()) request_.grid = raster_grid_like(like_, metadata.crs_wkt);
  }

  Document surface(const StoreMetadata& metadata) const {
    return surface_document(metadata, request_.detail, request_.themes.value_or(ThemeChoice::none()));
  }

  void write(const Store& store, const Zone& zone, const std::string& folder, Document& document, Progress& progress) {
    const StoreMetadata& metadata = store.metadata();
    std::vector<ZoneFile> files;
    const auto add = [&](std::vector<ZoneFile> more) { files.insert(files.end(), more.begin(), more.end()); };
    const auto add_text = [&](const std::string& name, const std::string& what, const std::string& bytes) {
      write_file(folder + "/" + name, bytes, true);
      files.push_back({name, what});
    };
    viewshed::ZoneFileOptions options;
    options.crs_wkt = metadata.crs_wkt;
    options.metadata = {{"itin", ITIN_VERSION},
                        {"observer_height_m", fmt::format("{:g}", request_.observer_height)},
                        {"refraction", request_.earth.convention()},
                        {"surface", json_text(surface(metadata))}};
    progress.report("rasters", 0);
    add(viewshed::write_zone_rasters(folder, zone, options));
    add(radio_.write(folder, zone, options));
    progress.report("polygons", 0);
    add(viewshed::write_zone_polygons(folder, zone, options));
    if (viewpoints_.given()) {
      seen_ = viewpoints_.write(folder, store, zone, sheets_, progress);
      add(seen_.files);
      document["viewpoints"] = bad_rows_document(seen_.path, seen_.rows, seen_.rows - seen_.bad.size(), seen_.bad);
    }
    std::vector<Path> routes;
    if (route_.given()) {
      RouteOptions::Written written = route_.write(folder, store, zone, progress);
      add(std::move(written.files));
      routes = std::move(written.routes);
      route_warnings_ = std::move(written.warnings);
    }
    if (sheets_.given())
      add(write_ztv_sheets(folder, store, zone, sheets_.choice(),
                           {seen_.places, routes, radio_.links(), radio_.radar(), sources_, missing_}, progress));
    add_text("areas.csv", "km² by band of turbines visible and by ring of distance to the nearest turbine",
             viewshed::area_table(zone));
    add_text("area-totals.csv",
             "km² by band of turbines visible and by combination of farms, over the whole study area",
             viewshed::area_totals(zone));
    if (viewshed::farms_of(zone).size() > 1)
      add_text("farms.csv", "what the values of farms.tif stand for: combinations of farms, and km² of each",
               viewshed::combination_table(zone));
    add_text("turbines.csv", "the turbines row by row: heights and ground as used, and why a row is not used",
             turbine_table(zone));
    add_text("radius-preset.json", "the radii used, to edit and give by --radius-preset",
             json_text(radius_.document(), 2) + "\n");
    add_text("methods.md", "how the results were computed, for a chapter on methods", methods(zone, metadata));
    document["outputs"] = Document::array();
    for (const ZoneFile& file : files)
      document["outputs"].push_back(
          {{"path", (std::filesystem::path(output_) / file.name).string()}, {"what", file.what}});
  }

  std::string turbine_table(const Zone& zone) const {
    std::vector<std::string> rows(list_.rows);
    for (std::size_t k = 0; k < zone.request.turbines.size(); ++k) {
      const Turbine& t = zone.request.turbines[k];
      rows[t.number - 1] = fmt::format(
          "{},{},{},{},{:.3f},{:.3f},{:.2f},{},{},{:g},{:g},used,{}\n", t.number, list_.places[t.number - 1].first,
          csv_cell(t.name), csv_cell(t.farm), t.position.x, t.position.y, zone.ground_m[k], csv_cell(t.hub_height, 2),
          csv_cell(t.rotor_diameter, 2), t.tip_height, t.radius / 1000, radio_.cells(zone, k));
    }
    const std::string names = radio_.columns(),
                      none(static_cast<std::size_t>(std::count(names.begin(), names.end(), ',')), ',');
    for (const BadRow& bad : list_.bad)
      rows[bad.number - 1] =
          fmt::format("{},{},,,,,,,,,,not used,{}{}\n", bad.number, bad.feature, csv_cell(bad.message), none);
    return "number,feature,name,farm,x,y,ground_m,hub_height_m,rotor_diameter_m,tip_height_m,radius_km,status,message" +
           radio_.columns() + "\n" + fmt::format("{}", fmt::join(rows, ""));
  }

  std::string methods(const Zone& zone, const StoreMetadata& metadata) const {
    ZtvMethods facts;
    facts.turbines_file = turbines_.path();
    facts.turbines_sha256 = list_.sha256;
    const Document of_surface = surface(metadata);
    facts.surface =
        request_.detail.coarsest() > 0
            ? fmt::format(
                  "The surface is generalised to a tolerance of {:g} m, with a certified error of {:.2f} to "
                  "{:.2f} m against the full terrain.",
                  request_.detail.coarsest(), of_surface["certified_error_m"][0].get<double>(),
                  of_surface["certified_error_m"][1].get<double>())
            : "Every point of the model is used.";
    facts.sources = sources_;
    facts.missing = missing_;
    facts.wirelines = viewpoints_.draws_wirelines(), facts.sheets = sheets_.given();
    facts.radius = radius_.text();
    facts.further = radio_.methods(zone);
    facts.rows = list_.rows, facts.bad = list_.bad.size();
    return methods_text(zone, metadata, facts);
  }

  Document document(const Zone& zone, const StoreMetadata& metadata) const {
    Document document;
    document["crs"] = crs_identifier(metadata.crs_wkt);
    document["surface"] = surface(metadata);
    document["sources"] = sources_document(sources_);
    document["refraction"] = earth_document(earth_.earth());
    document["grid"] = viewshed::grid_document(zone.grid);
    document["turbines"] = bad_rows_document(turbines_.path(), list_.rows, zone.request.turbines.size(), list_.bad);
    document["turbines"]["sha256"] = list_.sha256;
    document["turbines"]["hub_heights_known"] = viewshed::known_hubs(zone);
    document["farms"] = viewshed::farms_of(zone);
    document["study_area"] = {{"km2", missing_.study_m2() / 1e6},
                              {"without_data_km2", missing_.missing_m2() / 1e6},
                              {"share_without_data", missing_.share()}};
    document["area_km2"]["bare"] = areas(zone, zone.bare);
    if (zone.screened) document["area_km2"]["screened"] = areas(zone, *zone.screened);
    if (zone.leaves_open())
      document["undecided"] = {{"reason", "ground without data"}, {"decided_by", kDecidesMissingGround}};
    document.update(radio_.document(zone));
    document["statistics"] = viewshed::statistics_document(zone.statistics);
    document["statistics"].update({{"retrieval_seconds", zone.statistics.retrieval_seconds},
                                   {"scene_seconds", zone.statistics.scene_seconds},
                                   {"lines_seconds", zone.statistics.lines_seconds}});
    return document;
  }

  static Document areas(const Zone& zone, const viewshed::Visibility& v) {
    std::uint64_t hubs = 0, tips = 0, all = 0;
    for (std::size_t i = 0; i < v.tip_count.size(); ++i) {
      if (v.tip_count[i] == viewshed::kCountOutside) continue;
      ++all, hubs += v.hub_count[i] > 0 ? 1U : 0U, tips += v.tip_count[i] > 0 ? 1U : 0U;
    }
    const auto km2 = [&](std::uint64_t cells) { return static_cast<double>(cells) * zone.grid.cell_area() / 1e6; };
    Document areas{{"any_tip_seen", km2(tips)}, {"any_hub_seen", nullptr}, {"studied", km2(all)}};
    const bool hubs_known = viewshed::known_hubs(zone) > 0;
    if (hubs_known) areas["any_hub_seen"] = km2(hubs);
    const UndecidedArea of_tips = undecided_area(zone, v.tip_count, v.tip_undecided);
    areas.update({{"any_tip_undecided", of_tips.any_m2 / 1e6}, {"more_tips_undecided", of_tips.more_m2 / 1e6}});
    if (!hubs_known) return areas;
    const UndecidedArea of_hubs = undecided_area(zone, v.hub_count, v.hub_undecided);
    areas.update({{"any_hub_undecided", of_hubs.any_m2 / 1e6}, {"more_hubs_undecided", of_hubs.more_m2 / 1e6}});
    return areas;
  }

  /// Puts the result of areas() into words.
  static std::string seen_from(const Document& areas) {
    std::string text = fmt::format("from {:.1f} km²", areas["any_tip_seen"].get<double>());
    if (!areas["any_hub_seen"].is_null())
      text += fmt::format(", a hub from {:.1f} km²", areas["any_hub_seen"].get<double>());
    return text;
  }

  std::vector<std::string> warnings(const Zone& zone) const {
    std::vector<std::string> warnings = zone.warnings;
    if (const auto warning = missing_.warning("the study area, all turbines' radii,")) warnings.push_back(*warning);
    for (const BadRow& bad : list_.bad) warnings.push_back(bad_row_warning(turbines_.path(), bad));
    for (const std::string& warning : list_.warnings) warnings.push_back(warning);
    const auto of_radio = radio_.warnings(zone);
    warnings.insert(warnings.end(), of_radio.begin(), of_radio.end());
    for (const BadRow& bad : seen_.bad) warnings.push_back(bad_row_warning(seen_.path, bad));
    warnings.insert(warnings.end(), seen_.warnings.begin(), seen_.warnings.end());
    warnings.insert(warnings.end(), route_warnings_.begin(), route_warnings_.end());
    // The program translates them, too, but only after they are in the document of the folder.
    std::transform(warnings.begin(), warnings.end(), warnings.begin(), in_options);
    return warnings;
  }

  /// Writes the document of the folder, without times, so that equal runs write equal files.
  void write_manifest(const std::string& folder, const cli::Result& result) const {
    Document manifest = call_document(*this);
    manifest.update(result.document);
    manifest["warnings"] = result.warnings;
    manifest.erase("statistics");
    write_file(folder + "/" + ZtvFolder::kManifest, json_text(manifest, 2) + "\n", true);
  }

  std::string text(const Zone& zone) const {
    const Document bare = areas(zone, zone.bare);
    std::string text = fmt::format(
        "{}: {} of {}; a blade tip is visible {}, of the {:.1f} km² that have terrain data\n", output_,
        zone.request.turbines.size(), counted(list_.rows, "turbine"), seen_from(bare), bare["studied"].get<double>());
    if (const std::string known = viewshed::of_known_hubs(zone); !known.empty())
      text += fmt::format("hubs{}: the hub heights of the others are not known\n", known);
    const auto add_undecided = [&](const char* where, const viewshed::Visibility& v) {
      const std::string what = undecided_in_words(undecided_area(zone, v.tip_count, v.tip_undecided));
      if (!what.empty())
        text += fmt::format("{}undecided, across ground without data: {}; {} decides it\n", where, what,
                            kDecidesMissingGround);
    };
    add_undecided("", zone.bare);
    if (zone.screened) {
      text += fmt::format("screened: a blade tip {}\n", seen_from(areas(zone, *zone.screened)));
      add_undecided("screened: ", *zone.screened);
    }
    if (missing_.share() > 0) text += fmt::format("no ground data: {} of the study area\n", missing_.text());
    text += fmt::format("{}, {}; {}\n", counted(zone.statistics.triangles, "triangle"),
                        counted(zone.statistics.lines, "sight line"), request_.earth.convention());
    return text;
  }

  std::string store_, output_, cell_text_, like_, observer_text_, bands_text_;
  MemoryOption memory_;
  TurbineOptions turbines_;
  RadiusOptions radius_;
  ViewpointOptions viewpoints_;
  RouteOptions route_;
  std::vector<std::string> route_warnings_;
  ZtvRadioOptions radio_;
  SheetOptions sheets_;
  DetailOptions detail_;
  ThemeOptions themes_;
  EarthOptions earth_;
  NoDataOption nodata_;
  OutputPolicy policy_;

  TurbineList list_;
  viewshed::ZoneRequest request_;
  std::vector<SourceInfo> sources_;  ///< where the surface comes from
  viewshed::MissingGround missing_;  ///< in the study area
  ViewpointOptions::Written seen_;
};

}  // namespace

std::unique_ptr<Verb> make_ztv_verb() {
  return std::make_unique<ZtvVerb>();
}

}  // namespace itin::cli
