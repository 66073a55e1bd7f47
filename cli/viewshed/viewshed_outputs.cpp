#include "viewshed/viewshed_outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/vector_export.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/qgis_styles.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/result_raster.hpp>
#include <viewshed/result_sheet.hpp>

#include "output/file_names.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "viewshed/viewshed_radio.hpp"
#include "viewshed/viewshed_title.hpp"

namespace itin::cli {

namespace {

bool is_polygons(const std::string& path) {
  return ending_of(path) == ".gpkg" || ending_of(path) == ".geojson";
}

}  // namespace

void ViewshedOutputs::declare(CLI::App& app) {
  begin_group(app, kOutputs);
  writes(
      app.add_option(
             "-o,--output", outputs_,
             "A raster to write, a GeoTIFF (.tif), with a QGIS style beside it (.qml) but for the modes angle, height "
             "and nearest; or the regions of its classes as polygons, a GeoPackage (.gpkg) or GeoJSON (.geojson); may "
             "be given again")
          ->type_name("FILE")
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
  writes(app.add_option("--image", image_, "A map to write (.png, .jpg)")->type_name("FILE"));
  writes(app.add_option("--each", each_, "Also write the raster of every observer alone, as DIR/NAME.tif")
             ->type_name("DIR"));
  policy_.declare(app);
}

void ViewshedOutputs::validate(const std::vector<std::string>& others) {
  others_ = others;
  if (paths().empty() && each_.empty())
    throw InputError(
        "give an output: --output FILE.tif or FILE.gpkg, --image FILE.png, --sheet FILE.pdf, --each DIR, --horizon "
        "FILE.csv, or --features FILE.tif");
  for (const std::string& path : outputs_)
    if (!names_geotiff(path) && !is_polygons(path))
      throw InputError(fmt::format("--output '{}': a viewshed is written as .tif, .gpkg or .geojson", path));
  if (!image_.empty()) viewshed::require_image_format(image_);
}

void ViewshedOutputs::prepare(const viewshed::Request& request, const std::string& crs_wkt) {
  namespace fs = std::filesystem;
  for (const std::string& path : outputs_) require_crs_for(path, crs_wkt);
  for (const std::string& path : paths()) policy_.require_writable(path);
  if (!each_.empty()) {
    folder_.emplace(each_);
    FileNames names;
    for (std::size_t i = 0; i < request.observers.size(); ++i) {
      const std::string& given = request.observers[i].name;
      const std::string name = names.add(given.empty() ? std::to_string(i + 1) : given, i + 1);
      single_.push_back((fs::path(each_) / (name + ".tif")).string());
      if (folder_->made()) in_new_folder_.emplace_back(single_.back());
    }
  }
  for (const std::string& path : single_) policy_.claim(path);
  if (!viewshed::has_qgis_style(request.mode)) return;
  for (const std::string& path : rasters()) {
    claim_style(path);
    if (folder_ && folder_->made() && fs::path(path).parent_path() == fs::path(each_))
      in_new_folder_.emplace_back(styles_.back());
  }
}

void ViewshedOutputs::claim_style(const std::string& raster) {
  policy_.claim(styles_.emplace_back(viewshed::style_beside(raster)));
}

void ViewshedOutputs::claim_beside(const std::string& path) {
  policy_.claim(others_.emplace_back(path));
}

bool ViewshedOutputs::writes_polygons() const {
  return std::any_of(outputs_.begin(), outputs_.end(), is_polygons);
}

std::vector<std::string> ViewshedOutputs::given_rasters() const {
  std::vector<std::string> rasters;
  std::copy_if(outputs_.begin(), outputs_.end(), std::back_inserter(rasters),
               [](const std::string& path) { return !is_polygons(path); });
  return rasters;
}

std::vector<std::string> ViewshedOutputs::rasters() const {
  std::vector<std::string> rasters = single_;
  const std::vector<std::string> given = given_rasters();
  rasters.insert(rasters.end(), given.begin(), given.end());
  return rasters;
}

void ViewshedOutputs::write_raster(const std::string& path, const viewshed::Result& result, const Context& context,
                                   const Progress& progress) const {
  viewshed::write_result_raster(path, result, context.metadata, {context.certified, policy_.overwrite, context.foliage},
                                progress);
}

void ViewshedOutputs::write(const Store& store, viewshed::ViewshedWithSurface& computed, const Context& context,
                            Progress& progress) const {
  std::vector<std::uint8_t> no_data;
  if (!image_.empty() || writes_polygons()) no_data = viewshed::cells_without_ground(store, computed.result, progress);
  std::optional<viewshed::MapImage> map;
  if (!image_.empty()) {
    viewshed::MapOptions options;
    options.sources = context.sources;
    options.no_data = no_data;
    options.outside = kOutOfView;
    options.statement =
        viewshed::statement_of(context.metadata, computed.result.request.themes, answered_detail(computed.result));
    if (const auto radio = radio_criterion(computed.result.request)) options.facts.emplace_back("Radio", *radio);
    if (!context.foliage.empty()) options.facts.emplace_back("Foliage", context.foliage);
    options.title = title_of(computed.result) + (context.foliage.empty() ? "" : ", through foliage");
    options.crs_wkt = context.metadata.crs_wkt;
    if (context.missing.without_ground > 0) {
      options.no_data_text = context.missing.key_text(kAreaLookedAt);
    } else if (context.missing.share() > 0) {
      options.beyond_text = context.missing.text();
    }
    map = viewshed::draw_map(*computed.surface, computed.result, progress, options);
  }
  for (const std::string& path : outputs_) {
    if (is_polygons(path)) {
      viewshed::write_polygons(path, computed.result, context.metadata.crs_wkt, policy_.overwrite, no_data);
    } else {
      write_raster(path, computed.result, context, progress);
    }
  }
  if (map) viewshed::write_image(image_, *map, policy_.overwrite);
}

void ViewshedOutputs::write_each(const Compute& compute, const Context& context, const Progress& progress) {
  for (std::size_t i = 0; i < single_.size(); ++i) write_raster(single_[i], compute(i), context, progress);
  for (Unfinished& raster : in_new_folder_) raster.finish([] {});
}

std::vector<std::string> ViewshedOutputs::paths() const {
  std::vector<std::string> paths = outputs_;
  if (!image_.empty()) paths.push_back(image_);
  paths.insert(paths.end(), single_.begin(), single_.end());
  paths.insert(paths.end(), styles_.begin(), styles_.end());
  paths.insert(paths.end(), others_.begin(), others_.end());
  return paths;
}

}  // namespace itin::cli
