#include "import/city_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>

#include "import/crs.hpp"
#include "import/quiet_gdal.hpp"
#include "import/source_context.hpp"

namespace itin {

namespace {

using Json = nlohmann::json;
using Index = std::uint32_t;

enum class Facing { up, down, other };

struct Surface {
  std::vector<std::vector<Index>> rings;
  Facing facing = Facing::other;
};

struct SurfacePlane {
  std::array<double, 3> normal{};  ///< a unit vector
  double offset = 0;
};

/// Planes closer than this in direction, and in metres, are one.
constexpr double kSameDirection = 1e-3, kSamePlace = 0.02;
/// The least upward part of a unit normal for a surface that is no wall.
constexpr double kUpright = 0.05;
/// Bytes of memory that a byte of text takes while it is read.
constexpr std::uint64_t kMemoryPerByte = 16;

class CityModel {
 public:
  CityModel(const CityJsonQuery& query, const std::string& to_crs) : query_(query), model_(parse(query)) {
    place_vertices(to_crs);
  }

  FootprintSource read() {
    std::map<std::string, int> others;
    for (const auto& [name, object] : model_.at("CityObjects").items()) {
      const std::string type = object.at("type");
      if (type != "Building" && type != "BuildingPart") {
        ++others[type];
      } else if (object.contains("geometry") && !object.at("geometry").empty()) {
        add(name, object.at("geometry"));
      } else if (!object.contains("children")) {
        pass_over(name, "has no geometry");
      }
    }
    for (const auto& [type, count] : others)
      source_.warnings.push_back(fmt::format("{}: {} objects of type {} passed over", query_.path, count, type));
    return std::move(source_);
  }

 private:
  static Json parse(const CityJsonQuery& query) {
    const std::string& path = query.path;
    std::ifstream file(path);
    if (!file) throw FileError(path, "cannot be read");
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(path, unknown);
    if (!unknown && bytes > query.memory_bytes / kMemoryPerByte)
      throw InputError(
          fmt::format("{}: {} MB of CityJSON take some {} MB of memory to read, more than the {} MB there "
                      "are to work in; give more, or cut the model into parts",
                      path, bytes >> 20, bytes * kMemoryPerByte >> 20, query.memory_bytes >> 20));
    Json model = Json::parse(file);
    if (model.value("type", "") != "CityJSON") throw FileError(path, "is not CityJSON");
    return model;
  }

  /// "EPSG:7415" of "urn:ogc:def:crs:EPSG::7415" and of "https://www.opengis.net/def/crs/EPSG/0/7415".
  std::string reference_system() const {
    const std::string text = model_.value("/metadata/referenceSystem"_json_pointer, std::string());
    const std::size_t at = text.find_last_not_of("0123456789");
    if (text.find("EPSG") == std::string::npos || at == std::string::npos || at + 1 == text.size()) return text;
    return "EPSG:" + text.substr(at + 1);
  }

  void place_vertices(const std::string& to_crs) {
    std::array<double, 3> scale{1, 1, 1}, shift{0, 0, 0};
    if (model_.contains("transform")) {
      scale = model_.at("transform").at("scale");
      shift = model_.at("transform").at("translate");
    }
    const Crs crs = source_crs(query_.path, query_.crs, reference_system());
    source_.crs = crs.whole;
    const double metres = height_unit(query_.path, std::nullopt, crs).metres;
    std::vector<double> x, y;
    for (const Json& vertex : model_.at("vertices")) {
      const std::array<double, 3> v = vertex;
      x.push_back(v[0] * scale[0] + shift[0]);
      y.push_back(v[1] * scale[1] + shift[1]);
      vertices_.push_back({0, 0, (v[2] * scale[2] + shift[2]) * metres});
    }
    PointTransform(crs.wkt, to_crs, query_.path).transform(x, y);
    for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_[i].x = x[i], vertices_[i].y = y[i];
  }

  void pass_over(const std::string& name, const std::string& why) {
    source_.warnings.push_back(fmt::format("{}: {}: passed over: {}", query_.path, name, why));
  }

