// Geometries of city objects: which one counts, and its faces.
#pragma once

#include <cstddef>
#include <vector>

#include <nlohmann/json.hpp>

#include "import/footprints/city_faces.hpp"

namespace itin {

/// A geometry, and the template that it is an instance of; itself where it is none.
struct CityGeometry {
  const nlohmann::json* own = nullptr;
  const nlohmann::json* shape = nullptr;

  bool is_instance() const { return own != shape; }
};

/// Returns the geometry with faces that has the greatest level of detail; null pointers where none has faces. `model`
/// has the templates. Precondition for both functions: check_indices() has passed. They throw BadCityJson.
CityGeometry finest_geometry(const nlohmann::json& geometries, const nlohmann::json& model);

/// Returns the faces of a geometry whose vertex 0 has the number `first`.
std::vector<CityFace> faces_of_shape(const nlohmann::json& shape, std::size_t first);

}  // namespace itin
