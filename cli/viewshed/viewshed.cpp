// itin viewshed: what observers see.

#include <filesystem>
#include <future>
#include <optional>

#include <fmt/format.h>

#include <itin/beside.hpp>
#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/sources_in.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/exact_cost.hpp>
#include <viewshed/hidden_eyes.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_raster.hpp>
#include <viewshed/viewshed.hpp>

#include "options/detail_options.hpp"
#include "options/earth_options.hpp"
#include "options/engine_option.hpp"
#include "options/memory_option.hpp"
#include "options/nodata_option.hpp"
#include "options/observer_options.hpp"
#include "options/sheet_options.hpp"
#include "options/surface_options.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/verb.hpp"
#include "viewshed/feature_raster.hpp"
#include "viewshed/horizon_output.hpp"
#include "viewshed/viewshed_outputs.hpp"
#include "viewshed/viewshed_radio.hpp"
#include "viewshed/viewshed_sheet.hpp"
#include "viewshed/viewshed_targets.hpp"
#include "viewshed/viewshed_text.hpp"

namespace itin::cli {

namespace {

std::vector<Point3> eyes_of(const viewshed::Result& result) {
  std::vector<Point3> eyes;
  for (std::size_t i = 0; i < result.request.observers.size(); ++i) {
    const viewshed::Observer& observer = result.request.observers[i];
    eyes.push_back(
        {observer.position.x, observer.position.y, observer.height + (observer.absolute ? 0 : result.ground_m[i])});
  }
  return eyes;
}

class ViewshedVerb final : public Verb {
 public:
  std::string name() const override { return "viewshed"; }
  std::string summary() const override { return "Write what observers see, as a raster and a map"; }

  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    observers_.declare(app);
    targets_.declare(app);
    begin_group(app, "What each cell has");
    app.add_option(
           "--mode", mode_text_,
           "One of these:\n"
           "visible - whether any observer sees it (default)\n"
           "certified - certainly visible, certainly hidden, or undecided at this tolerance\n"
           "count - how many observers see it\n"
           "which - one bit for each observer, in UInt32 bands of 32\n"
           "nearest - two bands: distance and number of the nearest observer that sees it\n"
           "angle - elevation angle of the sight line in degrees, the greatest of several observers; at an observer's "
           "own place -90 or 90, and 0 at the height of its eye\n"
           "height - the least height above the ground at which a target is seen, metres; no value where none is or is "
           "known\n"
           "blocker - two bands: theme and feature of what first hides it from the nearest observer; none where the "
           "target itself is below the ground, 4294967294 where ground without data comes first\n"
           "probability - two bands: the probability of being visible under --vertical-error, and 1, 0 or 2 for "
           "visible, hidden or undecided as the heights are stored")
        ->type_name("MODE");
    app.add_option("--vertical-error", sigma_text_, "Standard deviation of heights, for --mode probability")
        ->type_name("METRES");
    app.add_option("--error-correlation", correlation_text_,
                   "L: errors x apart are correlated as exp(-x / L) (default: 0, independent)")
        ->type_name("METRES");
    outputs_.declare(app);
    features_.declare(app);
    sheet_.declare_file(app);
    horizon_.declare(app);
    radio_.declare(app);
    detail_.declare(app, "the observer");
    themes_.declare(app);
    earth_.declare(app);
    nodata_.declare(app);
    app.add_flag("--precise", precise_, "Exact for the full surface: the same as --tolerance 0");
    engine_.declare(app);
    memory_.declare(app, kReadInParts);
  }

  void validate() override {
    horizon_.validate();
    features_.validate();
    sheet_.validate();
    outputs_.validate(other_outputs());
    observers_.validate();
    targets_.validate(observers_, request_);
    detail_.validate();
    themes_.validate();
    request_.themes = themes_.choice();
    earth_.validate();
    request_.earth = earth_.earth();
    request_.engine = engine_.engine();
    radio_.validate();
    if (!mode_text_.empty()) parse_mode();
    if (radio_.is_given()) radio_.complete(request_);
    request_.nodata = nodata_.rule();
    validate_vertical_error();
    validate_precise();
  }

