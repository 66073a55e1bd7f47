// What every reader of a vector layer asks first: which layer, which field, which features. Messages name what there
// is.
#pragma once

#include <string>

class GDALDataset;
class OGRLayer;

namespace itin {

/// The layer of that name; for an empty name the only one. Throws FileError.
OGRLayer& choose_layer(GDALDataset& dataset, const std::string& path, const std::string& name);

/// Throws FileError where the layer has no such field.
int field_of_layer(OGRLayer& layer, const std::string& path, const std::string& name);

/// Restricts what is read to `where`, in OGR's SQL or the database's own. Throws FileError for a field that the layer
/// has not, InputError for a clause that makes no sense. Within the life of a QuietGdal.
void select_features(OGRLayer& layer, const std::string& path, const std::string& where);

}  // namespace itin
