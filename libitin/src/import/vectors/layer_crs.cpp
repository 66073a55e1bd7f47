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

/// Says that the CRS `given` is not used, where it is another than the layer's own. Returns nothing where it is the
/// same.
std::string unused_warning(const OGRSpatialReference& own, const std::string& path, const std::string& name,
                           const std::string& given) {
  if (given.empty()) return "";
  const std::string option = "`in_crs` " + given;
  if (same_crs(horizontal_crs(wkt_of(own), path), horizontal_crs(given, option))) return "";
  return fmt::format("{}: states its CRS, {}, which counts; {} does not count for it", path, name, option);
}

}  // namespace

LayerCrs crs_of_layer(OGRLayer& layer, const std::string& path, const std::string& given) {
  const OGRSpatialReference* own = layer.GetSpatialRef();
  if (own == nullptr) return {given, ""};
  const bool defined = own->IsProjected() || own->IsGeographic();
  const bool wrong = defined && !given.empty() && own->IsGeographic() && lies_beyond_degrees(layer);
  const std::string name = own->GetName() != nullptr ? own->GetName() : "unnamed";
  if (defined && !wrong) return {wkt_of(*own), unused_warning(*own, path, name, given)};
  return {given, fmt::format("{}: the CRS that it states, {}, {}; its places are taken to be in {}", path, name,
                             wrong ? "cannot have its coordinates" : "is not defined",
                             given.empty() ? "the store's" : "`in_crs` " + given)};
}

}  // namespace itin
