#include <array>
#include <limits>
#include <span>

#include <itin/document.hpp>
#include <itin/raster.hpp>
#include <viewshed/result_raster.hpp>

namespace itin::viewshed {

namespace {

struct FoliageRaster {
  const char* ending;
  const char* band;
  std::vector<float> FoliageView::*values;
};
constexpr std::array kFoliageRasters{
    FoliageRaster{"foliage", "metres of foliage on the sight line", &FoliageView::length_m},
    FoliageRaster{"transmittance", "share of the light that comes through", &FoliageView::transmittance}};

/// NAME-ending.tif beside NAME.tif.
std::string raster_beside(const std::string& raster, const std::string& ending) {
  const std::size_t dot = raster.rfind('.');
  return raster.substr(0, dot) + "-" + ending + raster.substr(dot);
}

}  // namespace

std::vector<std::string> foliage_rasters_beside(const std::string& raster) {
  std::vector<std::string> paths;
  for (const FoliageRaster& kind : kFoliageRasters) paths.push_back(raster_beside(raster, kind.ending));
  return paths;
}

void write_foliage_rasters(const std::string& raster, const Result& result, const FoliageView& view,
                           const StoreMetadata& metadata, const ResultRasterOptions& options,
                           const Progress& progress) {
  RasterDescription description;
  description.crs_wkt = metadata.crs_wkt;
  description.nodata = std::numeric_limits<double>::quiet_NaN();
  description.metadata = {
      {"itin", ITIN_VERSION},
      {"surface", json_text(surface_document(metadata, result.request.detail, result.request.themes))},
      {"foliage", options.foliage}};
  description.overwrite = options.overwrite;
  for (const FoliageRaster& kind : kFoliageRasters) {
    description.band_name = kind.band;
    write_raster(raster_beside(raster, kind.ending), result.grid, std::span<const float>(view.*kind.values),
                 description, progress);
  }
}

}  // namespace itin::viewshed
