// itin visibility: how much is seen from everywhere in an area.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <itin/beside.hpp>
#include <itin/coordinates.hpp>
#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/output_file.hpp>
#include <itin/sources_in.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/qgis_styles.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/tasks.hpp>
#include <viewshed/visibility_index.hpp>

#include "options/detail_options.hpp"
#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/places/window_options.hpp"
#include "options/radio/earth_options.hpp"
#include "options/sheet_options.hpp"
#include "options/surface_options.hpp"
#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

constexpr int kMostTargets = 1 << 20, kFewestRays = 8, kMostRays = 1 << 14;

class VisibilityVerb final : public Verb {
 public:
  std::string name() const override { return "visibility"; }
  std::string summary() const override { return "Write how much is seen from everywhere in an area (total viewshed)"; }

  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    begin_group(app, kOutputs);
    writes(
        app.add_option(
               "-o,--output", output_,
               "The raster to write (.tif), three bands: the share of the ground within the radius that an observer "
               "at the cell's centre certainly sees, 0 to 1; its standard error; and the share that is undecided, as "
               "ground without data alone could hide it. Its QGIS style is written beside it (.qml)")
            ->type_name("FILE")
            ->required());
    begin_group(app, "Observers and targets");
    app.add_option("--cell", cell_text_, "Distance between observers, which is the size of the raster's cells")
        ->type_name("METRES")
        ->required();
    app.add_option("--radius", radius_text_, "How far observers look")->type_name("METRES")->required();
    app.add_option("--observer-height", height_text_, "Height of observers above the ground (default: 2)")
        ->type_name("METRES");
    app.add_option("--target-height", target_text_, "Height of targets above the ground (default: 0)")
        ->type_name("METRES");
    app.add_option("--rays", rays_text_,
                   "Rays from every observer, evenly spread over all directions (default: 128). They need the full "
                   "detail of a raster without features, and a --cell that is a multiple of the distance between its "
                   "heights; where there can be none, targets lie at random")
        ->type_name("N");
    app.add_option(
           "--targets", targets_text_,
           "Targets at random for every observer, in place of rays; four times as many halve the standard error "
           "(default where there can be no rays: 128)")
        ->type_name("N");
    sheet_.declare_file(app);
    window_.declare(app);
    detail_.declare(app, "");
    themes_.declare(app);
    earth_.declare(app);
    nodata_.declare(app);
    memory_.declare(app, kReadInParts);
    policy_.declare(app);
  }

  void validate() override {
    request_.cell_size = parse_number("--cell", cell_text_, Range::kPositive);
    request_.radius = parse_radius("--radius", radius_text_);
    if (request_.cell_size > request_.radius)
      throw InputError(fmt::format("--cell '{}': larger than the radius", cell_text_));
    if (!height_text_.empty()) request_.height = parse_height("--observer-height", height_text_, Range::kNotNegative);
    if (!target_text_.empty())
      request_.target_height = parse_height("--target-height", target_text_, Range::kNotNegative);
    if (!rays_text_.empty() && !targets_text_.empty())
      throw InputError("--rays and --targets: observers have either; give one of them");
    if (!rays_text_.empty())
      request_.rays = static_cast<unsigned>(parse_whole("--rays", rays_text_, kFewestRays, kMostRays));
    if (!targets_text_.empty())
      request_.targets = static_cast<unsigned>(parse_whole("--targets", targets_text_, 1, kMostTargets));
    if (!names_geotiff(output_))
      throw InputError(fmt::format("--output '{}': a visibility index is written as .tif", output_));
    sheet_.validate();
    window_.validate();
    detail_.validate();
    if (detail_.has_rings()) throw InputError("--rings lie about one observer; give --tolerance");
    themes_.validate();
    earth_.validate();
    request_.earth = earth_.earth();
    request_.nodata = nodata_.rule();
    request_.memory_bytes = memory_.bytes().value_or(request_.memory_bytes);
  }

  Document parameters() const override {
    Document parameters{{"store", store_},
                        {"output", output_},
                        {"cell_m", request_.cell_size},
                        {"radius_m", request_.radius},
                        {"observer_height_m", request_.height},
                        {"target_height_m", request_.target_height}};
    if (request_.rays) parameters["rays"] = *request_.rays;
    if (request_.targets) parameters["targets"] = *request_.targets;
    parameters.update(sheet_.parameters());
    parameters.update(window_.parameters());
    parameters.update(detail_.parameters());
    parameters.update(themes_.parameters());
    parameters["nodata"] = nodata_.text();
    return parameters;
  }

  std::unique_ptr<viewshed::Tasks> divide(std::uint64_t most_cells, Progress& progress) override {
    complete_request(progress);
    return std::make_unique<viewshed::IndexTasks>(*opened_, request_, most_cells, progress);
  }
  bool writes_by_parts() const override { return sheet_.file().empty(); }
  void take_answers(viewshed::Tasks& answered) override { answered_ = &dynamic_cast<viewshed::IndexTasks&>(answered); }

  Result execute(Progress& progress) override {
    const std::future<void> rasters = beside(make_gdal_ready);
    policy_.require_writable(output_);
    policy_.claim(viewshed::style_beside(output_));
    if (!sheet_.file().empty()) policy_.require_writable(sheet_.file());
    complete_request(progress);
    const Store& store = *opened_;
    const StoreMetadata& metadata = store.metadata();
    const viewshed::VisibilityIndex index =
        answered_ != nullptr ? answered_->take() : viewshed::visibility_index(store, request_, progress);
    const Document surface = surface_document(metadata, request_.detail, request_.themes);
    viewshed::write_geotiff(
        output_, index, request_,
        {metadata.crs_wkt, {{"itin", ITIN_VERSION}, {"surface", json_text(surface)}}, policy_.overwrite}, progress);
    write_file(viewshed::style_beside(output_), viewshed::qgis_style_of_shares(), policy_.overwrite);
    const std::vector<SourceInfo> sources = sources_in(store, looked_at(index), request_.themes);
    if (!sheet_.file().empty()) write_sheet(store, index, described(sources, metadata), progress);
    Result result;
    const viewshed::MissingGround missing = viewshed::missing_ground(index);
    if (const auto warning = missing.warning("what lies within the radius, on average over the observers,"))
      result.warnings.push_back(in_options(*warning));
    warn_of_grid(metadata, result.warnings);
    Document& document = result.document;
    document["crs"] = crs_identifier(metadata.crs_wkt);
    document["surface"] = surface;
    document["refraction"] = earth_document(earth_.earth());
    document["grid"] = viewshed::grid_document(index.grid);
    document["observers"] = index.observers;
    document["sample"] = sample_document(index.sample);
    document["share_without_data"] = missing.share();
    document["mean_share"] = index.mean;
    document["mean_share_standard_error"] = index.mean_error;
    document["mean_share_undecided"] = index.mean_undecided;
    if (index.mean_undecided > 0) document["undecided_decided_by"] = kDecidesMissingGround;
    document["sources"] = sources_document(sources);
    document["outputs"] = {output_, viewshed::style_beside(output_)};
    if (!sheet_.file().empty()) document["outputs"].push_back(sheet_.file());
    document["statistics"] = viewshed::statistics_document({index.retrieval, index.triangles, index.lines});
    result.text = fmt::format(
        "{}: {}\non average, one of {} sees {:.2f} % (standard error {:.2g}) of the ground within {:g} m\n{}{}{}"
        "{}, {}; {}\n",
        output_, readable_bytes(std::filesystem::file_size(output_)), counted(index.observers, "observer"),
        100 * index.mean, 100 * index.mean_error, request_.radius, undecided_in_words(index), missing_in_words(missing),
        sampled_in_words(index.sample), counted(index.triangles, "triangle"), counted(index.lines, "line"),
        earth_.earth().convention());
    return result;
  }

 private:
  /// Opens the store, and completes the request from it.
  void complete_request(Progress& progress) {
    const Store& store = opened_.emplace(store_, cache_within(request_.memory_bytes));
    const StoreMetadata& metadata = store.metadata();
    earth_.take_body_of(metadata);
    request_.earth = earth_.earth();
    request_.area = window_.region(metadata).window;
    if (!request_.area.is_all() && !metadata.grid.box(metadata.bounds).meets(request_.area.bounds()))
      throw InputError(window_.no_ground(metadata));
    request_.detail = detail_.detail({});
    themes_.complete(store, progress);
    request_.themes = themes_.choice();
    request_.themes.check(metadata.themes);
  }

  /// The box that all sight lines of the observers lie in.
  Box looked_at(const viewshed::VisibilityIndex& index) const {
    const Box observers = index.grid.bounds();
    const double reach = request_.radius;
    return {observers.xmin - reach, observers.ymin - reach, observers.xmax + reach, observers.ymax + reach};
  }
  static std::string each_in_words(const viewshed::IndexSample& sample) {
    return sample.rays > 0 ? counted(sample.rays, "ray") : counted(sample.targets, "target") + " at random";
  }
  std::string targets_in_words(const viewshed::IndexSample& sample) const {
    const bool rays = sample.rays > 0;
    return fmt::format("{}{} {} each observer, {:g} m above the ground", rays ? "along " : "", each_in_words(sample),
                       rays ? "from" : "for", request_.target_height);
  }
  static std::string sampled_in_words(const viewshed::IndexSample& sample) {
    const std::string why = sample.without_rays.empty() ? "" : ", without rays, for " + in_options(sample.without_rays);
    return fmt::format("found by {} for each observer{}\n", each_in_words(sample), why);
  }
  static Document sample_document(const viewshed::IndexSample& sample) {
    Document document{{"by", sample.rays > 0 ? "rays" : "targets"},
                      {"for_each_observer", sample.rays > 0 ? sample.rays : sample.targets}};
    if (!sample.without_rays.empty()) document["without_rays_for"] = in_options(sample.without_rays);
    return document;
  }
  static std::string missing_in_words(const viewshed::MissingGround& missing) {
    if (missing.share() == 0) return "";
    return fmt::format("no ground data: {} of what lies within that distance\n", missing.text());
  }
  static std::string undecided_in_words(const viewshed::VisibilityIndex& index) {
    if (index.mean_undecided == 0) return "";
    return fmt::format(
        "undecided: {:.2f} %, which ground without data alone could hide; --nodata block or clear decides it\n",
        100 * index.mean_undecided);
  }

  /// Cells of the area that have no observer, since they have no ground.
  viewshed::MissingOnSheet places_without_observers(const StoreMetadata& metadata,
                                                    const viewshed::VisibilityIndex& index) const {
    std::vector<std::uint8_t> missing(index.grid.cell_count());
    const Box data = metadata.grid.box(metadata.bounds);
    for (std::int64_t row = 0; row < index.grid.rows(); ++row) {
      for (std::int64_t column = 0; column < index.grid.columns(); ++column) {
        const Point2 place = index.grid.centre(column, row);
        const std::size_t i = index.grid.index({column, row});
        missing[i] = std::isnan(index.share[i]) && data.contains(place) && request_.area.contains(place);
      }
    }
    viewshed::MissingGround share;
    share.without_ground = static_cast<std::uint64_t>(std::count(missing.begin(), missing.end(), 1));
    share.with_ground = index.observers;
    share.cell_area = index.grid.cell_area();
    return viewshed::missing_on_sheet(viewshed::PlacesWithoutGround({{index.grid, std::move(missing)}}), share,
                                      "the area of observers");
  }

  void write_sheet(const Store& store, const viewshed::VisibilityIndex& index, std::vector<std::string> sources,
                   Progress& progress) const {
    const StoreMetadata& metadata = store.metadata();
    viewshed::ResultSheet sheet{
        index.grid,
        index.grid.bounds(),
        viewshed::result_map(index),
        "Share of the ground within the radius that is seen",
        viewshed::in_cells(index.grid, [&](std::size_t cell) { return !std::isnan(index.share[cell]); }),
        {},
        {},
        places_without_observers(metadata, index)};
    profile::TitleBlock& block = sheet.title;
    block.title = "How much is seen from everywhere";
    block.statement = viewshed::statement_of(metadata, request_.themes, request_.detail);
    block.facts = {{"Observers", fmt::format("at the centres of cells of {:g} m, {:g} m above the ground",
                                             request_.cell_size, request_.height)},
                   {"Targets", targets_in_words(index.sample)},
                   {"Radius", fmt::format("{:g} km", request_.radius / 1000)},
                   {"Undecided", fmt::format("{:.2f} % on average, which ground without data alone could hide",
                                             100 * index.mean_undecided)},
                   {"Earth", request_.earth.convention()},
                   viewshed::terrain_fact(metadata, request_.detail)};
    block.sources = std::move(sources);
    write_file(sheet_.file(),
               draw_result_sheet(store, sheet, sheet_.papers().front(), sheet_.choice(), sheet_.file(), progress),
               policy_.overwrite);
  }

  std::string store_, output_, cell_text_, radius_text_, height_text_, target_text_, rays_text_, targets_text_;
  MemoryOption memory_;
  WindowOptions window_;
  DetailOptions detail_;
  ThemeOptions themes_;
  EarthOptions earth_;
  NoDataOption nodata_;
  SheetOptions sheet_;
  OutputPolicy policy_;
  viewshed::IndexRequest request_;
  std::optional<Store> opened_;
  viewshed::IndexTasks* answered_ = nullptr;  ///< what others have found, in place of computing it
};

}  // namespace

std::unique_ptr<Verb> make_visibility_verb() {
  return std::make_unique<VisibilityVerb>();
}

}  // namespace itin::cli
