#include "viewshed/foliage_rasters.hpp"

#include <limits>
#include <span>

#include <itin/document.hpp>
#include <itin/raster.hpp>

namespace itin::cli {

namespace {

/// NAME-ending.tif beside NAME.tif.
std::string raster_beside(const std::string& raster, const std::string& ending) {
  const std::size_t dot = raster.rfind('.');
  return raster.substr(0, dot) + "-" + ending + raster.substr(dot);
}

}  // namespace

void claim_foliage_rasters(ViewshedOutputs& outputs) {
  for (const std::string& raster : outputs.given_rasters())
    for (const char* ending : {"foliage", "transmittance"}) outputs.claim_beside(raster_beside(raster, ending));
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
    description.band_name = "metres of foliage on the sight line";
    write_raster(raster_beside(raster, "foliage"), result.grid, std::span<const float>(through.foliage.length_m),
                 description, progress);
    description.band_name = "share of the light that comes through";
    write_raster(raster_beside(raster, "transmittance"), result.grid,
                 std::span<const float>(through.foliage.transmittance), description, progress);
  }
}

}  // namespace itin::cli