  Document parameters() const override {
    Document parameters{{"store", store_}, {"observers", observers_document(request_.observers)}};
    parameters.update(observers_.parameters());
    parameters.update(horizon_.parameters());
    parameters["mode"] = mode_name();
    parameters["precise"] = precise_;
    parameters.update(targets_.parameters(request_));
    if (request_.mode == viewshed::Mode::kProbability) {
      parameters["vertical_error_m"] = request_.vertical_error.sigma;
      parameters["error_correlation_m"] = request_.vertical_error.correlation_length;
    }
    parameters.update(radio_.parameters());
    parameters["observer_on"] = request_.observers_on_surface ? "surface" : "ground";
    parameters.update(detail_.parameters());
    parameters.update(themes_.parameters());
    parameters["nodata"] = nodata_.text();
    return parameters;
  }

  Result execute(Progress& progress) override {
    const std::future<void> rasters = beside(make_gdal_ready);
    const Store store(store_, cache_within(compute_options_.memory_bytes));
    const StoreMetadata& metadata = store.metadata();
    Result result;
    earth_.take_body_of(metadata);
    request_.earth = earth_.earth();
    complete_request(metadata, result.warnings);
    request_.themes.check(metadata.themes);
    features_.require_themes(metadata, request_.themes);
    if (!horizon_.paths().empty() && request_.observers.size() > 1)
      throw InputError("--horizon is that of one observer; give one");
    outputs_.prepare(request_);
    for (const std::string& raster : features_.paths()) outputs_.claim_style(raster);
    compute_options_.whole_surface = outputs_.draws_map() || !horizon_.paths().empty();
    viewshed::ViewshedWithSurface computed = survey(store, request_, progress);
    const viewshed::MissingGround missing = viewshed::missing_ground(store, computed.result, progress);
    const std::vector<SourceInfo> sources = sources_in(store, looked_at(computed.result), request_.themes);
    const ViewshedOutputs::Context context{metadata, certified_, missing, described(sources, metadata)};
    result.warnings.insert(result.warnings.end(), computed.result.warnings.begin(), computed.result.warnings.end());
    if (const auto warning = missing.warning("the area looked at")) result.warnings.push_back(in_options(*warning));
    if (computed.result.cells.in_view() == 0)
      result.warnings.emplace_back(
          "no cell has its centre in view of an observer and on ground data: check --cell, --radius and the field of "
          "view");
    warn_of_grid(metadata, result.warnings);
    if (radio_.is_given()) earth_.warn_of_light(result.warnings);
    // Certified and exact answers are about the full surface.
    viewshed::Request answered = computed.result.request;
    if (precise_ || certified_) answered.detail = Detail::tolerance(0);
    // The horizon comes before the other files, for it refuses targets that no line reaches.
    const Document targets =
        horizon_.write(store, computed, answered, compute_options_, outputs_.overwrite(), progress, result.warnings);
    outputs_.write(store, computed, context, result.warnings, progress);
    write_viewshed_sheet(store, computed.result, sheet_, {missing, context.sources}, outputs_.overwrite(), progress);
    outputs_.write_each([&](std::size_t i) { return compute_for_observer(store, computed, i, progress); }, context,
                        progress);
    if (!answered.observers_on_surface)
      viewshed::warn_of_hidden_eyes(store, {"observer", eyes_of(computed.result), answered.detail, answered.themes},
                                    result.warnings);
    const Document features = features_.write(store, computed.result.grid, {answered.detail, request_.themes},
                                              outputs_.overwrite(), progress);
    result.document = viewshed::viewshed_document(metadata, computed.result);
    viewshed::add_missing_ground(missing, result.document);
    result.document["sources"] = sources_document(sources);
    result.document["outputs"] = outputs_.paths();
    if (!features.is_null()) result.document["features"] = features;
    if (request_.mode == viewshed::Mode::kBlocker)
      result.document["blockers"] = viewshed::blockers_document(store, computed.result);
    if (!targets.empty()) result.document["horizon_targets"] = targets;
    result.text = text(metadata, computed.result, missing);
    if (!certified_ && viewshed::exact_costs_no_more(store, computed.result.request))
      result.text += "the exact answer takes no longer over this raster: leave out --tolerance\n";
    return result;
  }

 private:
  /// The box that all sight lines from the observers to the cells lie in.
  static Box looked_at(const viewshed::Result& result) {
    Box box = result.grid.bounds();
    for (const viewshed::Observer& observer : result.request.observers) box.extend(observer.position);
    return box;
  }

  std::vector<std::string> other_outputs() const {
    std::vector<std::string> paths = horizon_.paths();
    for (const std::string& path : features_.paths()) paths.push_back(path);
    if (!sheet_.file().empty()) paths.push_back(sheet_.file());
    return paths;
  }

