#include "import/vector_layer.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>

#include "import/quiet_gdal.hpp"

namespace itin {

OGRLayer& choose_layer(GDALDataset& dataset, const std::string& path, const std::string& name) {
  std::vector<std::string> names;
  for (OGRLayer* layer : dataset.GetLayers()) names.emplace_back(layer->GetName());
  if (names.empty()) throw FileError(path, "has no layers");
  if (name.empty()) {
    if (names.size() == 1) return *dataset.GetLayer(0);
    throw FileError(path, fmt::format("has several layers; choose one with --layer: {}", names));
  }
  if (OGRLayer* layer = dataset.GetLayerByName(name.c_str())) return *layer;
  throw FileError(path, fmt::format("has no layer '{}'; it has {}", name, names));
}

int field_of_layer(OGRLayer& layer, const std::string& path, const std::string& name) {
  const OGRFeatureDefn& definition = *layer.GetLayerDefn();
  const int index = definition.GetFieldIndex(name.c_str());
  if (index >= 0) return index;
  std::vector<std::string> names;
  for (int i = 0; i < definition.GetFieldCount(); ++i) names.emplace_back(definition.GetFieldDefn(i)->GetNameRef());
  throw FileError(path, fmt::format("layer '{}' has no field '{}'; it has {}", layer.GetName(), name, names));
}

void select_features(OGRLayer& layer, const std::string& path, const std::string& where) {
  // Databases look at the clause only when they count or read.
  const bool understood = layer.SetAttributeFilter(where.c_str()) == OGRERR_NONE && layer.GetFeatureCount() >= 0 &&
                          CPLGetLastErrorType() < CE_Failure;
  if (understood) return;
  const std::string reason = QuietGdal::message("unknown error");
  // OGR's own SQL, then SQLite's: the contract tells an unknown field from a clause that makes no sense.
  if (reason.find("not recognised as an available field") != std::string::npos ||
      reason.find("no such column") != std::string::npos)
    throw FileError(
        path, fmt::format("--where {} names a field that layer '{}' has not: {}", where, layer.GetName(), reason));
  throw InputError(fmt::format("{}: --where {} is not understood: {}", path, where, reason));
}

}  // namespace itin
