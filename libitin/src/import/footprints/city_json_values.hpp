// Values of a CityJSON document, each checked before it is used: a damaged or hostile file ends in one clear line.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace itin {

/// Says why a value is not what CityJSON requires. The reader adds the file and the object.
class BadCityJson : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a file: a document, or a CityJSONSeq (.jsonl), whose first line is a document and whose further lines are
/// features. Throws FileError for a file that cannot be read, or does not hold these.
std::vector<nlohmann::json> parse_city_json(const std::string& path);

// All of these functions throw BadCityJson.
const nlohmann::json& member(const nlohmann::json& object, const char* name);
/// Returns an array or object; an empty one where the member is missing, or null.
const nlohmann::json& member_or_empty(const nlohmann::json& object, const char* name, nlohmann::json::value_t type);
std::string text_member(const nlohmann::json& object, const char* name);
const nlohmann::json::array_t& items_of(const nlohmann::json& array, const char* what);
/// Returns three coordinates. `what` names the thing at these coordinates.
std::array<double, 3> coordinates(const nlohmann::json& array, const char* what);
/// Returns a whole number below `count`; `what` names the things that it is an index of.
std::size_t index_of(const nlohmann::json& number, std::size_t count, const char* what);
/// Whether the object is a building or a part of one.
bool is_building(const nlohmann::json& city_object);
/// Returns the level of detail, which may be a number or a text: "2", "2.2".
double level_of_detail(const nlohmann::json& geometry);
/// The number of arrays that enclose a surface; 0 for geometries without surfaces.
int depth_of(const std::string& type);
/// Returns the CRS that a document states, as GDAL understands it: "EPSG:7415" for "urn:ogc:def:crs:EPSG::7415" and
/// "https://www.opengis.net/def/crs/EPSG/0/7415", and "EPSG:28992+5709" for a compound of two; empty where it states
/// none.
std::string reference_system(const nlohmann::json& document);

/// The numbers of things that geometries refer to.
struct CityJsonCounts {
  /// Counts the things of a document, or of a feature of one; `model` has the templates.
  CityJsonCounts(const nlohmann::json& document, const nlohmann::json& model);
  std::size_t vertices, templates, template_vertices, materials, textures, texture_vertices;
};

/// Checks every index in the geometry: of vertices, semantic surfaces, materials, textures and templates.
void check_indices(const nlohmann::json& geometry, const CityJsonCounts& counts);
/// Checks every index in the templates, the geometries that others are instances of.
void check_templates(const nlohmann::json& model, const CityJsonCounts& counts);

}  // namespace itin