  void parse_mode() {
    if (radio_.is_given())
      throw InputError("--frequency judges Fresnel zones, or losses with --loss, and nothing else: leave out --mode");
    // The modes of radio come last, and have options of their own.
    const auto modes = viewshed::mode_names().first(viewshed::mode_names().size() - 2);
    std::vector<std::string_view> choices(modes.begin(), modes.end());
    choices.emplace_back("certified");  // the name by which certificates tell the visible
    const std::size_t mode = parse_choice("--mode", mode_text_, choices);
    certified_ = choices[mode] == "certified";
    request_.mode = certified_ ? viewshed::Mode::kVisible : static_cast<viewshed::Mode>(mode);
  }
  std::string mode_name() const { return viewshed::mode_name(request_.mode, certified_); }

  void validate_vertical_error() {
    const bool wanted = request_.mode == viewshed::Mode::kProbability;
    if (wanted != !sigma_text_.empty())
      throw InputError("--mode probability and --vertical-error METRES need each other; give both");
    if (!wanted && !correlation_text_.empty()) throw InputError("--error-correlation works only with --vertical-error");
    viewshed::VerticalError& error = request_.vertical_error;
    if (wanted) error.sigma = parse_number("--vertical-error", sigma_text_, Range::kPositive);
    if (!correlation_text_.empty())
      error.correlation_length = parse_number("--error-correlation", correlation_text_, Range::kNotNegative);
  }

  void validate_precise() {
    compute_options_.memory_bytes = memory_.bytes().value_or(compute_options_.memory_bytes);
    const bool exact = !certified_ && !detail_.has_rings() && !request_detail_given();
    if (precise_ && certified_)
      throw InputError(
          "--precise is exact, and --mode certified says what a tolerance leaves open: give one of the two");
    if (precise_ && !exact)
      throw InputError("--precise is exact for the full surface: leave out --tolerance and --rings");
    precise_ = exact;  // even if it was not asked for by this name
  }
  bool request_detail_given() const { return detail_.detail({}).coarsest() > 0; }

  viewshed::ViewshedWithSurface survey(const Store& store, const viewshed::Request& request, Progress& progress) const {
    if (certified_) return viewshed::compute_certified(store, request, compute_options_, progress);
    return viewshed::compute_with_surface(store, request, compute_options_, progress);
  }
  viewshed::Result compute_for_observer(const Store& store, const viewshed::ViewshedWithSurface& all,
                                        std::size_t observer, Progress& progress) const {
    const viewshed::Request request = viewshed::request_for_observer(all.result, observer);
    return all.whole ? viewshed::compute_on_surface(store, all, request, progress)
                     : survey(store, request, progress).result;
  }

  /// Completes the request from the store's CRS and the fields of files.
  void complete_request(const StoreMetadata& metadata, std::vector<std::string>& warnings) {
    targets_.complete(metadata, request_);
    request_.observers = observers_.observers(metadata, request_, targets_.height_given(), warnings);
    if (detail_.has_rings() && request_.observers.size() > 1) {
      throw InputError("--rings lie about one observer; for several give --tolerance");
    }
    request_.detail = detail_.detail(request_.observers.front().position);
    horizon_.read_targets(request_, targets_, observers_.in_crs(), metadata, warnings);
  }

  std::string text(const StoreMetadata& metadata, const viewshed::Result& result,
                   const viewshed::MissingGround& missing) const {
    std::string text;
    for (const std::string& path : outputs_.paths())
      text += fmt::format("{}: {}\n", path, readable_bytes(std::filesystem::file_size(path)));
    return text + observers_.text() + targets_.text(request_) + viewshed_text(metadata, result, missing);
  }

  std::string store_, mode_text_;
  MemoryOption memory_;
  std::string sigma_text_, correlation_text_;
  bool certified_ = false, precise_ = false;
  viewshed::ComputeOptions compute_options_;
  ObserverOptions observers_;
  ViewshedTargets targets_;
  DetailOptions detail_;
  ThemeOptions themes_;
  EarthOptions earth_;
  NoDataOption nodata_;
  EngineOption engine_;
  ViewshedRadio radio_;
  ViewshedOutputs outputs_;
  SheetOptions sheet_;
  HorizonOutput horizon_;
  FeatureRaster features_;

  viewshed::Request request_;
};

}  // namespace

std::unique_ptr<Verb> make_viewshed_verb() {
  return std::make_unique<ViewshedVerb>();
}

}  // namespace itin::cli
