// itin viewshed: what observers see.

#include <filesystem>
#include <future>
#include <optional>

#include <fmt/format.h>

#include <itin/beside.hpp>
#include <itin/error.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/sources_in.hpp>
#include <itin/store.hpp>
#include <profile/foliage_text.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/exact_cost.hpp>
#include <viewshed/foliage_view.hpp>
#include <viewshed/hidden_eyes.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_raster.hpp>
#include <viewshed/tasks.hpp>
#include <viewshed/viewshed.hpp>

#include "options/memory_option.hpp"
#include "options/sheet_options.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/verb.hpp"
#include "viewshed/feature_raster.hpp"
#include "viewshed/horizon_output.hpp"
#include "viewshed/view_options.hpp"
#include "viewshed/view_warnings.hpp"
#include "viewshed/viewshed_outputs.hpp"
#include "viewshed/viewshed_sheet.hpp"
#include "viewshed/viewshed_text.hpp"
#include "viewshed/viewshed_title.hpp"

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
    view_.declare_view(app);
    outputs_.declare(app);
    features_.declare(app);
    sheet_.declare_file(app);
    horizon_.declare(app);
    view_.declare_surface(app);
    memory_.declare(app, kReadInParts);
  }

  void validate() override {
    horizon_.validate();
    features_.validate();
    sheet_.validate();
    outputs_.validate(other_outputs());
    view_.validate();
    if (view_.foliage().given() && (outputs_.writes_each() || !horizon_.paths().empty()))
      throw InputError(
          "--foliage sees through woods in rasters, polygons, maps and sheets: leave out --each and --horizon");
    compute_options_.memory_bytes = memory_.bytes().value_or(compute_options_.memory_bytes);
  }

  Document parameters() const override {
    Document parameters{{"store", store_}};
    parameters.update(view_.observer_parameters());
    parameters.update(horizon_.parameters());
    parameters.update(view_.parameters());
    return parameters;
  }

  std::unique_ptr<viewshed::Tasks> divide(std::uint64_t most_cells, Progress& progress) override {
    const std::string together = "is made of the whole viewshed, and a job divides it; leave it out";
    if (outputs_.draws_map()) throw InputError("--image " + together + ", or give --sheet");
    if (outputs_.writes_each()) throw InputError("--each " + together);
    if (!horizon_.paths().empty()) throw InputError("--horizon " + together);
    if (view_.foliage().given()) throw InputError("--foliage " + together);
    std::vector<std::string> warnings;
    const viewshed::Request& request = view_.complete(open_store(), warnings, progress);
    request.themes.check(opened_->metadata().themes);
    return std::make_unique<viewshed::ViewshedTasks>(
        *opened_, request, compute_options_, most_cells,
        view_.certified() ? viewshed::Certainty::kCertified : viewshed::Certainty::kExact);
  }
  bool writes_by_parts() const override { return !outputs_.writes_polygons() && sheet_.file().empty(); }
  void take_answers(viewshed::Tasks& answered) override {
    answered_ = &dynamic_cast<viewshed::ViewshedTasks&>(answered);
  }

  Result execute(Progress& progress) override {
    const std::future<void> rasters = beside(make_gdal_ready);
    const Store& store = open_store();
    const StoreMetadata& metadata = store.metadata();
    Result result;
    const viewshed::Request& request = view_.complete(store, result.warnings, progress);
    horizon_.read_targets(request, view_.targets(), view_.observers().in_crs(), metadata, result.warnings);
    request.themes.check(metadata.themes);
    features_.require_themes(metadata, request.themes);
    if (!horizon_.paths().empty() && request.observers.size() > 1)
      throw InputError("--horizon is that of one observer; give one");
    outputs_.prepare(request, metadata.crs_wkt);
    for (const std::string& raster : features_.paths()) outputs_.claim_style(raster);
    const FoliageOptions& foliage = view_.foliage();
    const std::string woods = foliage.given() ? profile::foliage_rule_text(foliage.foliage()) : "";
    if (foliage.given()) claim_foliage_rasters();
    compute_options_.whole_surface = outputs_.draws_map() || !horizon_.paths().empty();
    viewshed::ThroughFoliage through = survey(store, request, progress);
    viewshed::ViewshedWithSurface& computed = through.computed;
    const viewshed::MissingGround missing = viewshed::missing_ground(store, computed.result, progress);
    const std::vector<SourceInfo> sources = sources_in(store, looked_at(computed.result), request.themes);
    const ViewshedOutputs::Context context{metadata, view_.certified(), missing, described(sources, metadata), woods};
    add_view_warnings(metadata, view_, computed.result, missing, result.warnings);
    viewshed::Request answered = computed.result.request;
    answered.detail = answered_detail(computed.result);
    // The horizon comes before the other files, for it refuses targets that no line reaches.
    const Document targets =
        horizon_.write(store, computed, answered, compute_options_, outputs_.overwrite(), progress, result.warnings);
    outputs_.write(store, computed, context, progress);
    if (foliage.given())
      for (const std::string& raster : outputs_.given_rasters())
        viewshed::write_foliage_rasters(raster, computed.result, through.foliage, metadata,
                                        {.overwrite = outputs_.overwrite(), .foliage = woods}, progress);
    write_viewshed_sheet(store, computed.result, sheet_, {missing, context.sources, woods}, outputs_.overwrite(),
                         progress);
    outputs_.write_each([&](std::size_t i) { return compute_for_observer(store, computed, i, progress); }, context,
                        progress);
    if (!answered.observers_on_surface)
      viewshed::warn_of_hidden_eyes(store,
                                    {"observer", eyes_of(computed.result), answered.detail,
                                     foliage.given() ? answered.themes.without_vegetation() : answered.themes},
                                    result.warnings);
    const Document features =
        features_.write(store, computed.result.grid, {answered.detail, request.themes}, outputs_.overwrite(), progress);
    result.document = viewshed::viewshed_document(metadata, computed.result);
    viewshed::add_missing_ground(missing, result.document);
    result.document["sources"] = sources_document(sources);
    result.document["outputs"] = outputs_.paths();
    if (!features.is_null()) result.document["features"] = features;
    if (request.mode == viewshed::Mode::kBlocker)
      result.document["blockers"] = viewshed::blockers_document(store, computed.result);
    if (!targets.empty()) result.document["horizon_targets"] = targets;
    result.text = text(metadata, computed.result, missing);
    if (foliage.given()) result.text += "through foliage: " + woods + "\n";
    if (!view_.certified() && viewshed::exact_costs_no_more(store, computed.result.request))
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

  /// Lists the rasters that are written beside those of -o, through foliage. Throws FileError, InputError.
  void claim_foliage_rasters() {
    for (const std::string& raster : outputs_.given_rasters())
      for (const std::string& beside : viewshed::foliage_rasters_beside(raster)) outputs_.claim_beside(beside);
  }

  /// Computes the viewshed; its foliage is empty where woods are solid.
  viewshed::ThroughFoliage survey(const Store& store, const viewshed::Request& request, Progress& progress) const {
    if (answered_ != nullptr) return {{nullptr, std::nullopt, false, answered_->take()}, {}};
    if (view_.certified()) return {viewshed::compute_certified(store, request, compute_options_, progress), {}};
    if (view_.foliage().given())
      return viewshed::compute_through_foliage(store, request, view_.foliage().foliage(), compute_options_, progress);
    return {viewshed::compute_with_surface(store, request, compute_options_, progress), {}};
  }
  viewshed::Result compute_for_observer(const Store& store, const viewshed::ViewshedWithSurface& all,
                                        std::size_t observer, Progress& progress) const {
    const viewshed::Request request = viewshed::request_for_observer(all.result, observer);
    return all.whole ? viewshed::compute_on_surface(store, all, request, progress)
                     : survey(store, request, progress).computed.result;
  }

  std::string text(const StoreMetadata& metadata, const viewshed::Result& result,
                   const viewshed::MissingGround& missing) const {
    std::string text;
    for (const std::string& path : outputs_.paths())
      text += fmt::format("{}: {}\n", path, readable_bytes(std::filesystem::file_size(path)));
    return text + view_.observers().text() + view_.targets().text(view_.request()) +
           viewshed_text(metadata, result, missing);
  }

  const Store& open_store() { return opened_.emplace(store_, cache_within(compute_options_.memory_bytes)); }

  std::string store_;
  std::optional<Store> opened_;
  viewshed::ViewshedTasks* answered_ = nullptr;  ///< what others have found, in place of computing it
  ViewOptions view_;
  MemoryOption memory_;
  viewshed::ComputeOptions compute_options_;
  ViewshedOutputs outputs_;
  SheetOptions sheet_;
  HorizonOutput horizon_;
  FeatureRaster features_;
};

}  // namespace

std::unique_ptr<Verb> make_viewshed_verb() {
  return std::make_unique<ViewshedVerb>();
}

}  // namespace itin::cli
