#include "import/footprints/city_json_values.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <istream>
#include <regex>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>

#include "gdal/crs.hpp"

namespace itin {

namespace {

using Json = nlohmann::json;

/// The deepest nesting: solids, shells, surfaces, rings, indices. Deeper arrays are no CityJSON, and must not fill the
/// stack.
constexpr int kDeepestArray = 5;

/// Renders a value to fit in one line of a message.
std::string shown(const Json& value) {
  if (value.is_structured()) return fmt::format("an {}", value.type_name());
  const std::string text = value.dump(-1, ' ', true);
  return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

/// Calls check(number) for each innermost value but null.
template <class Check>
void for_each_value(const Json& nested, const Check& check, int depth = 0) {
  if (nested.is_null()) return;
  if (!nested.is_array()) return check(nested);
  if (depth == kDeepestArray) throw BadCityJson(fmt::format("arrays are nested more than {} deep", kDeepestArray));
  for (const Json& item : nested) for_each_value(item, check, depth + 1);
}

/// Checks the rings of a texture: the index of a texture, then the indices of its vertices.
void check_texture_rings(const Json& nested, const CityJsonCounts& counts, int depth = 0) {
  if (nested.is_null()) return;
  const auto& items = items_of(nested, "values of a texture");
  if (depth == kDeepestArray) throw BadCityJson(fmt::format("arrays are nested more than {} deep", kDeepestArray));
  if (!items.empty() && items.front().is_number()) {
    index_of(items.front(), counts.textures, "textures");
    for (std::size_t i = 1; i < items.size(); ++i) index_of(items[i], counts.texture_vertices, "texture vertices");
    return;
  }
  for (const Json& item : items) check_texture_rings(item, counts, depth + 1);
}

void check_instance(const Json& geometry, const CityJsonCounts& counts) {
  index_of(member(geometry, "template"), counts.templates, "geometry templates");
  const auto& matrix = items_of(member(geometry, "transformationMatrix"), "transformationMatrix");
  if (matrix.size() != 16)
    throw BadCityJson(fmt::format("transformationMatrix holds {} numbers, not 16", matrix.size()));
  if (items_of(member(geometry, "boundaries"), "boundaries").size() != 1)
    throw BadCityJson("'boundaries' of a GeometryInstance hold not one vertex");
  for (const Json& number : matrix)
    if (!number.is_number()) throw BadCityJson(shown(number) + " in transformationMatrix is no number");
}

void check_appearance(const Json& geometry, const CityJsonCounts& counts) {
  const auto material = [&](const Json& number) { index_of(number, counts.materials, "materials"); };
  for (const auto& [theme, use] : member_or_empty(geometry, "material", Json::value_t::object).items()) {
    for_each_value(member_or_empty(use, "values", Json::value_t::array), material);
    if (use.contains("value")) for_each_value(use.at("value"), material);
  }
  for (const auto& [theme, use] : member_or_empty(geometry, "texture", Json::value_t::object).items())
    check_texture_rings(member_or_empty(use, "values", Json::value_t::array), counts);
}

void check_geometry(const Json& geometry, std::size_t vertices, const CityJsonCounts& counts) {
  if (text_member(geometry, "type") == "GeometryInstance") check_instance(geometry, counts);
  const Json& boundaries = member(geometry, "boundaries");
  if (!boundaries.is_array()) throw BadCityJson(fmt::format("'boundaries' is {}, not an array", shown(boundaries)));
  for_each_value(boundaries, [&](const Json& number) { index_of(number, vertices, "vertices"); });
  const Json& semantics = member_or_empty(geometry, "semantics", Json::value_t::object);
  const std::size_t surfaces = member_or_empty(semantics, "surfaces", Json::value_t::array).size();
  for_each_value(member_or_empty(semantics, "values", Json::value_t::array),
                 [&](const Json& number) { index_of(number, surfaces, "semantic surfaces"); });
  check_appearance(geometry, counts);
}

}  // namespace

namespace {

/// Reads a document of this type. `line` says in messages where in the file it stands; it is empty for the whole file.
template <class Text>
Json parse_document(Text&& text, const std::string& type, const std::string& path, const std::string& line) {
  Json document;
  try {
    document = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw FileError(
        path, fmt::format("{}is no JSON: what stands at byte {} does not belong there, or the {} ends early", line,
                          error.byte, line.empty() ? "file" : "line"));
  } catch (const Json::exception&) {
    throw FileError(path, line + "holds a number beyond all bounds");
  }
  if (!document.is_object() || document.value("type", Json()) != type) throw FileError(path, line + "is not " + type);
  return document;
}

std::vector<Json> parse_sequence(std::istream& file, const std::string& path) {
  std::vector<Json> documents;
  std::string text;
  for (int number = 1; std::getline(file, text); ++number) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    documents.push_back(parse_document(text, documents.empty() ? "CityJSON" : "CityJSONFeature", path,
                                       fmt::format("line {} ", number)));
  }
  if (documents.empty()) throw FileError(path, "is not CityJSON");
  return documents;
}

}  // namespace

std::vector<Json> parse_city_json(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path, "cannot be read");
  if (ending_of(path) == ".jsonl") return parse_sequence(file, path);
  std::vector<Json> documents;
  documents.push_back(parse_document(file, "CityJSON", path, ""));
  return documents;
}

