// itin ztv: what is seen of wind turbines from where, as an application for planning needs it.

#include <algorithm>
#include <future>
#include <optional>

#include <fmt/format.h>

#include <itin/beside.hpp>
#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/store.hpp>
#include <viewshed/undecided_area.hpp>
#include <viewshed/zone_files.hpp>
#include <viewshed/zone_study_document.hpp>
#include <viewshed/zone_study_tasks.hpp>

#include "options/detail_options.hpp"
#include "options/foliage_options.hpp"
#include "options/half_posting.hpp"
#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/radio/earth_options.hpp"
#include "options/radius_preset.hpp"
#include "options/sheet_options.hpp"
#include "options/surface_options.hpp"
#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"
#include "ztv/ztv_radio.hpp"
#include "ztv/ztv_route.hpp"
#include "ztv/ztv_turbines.hpp"
#include "ztv/ztv_viewpoints.hpp"

namespace itin::cli {

namespace {

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
    app.add_option("--cell", cell_text_,
                   "Size of the rasters' cells (default: 50); unasked they are no finer than half "
                   "the posting of bare ground")
        ->type_name("METRES");
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
    foliage_.declare_of_seasons(app);
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
    viewpoints_.validate(turbines_.in_crs(), sheets_.given());
    route_.validate();
    radio_.validate();
    radius_.validate();
    detail_.validate();
    if (detail_.has_rings()) throw InputError("--rings lie about one observer; a ztv takes --tolerance");
    themes_.validate();
    foliage_.validate();
    if (foliage_.given())
      request_.zone.foliage = {foliage_.foliage().extinction, foliage_.foliage().least_transmittance};
    earth_.validate();
    request_.zone.earth = earth_.earth();
    if (!observer_text_.empty())
      request_.zone.observer_height = parse_height("--observer-height", observer_text_, Range::kNotNegative);
    if (!bands_text_.empty()) request_.zone.count_bands = parse_bands();
    if (!cell_text_.empty() && !like_.empty()) throw InputError("--cell and --like exclude each other");
    if (like_.empty())
      request_.zone.cell_size =
          cell_text_.empty() ? kDefaultCell : parse_number("--cell", cell_text_, Range::kPositive);
    request_.zone.memory_bytes = memory_.bytes();
    request_.zone.nodata = nodata_.rule();
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
    parameters["observer_height_m"] = request_.zone.observer_height;
    if (request_.zone.cell_size) parameters["cell_m"] = *request_.zone.cell_size;
    if (!request_.zone.count_bands.empty()) parameters["bands"] = request_.zone.count_bands;
    if (!like_.empty()) parameters["like"] = like_;
    parameters["radius_preset"] = radius_.document();
    parameters.update(viewpoints_.parameters());
    parameters.update(route_.parameters());
    parameters.update(radio_.parameters());
    parameters.update(sheets_.parameters());
    parameters.update(detail_.parameters());
    parameters.update(themes_.parameters());
    parameters.update(foliage_.parameters());
    parameters["nodata"] = nodata_.text();
    return parameters;
  }

  std::unique_ptr<viewshed::Tasks> divide(std::uint64_t most_cells, Progress& progress) override {
    open_store(progress);
    return viewshed::tasks_of_study(*opened_, request_, most_cells, progress);
  }
  void take_answers(viewshed::Tasks& answered) override { answered_ = &dynamic_cast<viewshed::ZoneTasks&>(answered); }

  cli::Result execute(Progress& progress) override {
    const std::future<void> rasters = beside(make_gdal_ready);
    viewshed::require_zone_folder(output_, policy_.overwrite);
    open_store(progress);
    const Store& store = *opened_;
    const auto take = [&](const viewshed::ZoneRequest&) { return answered_->take(); };
    const viewshed::ZoneStudy study = answered_ != nullptr ? viewshed::study_zone_by(take, store, request_, progress)
                                                           : viewshed::study_zone(store, request_, progress);
    cli::Result result;
    result.document = viewshed::zone_study_document(study, kDecidesMissingGround);
    result.warnings = study.warnings;
    viewshed::ZoneStudyFileOptions options{viewpoints_.wirelines(), sheets_.choice(), kDecidesMissingGround};
    options.manifest = [&](const std::vector<ZoneFile>& files) { return manifest(files, result); };
    options.overwrite = policy_.overwrite;
    viewshed::write_zone_study(output_, store, study, options, progress);
    result.text = text(study, result.document["area_km2"]);
    return result;
  }

