// Values of a CityJSON document, each checked before it is used: a damaged or hostile file ends in one clear line.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace itin {

/// Why a value is not what CityJSON has there. The reader adds the file and the object.
class BadCityJson : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws FileError for a file that cannot be read, or is no JSON object of type CityJSON.
nlohmann::json parse_city_json(const std::string& path);

// All throw BadCityJson.
const nlohmann::json& member(const nlohmann::json& object, const char* name);
/// An array or object, empty where there is none, or null.
const nlohmann::json& member_or_empty(const nlohmann::json& object, const char* name, nlohmann::json::value_t type);
std::string text_member(const nlohmann::json& object, const char* name);
const nlohmann::json::array_t& items_of(const nlohmann::json& array, const char* what);
/// `what` the coordinates are of.
std::array<double, 3> coordinates(const nlohmann::json& array, const char* what);
/// A whole number below `count`; `what` the index is of.
std::size_t index_of(const nlohmann::json& number, std::size_t count, const char* what);
/// Whether the object is a building or a part of one.
bool is_building(const nlohmann::json& city_object);
/// Numbers and texts: "2", "2.2".
double level_of_detail(const nlohmann::json& geometry);
/// How many arrays enclose a surface; 0 for geometries without surfaces.
int depth_of(const std::string& type);

/// How many there are of what geometries refer to.
struct CityJsonCounts {
  explicit CityJsonCounts(const nlohmann::json& model);
  std::size_t vertices, templates, template_vertices, materials, textures, texture_vertices;
};

/// Every index in the geometry: of vertices, semantic surfaces, materials, textures and templates.
void check_indices(const nlohmann::json& geometry, const CityJsonCounts& counts);
/// Every index in the geometries that others are instances of.
void check_templates(const nlohmann::json& model, const CityJsonCounts& counts);

}  // namespace itin
