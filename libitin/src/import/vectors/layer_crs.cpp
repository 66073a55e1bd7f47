#include "import/vectors/layer_crs.hpp"

#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include "gdal/crs.hpp"

namespace itin {

namespace {

/// Whether the coordinates of a layer cannot be longitudes and latitudes.
bool lies_beyond_degrees(OGRLayer& layer) {
  OGREnvelope box;
  return layer.GetExtent(&box) == OGRERR_NONE && (box.MinX < -360 || box.MaxX > 360 || box.MinY < -90 || box.MaxY > 90);
}

}  // namespace

LayerCrs crs_of_layer(OGRLayer& layer, const std::string& path, const std::string& given) {
  const OGRSpatialReference* own = layer.GetSpatialRef();
  if (own == nullptr) return {given, ""};
  const bool defined = own->IsProjected() || own->IsGeographic();
  const bool wrong = defined && !given.empty() && own->IsGeographic() && lies_beyond_degrees(layer);
  if (defined && !wrong) return {wkt_of(*own), ""};
  const std::string name = own->GetName() != nullptr ? own->GetName() : "unnamed";
  return {given, fmt::format("{}: the CRS that it states, {}, {}; its places are taken to be in {}", path, name,
                             wrong ? "cannot have its coordinates" : "is not defined",
                             given.empty() ? "the store's" : "`in_crs` " + given)};
}

}  // namespace itin