 private:
  /// Completes the request by the options that need the store.
  /// Opens the store, and completes the request from it.
  void open_store(Progress& progress) {
    radius_.load();
    themes_.complete(opened_.emplace(store_, cache_within(request_.zone.memory_bytes)), progress);
    complete_request(opened_->metadata());
  }

  void complete_request(const StoreMetadata& metadata) {
    earth_.take_body_of(metadata);
    request_.zone.earth = earth_.earth();
    request_.turbines = turbines_.read(radius_.rule(), metadata);
    radio_.complete(request_, turbines_.in_crs(), metadata);
    request_.zone.detail = detail_.detail({});
    request_.zone.themes = themes_.choice();
    viewpoints_.complete(request_, metadata);
    route_.complete(request_, metadata);
    if (cell_text_.empty() && like_.empty())
      request_.zone.cell_size = std::max(kDefaultCell, half_posting(metadata, themes_.choice()));
    if (like_.empty()) return;
    request_.zone.grid = raster_grid_like(like_, metadata.crs_wkt);
    request_.grid_source = "--like " + like_;
  }

  /// Adds the outputs to the result, and returns the document of the folder.
  std::string manifest(const std::vector<ZoneFile>& files, cli::Result& result) const {
    result.document["outputs"] = viewshed::outputs_document(output_, files);
    for (Document& output : result.document["outputs"]) output["what"] = in_options(output["what"].get<std::string>());
    return folder_document(*this, result);
  }

  /// Puts a document of areas into words.
  static std::string seen_from(const Document& areas) {
    std::string text = fmt::format("from {:.1f} km²", areas["any_tip_seen"].get<double>());
    if (!areas["any_hub_seen"].is_null())
      text += fmt::format(", a hub from {:.1f} km²", areas["any_hub_seen"].get<double>());
    return text;
  }

  std::string text(const viewshed::ZoneStudy& study, const Document& areas) const {
    const Zone& zone = study.zone;
    std::string text =
        fmt::format("{}: {} of {}; a blade tip is visible {}, of the {:.1f} km² that have terrain data\n", output_,
                    zone.request.turbines.size(), counted(study.request.turbines.rows, "turbine"),
                    seen_from(areas["bare"]), areas["bare"]["studied"].get<double>());
    if (const auto& bare = areas["bare"]; bare.contains("proposal"))
      text +=
          fmt::format("proposal: a blade tip is visible from {:.1f} km², of which {:.1f} km² see no other turbine\n",
                      bare["proposal"]["proposal_seen"].get<double>(), bare["proposal"]["additional"].get<double>());
    if (const std::string known = viewshed::of_known_hubs(zone); !known.empty())
      text += fmt::format("hubs{}: the hub heights of the others are not known\n", known);
    const auto add_undecided = [&](const char* where, const viewshed::Visibility& v) {
      const std::string what =
          viewshed::undecided_in_words(viewshed::undecided_area(zone, v.tip_count, v.tip_undecided));
      if (!what.empty())
        text += fmt::format("{}undecided, across ground without data: {}; {} decides it\n", where, what,
                            kDecidesMissingGround);
    };
    add_undecided("", zone.bare);
    if (zone.screened) {
      text += fmt::format("screened: a blade tip {}\n", seen_from(areas["screened"]));
      add_undecided("screened: ", *zone.screened);
    }
    if (zone.seasons)
      text += fmt::format("through foliage: a blade tip {} in summer; {} in winter\n", seen_from(areas["summer"]),
                          seen_from(areas["winter"]));
    if (study.missing.share() > 0) text += fmt::format("no ground data: {} of the study area\n", study.missing.text());
    text += fmt::format("{}, {}; {}\n", counted(zone.statistics.triangles, "triangle"),
                        counted(zone.statistics.lines, "sight line"), zone.request.earth.convention());
    return text;
  }

  std::string store_, output_, cell_text_, like_, observer_text_, bands_text_;
  MemoryOption memory_;
  TurbineOptions turbines_{TurbineOptions::Use::zone};
  RadiusOptions radius_;
  ViewpointOptions viewpoints_;
  RouteOptions route_;
  ZtvRadioOptions radio_;
  SheetOptions sheets_;
  DetailOptions detail_;
  ThemeOptions themes_;
  FoliageOptions foliage_;
  EarthOptions earth_;
  NoDataOption nodata_;
  OutputPolicy policy_;
  viewshed::ZoneStudyRequest request_;
  std::optional<Store> opened_;
  viewshed::ZoneTasks* answered_ = nullptr;  ///< what others have found, in place of computing it
};

}  // namespace

std::unique_ptr<Verb> make_ztv_verb() {
  return std::make_unique<ZtvVerb>();
}

}  // namespace itin::cli