const Json& member(const Json& object, const char* name) {
  if (!object.is_object()) throw BadCityJson(fmt::format("{} where an object with '{}' belongs", shown(object), name));
  const auto found = object.find(name);
  if (found == object.end()) throw BadCityJson(fmt::format("has no '{}'", name));
  return *found;
}

const Json& member_or_empty(const Json& object, const char* name, Json::value_t type) {
  static const Json kNoItems = Json::array(), kNoMembers = Json::object();
  if (!object.is_object()) throw BadCityJson(fmt::format("{} where an object belongs", shown(object)));
  const auto found = object.find(name);
  if (found == object.end() || found->is_null()) return type == Json::value_t::array ? kNoItems : kNoMembers;
  if (found->type() != type)
    throw BadCityJson(fmt::format("'{}' is {}, not an {}", name, shown(*found), Json(type).type_name()));
  return *found;
}

std::string text_member(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (!value.is_string()) throw BadCityJson(fmt::format("'{}' is {}, not a text", name, shown(value)));
  return value.get<std::string>();
}

const Json::array_t& items_of(const Json& array, const char* what) {
  if (!array.is_array()) throw BadCityJson(fmt::format("{} where an array of {} belongs", shown(array), what));
  return array.get_ref<const Json::array_t&>();
}

std::array<double, 3> coordinates(const Json& array, const char* what) {
  const auto& items = items_of(array, what);
  if (items.size() != 3) throw BadCityJson(fmt::format("{}: {} numbers instead of 3", what, items.size()));
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!items[i].is_number()) throw BadCityJson(fmt::format("{}: {} is no number", what, shown(items[i])));
    result[i] = items[i].get<double>();
    if (!std::isfinite(result[i])) throw BadCityJson(fmt::format("{}: a number is not finite", what));
  }
  return result;
}

std::size_t index_of(const Json& number, std::size_t count, const char* what) {
  // A double keeps the number's sign, its fraction, and anything beyond 2^32.
  const double value = number.is_number() ? number.get<double>() : -1;
  if (!(value >= 0 && value < static_cast<double>(count)) || value != std::floor(value))
    throw BadCityJson(fmt::format("{} is no index of one of {} {}: a whole number from 0 on, below {}", shown(number),
                                  count, what, count));
  return static_cast<std::size_t>(value);
}

bool is_building(const Json& city_object) {
  const std::string type = text_member(city_object, "type");
  return type == "Building" || type == "BuildingPart";
}

double level_of_detail(const Json& geometry) {
  const auto lod = geometry.find("lod");
  if (lod == geometry.end()) return 0;
  if (lod->is_number()) return lod->get<double>();
  if (!lod->is_string()) throw BadCityJson(fmt::format("'lod' is {}, neither a number nor a text", shown(*lod)));
  return std::strtod(lod->get_ref<const std::string&>().c_str(), nullptr);
}

int depth_of(const std::string& type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 1;
  if (type == "Solid") return 2;
  if (type == "MultiSolid" || type == "CompositeSolid") return 3;
  return 0;
}

std::string reference_system(const Json& document) {
  const Json& metadata = member_or_empty(document, "metadata", Json::value_t::object);
  if (!metadata.contains("referenceSystem") || metadata.at("referenceSystem").is_null()) return {};
  const std::string text = text_member(metadata, "referenceSystem");
  // The version between authority and code may be missing.
  static const std::regex kCode("EPSG[:/][^:/,]*[:/]([0-9]+)|EPSG:([0-9]+)");
  std::vector<std::string> codes;
  for (std::sregex_iterator match(text.begin(), text.end(), kCode), end; match != end; ++match)
    codes.push_back((*match)[1].matched ? (*match)[1] : (*match)[2]);
  if (codes.empty() || codes.size() > 2) return text;
  const std::string plan = "EPSG:" + codes.front();
  // Some name a compound CRS and its own heights.
  return codes.size() == 1 || parse_any_crs(plan, "referenceSystem").heights ? plan : plan + "+" + codes.back();
}

CityJsonCounts::CityJsonCounts(const Json& document, const Json& model)
    : vertices(items_of(member(document, "vertices"), "vertices").size()) {
  using Kind = Json::value_t;
  const Json& shared = member_or_empty(model, "geometry-templates", Kind::object);
  templates = member_or_empty(shared, "templates", Kind::array).size();
  template_vertices = member_or_empty(shared, "vertices-templates", Kind::array).size();
  const Json& appearance = member_or_empty(document, "appearance", Kind::object);
  materials = member_or_empty(appearance, "materials", Kind::array).size();
  textures = member_or_empty(appearance, "textures", Kind::array).size();
  texture_vertices = member_or_empty(appearance, "vertices-texture", Kind::array).size();
}

void check_indices(const Json& geometry, const CityJsonCounts& counts) {
  check_geometry(geometry, counts.vertices, counts);
}

void check_templates(const Json& model, const CityJsonCounts& counts) {
  const Json& shared = member_or_empty(model, "geometry-templates", Json::value_t::object);
  for (const Json& geometry : member_or_empty(shared, "templates", Json::value_t::array))
    check_geometry(geometry, counts.template_vertices, counts);
}

}  // namespace itin