  void add(const std::string& name, const Json& geometries) {
    const Json* best = nullptr;
    double finest = -1;
    for (const Json& geometry : geometries) {
      const double detail = level_of_detail(geometry);
      if (depth_of(geometry.at("type")) == 0 || detail >= 3 || detail <= finest) continue;
      best = &geometry;
      finest = detail;
    }
    if (!best)
      return pass_over(name, fmt::format("none of its geometries ({} ...) is a surface or solid of LoD 1 or 2",
                                         geometries.front().at("type").get<std::string>()));
    std::vector<Surface> surfaces;
    const Json semantics = best->value("semantics", Json::object());
    collect(best->at("boundaries"), semantics.value("values", Json()), semantics, depth_of(best->at("type")), surfaces);
    add(name, surfaces);
  }

  static double level_of_detail(const Json& geometry) {
    const Json lod = geometry.value("lod", Json("0"));
    return lod.is_string() ? std::strtod(lod.get_ref<const std::string&>().c_str(), nullptr) : lod.get<double>();
  }

  /// How many arrays enclose a surface; 0 for geometries without surfaces.
  static int depth_of(const std::string& type) {
    if (type == "MultiSurface" || type == "CompositeSurface") return 1;
    if (type == "Solid") return 2;
    if (type == "MultiSolid" || type == "CompositeSolid") return 3;
    return 0;
  }

  void collect(const Json& boundaries, const Json& values, const Json& semantics, int depth,
               std::vector<Surface>& out) {
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
      const Json value = values.is_array() && i < values.size() ? values[i] : Json();
      if (depth > 1) {
        collect(boundaries[i], value, semantics, depth - 1, out);
        continue;
      }
      Surface surface{boundaries[i].get<std::vector<std::vector<Index>>>(), Facing::other};
      if (surface.rings.empty() || surface.rings.front().size() < 3) continue;
      for (const auto& ring : surface.rings)
        for (const Index v : ring)
          if (v >= vertices_.size())
            throw FileError(query_.path, fmt::format("vertex {} of {} does not exist", v, vertices_.size()));
      surface.facing = value.is_number_integer() ? named_facing(semantics.at("surfaces").at(value.get<std::size_t>()))
                                                 : facing(surface);
      out.push_back(std::move(surface));
    }
  }

  static Facing named_facing(const Json& semantic) {
    const std::string type = semantic.value("type", "");
    return type == "RoofSurface" ? Facing::up : type == "GroundSurface" ? Facing::down : Facing::other;
  }

  SurfacePlane plane(const Surface& surface) const {
    const std::vector<Index>& ring = surface.rings.front();
    const Point3& o = vertices_[ring.front()];
    std::array<double, 3> n{};
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point3 &p = vertices_[ring[i]], &q = vertices_[ring[(i + 1) % ring.size()]];
      n[0] += (p.y - o.y) * (q.z - o.z) - (p.z - o.z) * (q.y - o.y);
      n[1] += (p.z - o.z) * (q.x - o.x) - (p.x - o.x) * (q.z - o.z);
      n[2] += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
    }
    const double length = std::hypot(n[0], n[1], n[2]);
    if (length > 0) n = {n[0] / length, n[1] / length, n[2] / length};
    return {n, n[0] * o.x + n[1] * o.y + n[2] * o.z};
  }

  Facing facing(const Surface& surface) const {
    const double up = plane(surface).normal[2];
    return up > kUpright ? Facing::up : up < -kUpright ? Facing::down : Facing::other;
  }

