#include "viewshed/foliage_rasters.hpp"

#include <array>
#include <limits>
#include <span>
#include <vector>

#include <itin/document.hpp>
#include <itin/raster.hpp>

namespace itin::cli {

namespace {

struct FoliageRaster {
  const char* ending;
  const char* band;
  std::vector<float> viewshed::FoliageView::*values;
};
constexpr std::array kFoliageRasters{
    FoliageRaster{"foliage", "metres of foliage on the sight line", &viewshed::FoliageView::length_m},
    FoliageRaster{"transmittance", "share of the light that comes through", &viewshed::FoliageView::transmittance}};

/// NAME-ending.tif beside NAME.tif.
std::string raster_beside(const std::string& raster, const std::string& ending) {
  const std::size_t dot = raster.rfind('.');
  return raster.substr(0, dot) + "-" + ending + raster.substr(dot);
}

}  // namespace

void claim_foliage_rasters(ViewshedOutputs& outputs) {
  for (const std::string& raster : outputs.given_rasters())
    for (const FoliageRaster& kind : kFoliageRasters) outputs.claim_beside(raster_beside(raster, kind.ending));
}

void write_foliage_rasters(const ViewshedOutputs& outputs, const StoreMetadata& metadata,
                           const viewshed::ThroughFoliage& through, const std::string& foliage,
                           const Progress& progress) {
  const viewshed::Result& result = through.computed.result;
  RasterDescription description;
  description.crs_wkt = metadata.crs_wkt;
  description.nodata = std::numeric_limits<double>::quiet_NaN();
  description.metadata = {
      {"itin", ITIN_VERSION},
      {"surface", json_text(surface_document(metadata, result.request.detail, result.request.themes))},
      {"foliage", foliage}};
  description.overwrite = outputs.overwrite();
  for (const std::string& raster : outputs.given_rasters()) {
    for (const FoliageRaster& kind : kFoliageRasters) {
      description.band_name = kind.band;
      write_raster(raster_beside(raster, kind.ending), result.grid,
                   std::span<const float>(through.foliage.*kind.values), description, progress);
    }
  }
}

}  // namespace itin::cli
