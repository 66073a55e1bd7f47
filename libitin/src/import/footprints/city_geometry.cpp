#include "import/footprints/city_geometry.hpp"

#include <string>
#include <utility>

#include "import/footprints/city_json_values.hpp"

namespace itin {

namespace {

using Json = nlohmann::json;

CityGeometry geometry_of(const Json& geometry, const Json& model) {
  if (text_member(geometry, "type") != "GeometryInstance") return {&geometry, &geometry};
  const Json& templates = member(member(model, "geometry-templates"), "templates");
  return {&geometry, &templates.at(member(geometry, "template").get<std::size_t>())};
}

FaceName name_of_face(const Json& semantics, const Json& number) {
  if (!number.is_number()) return FaceName::other;
  const auto& surfaces = items_of(member(semantics, "surfaces"), "semantic surfaces");
  const std::string type = text_member(surfaces[index_of(number, surfaces.size(), "semantic surfaces")], "type");
  if (type == "RoofSurface") return FaceName::roof;
  if (type == "GroundSurface") return FaceName::ground;
  return type == "ClosureSurface" ? FaceName::closure : FaceName::other;
}

std::vector<std::vector<std::uint32_t>> rings_of_face(const Json& surface, std::size_t first) {
  std::vector<std::vector<std::uint32_t>> rings;
  for (const Json& ring : items_of(surface, "rings")) {
    auto& indices = rings.emplace_back();
    for (const Json& number : items_of(ring, "vertex indices"))
      indices.push_back(static_cast<std::uint32_t>(first + number.get<std::size_t>()));
  }
  return rings;
}

struct FaceCollection {
  const Json& semantics;
  std::size_t first;
  std::vector<CityFace> faces;

  /// Collects what lies this many arrays deep, with what stands at the same places among the semantic values.
  void collect(const Json& boundaries, const Json& values, int depth) {
    const auto& items = items_of(boundaries, depth > 1 ? "shells or surfaces" : "surfaces");
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Json value = values.is_array() && i < values.size() ? values[i] : Json();
      if (depth > 1) {
        collect(items[i], value, depth - 1);
        continue;
      }
      CityFace face{rings_of_face(items[i], first), name_of_face(semantics, value)};
      if (!face.rings.empty() && face.rings.front().size() >= 3) faces.push_back(std::move(face));
    }
  }
};

}  // namespace

CityGeometry finest_geometry(const Json& geometries, const Json& model) {
  CityGeometry best;
  double finest = -1;
  for (const Json& geometry : geometries) {
    const CityGeometry candidate = geometry_of(geometry, model);
    const double detail = level_of_detail(*candidate.shape);
    // An object's own geometry comes before an instance of as much detail.
    const bool better = detail > finest || (detail == finest && best.is_instance() && !candidate.is_instance());
    if (depth_of(text_member(*candidate.shape, "type")) == 0 || !better) continue;
    best = candidate, finest = detail;
  }
  return best;
}

std::vector<CityFace> faces_of_shape(const Json& shape, std::size_t first) {
  const Json& semantics = member_or_empty(shape, "semantics", Json::value_t::object);
  FaceCollection collection{semantics, first, {}};
  collection.collect(member(shape, "boundaries"), semantics.value("values", Json()),
                     depth_of(text_member(shape, "type")));
  return std::move(collection.faces);
}

}  // namespace itin