  void add(const std::string& name, const std::vector<Surface>& surfaces) {
    std::vector<Surface> roofs, grounds;
    for (const Surface& surface : surfaces) {
      if (surface.facing == Facing::up) roofs.push_back(surface);
      if (surface.facing == Facing::down) grounds.push_back(surface);
    }
    if (roofs.empty()) return pass_over(name, "has no roof surface");
    FootprintFeature feature;
    feature.name = name;
    for (const auto& piece : plane_pieces(roofs)) {
      RoofSurface& roof = feature.surfaces.emplace_back();
      for (const auto& ring : piece) {
        auto& points = roof.rings.emplace_back();
        for (const Index v : ring) points.push_back(vertices_[v]);
      }
    }
    // Solids without a floor stand on the feet of their walls.
    for (const Surface& ground : grounds.empty() ? surfaces : grounds)
      for (const auto& ring : ground.rings)
        for (const Index v : ring) feature.base = std::min(feature.base.value_or(vertices_[v].z), vertices_[v].z);
    if (!query_.ground_as_base) feature.base.reset();
    source_.features.push_back(std::move(feature));
  }

  using Rings = std::vector<std::vector<Index>>;

  /// Surfaces joined where they share an edge and a plane.
  std::vector<Rings> plane_pieces(const std::vector<Surface>& surfaces) const {
    std::vector<SurfacePlane> planes;
    for (const Surface& s : surfaces) planes.push_back(plane(s));
    std::vector<std::size_t> parent(surfaces.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    std::map<std::pair<Index, Index>, std::size_t> left_of;
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      for_each_edge(surfaces[s].rings, [&](Index a, Index b) { left_of[{a, b}] = s; });
    for (const auto& [edge, s] : left_of) {
      const auto other = left_of.find({edge.second, edge.first});
      if (other == left_of.end() || !same_plane(planes[s], planes[other->second], edge.first)) continue;
      const auto [a, b] = std::minmax({find(s), find(other->second)});
      parent[b] = a;
    }
    std::map<std::size_t, std::vector<const Surface*>> groups;
    for (std::size_t s = 0; s < surfaces.size(); ++s) groups[find(s)].push_back(&surfaces[s]);
    std::vector<Rings> pieces;
    for (const auto& [first, group] : groups) pieces.push_back(outline(group));
    return pieces;
  }

  bool same_plane(const SurfacePlane& a, const SurfacePlane& b, Index shared) const {
    double turn = 0;
    for (std::size_t i = 0; i < 3; ++i) turn = std::max(turn, std::abs(a.normal[i] - b.normal[i]));
    const Point3& p = vertices_[shared];
    const auto off = [&](const SurfacePlane& s) {
      return std::abs(s.normal[0] * p.x + s.normal[1] * p.y + s.normal[2] * p.z - s.offset);
    };
    return turn < kSameDirection && off(a) < kSamePlace && off(b) < kSamePlace;
  }

  template <class Visit>
  static void for_each_edge(const Rings& rings, const Visit& visit) {
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  }

  /// The edges that have surface on one side only, as rings.
  static Rings outline(const std::vector<const Surface*>& surfaces) {
    if (surfaces.size() == 1) return surfaces.front()->rings;
    std::multiset<std::pair<Index, Index>> edges;
    for (const Surface* s : surfaces) {
      for_each_edge(s->rings, [&](Index a, Index b) {
        const auto reverse = edges.find({b, a});
        if (reverse == edges.end()) {
          edges.insert({a, b});
        } else {
          edges.erase(reverse);
        }
      });
    }
    Rings rings;
    while (!edges.empty()) {
      std::vector<Index>& ring = rings.emplace_back();
      auto edge = edges.begin();
      // Every vertex has as many edges in as out, so a walk ends where it began.
      while (edge != edges.end()) {
        const Index next = edge->second;
        ring.push_back(edge->first);
        edges.erase(edge);
        edge = edges.lower_bound({next, 0});
        if (edge != edges.end() && edge->first != next) edge = edges.end();
      }
    }
    return rings;
  }

  const CityJsonQuery& query_;
  const Json model_;
  std::vector<Point3> vertices_;
  FootprintSource source_;
};

}  // namespace

FootprintSource read_city_json(const CityJsonQuery& query, const std::string& to_crs) {
  const QuietGdal quiet;
  try {
    return CityModel(query, to_crs).read();
  } catch (const Json::exception& error) {
    throw FileError(query.path, std::string("is not understood as CityJSON: ") + error.what());
  }
}

}  // namespace itin
