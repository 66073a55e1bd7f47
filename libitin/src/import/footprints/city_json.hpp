// Reads buildings from CityJSON 1.0 to 2.0 (OGC 20-072r5) and CityJSONSeq: solids and surfaces, instances of templates.
//
// Each Building and BuildingPart gives its geometry of the greatest level of detail. Its top is made of the faces that
// are open to the sky (city_faces.hpp).
#pragma once

#include <cstdint>
#include <string>

#include "import/footprints/footprint_reader.hpp"

namespace itin {

struct CityJsonQuery {
  std::string path;
  std::string crs;  ///< overrides the file's own
  std::uint64_t memory_bytes = std::uint64_t{4} << 30;
  bool ground_as_base = true;        ///< base: that of the building's top; else the terrain's
  VerticalDatums* datums = nullptr;  ///< those of other sources, whose datum must be the same; null: it need not
  FeatureQuery kept;                 ///< attributes; an object is called by its key if it has no name or id among them
};

/// Reads the file, in the CRS `to_crs` (WKT). Objects that cannot be used are passed over with a warning: one line per
/// object, or one per type for objects that are no buildings. Throws FileError for a file that is not readable, is no
/// CityJSON, or holds an index that is no whole number in range (naming the object), and for an attribute that no
/// building has. Throws InputError for a CRS that is missing or unknown, for heights beyond kFarthestHeight, for
/// attributes that a store cannot keep and, before the file is read, for one that takes more than the memory.
FootprintSource read_city_json(const CityJsonQuery& query, const std::string& to_crs);

}  // namespace itin
