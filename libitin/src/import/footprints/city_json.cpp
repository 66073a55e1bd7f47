#include "import/footprints/city_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>
#include <itin/height_limit.hpp>

#include "base/disjoint_sets.hpp"
#include "gdal/crs.hpp"
#include "gdal/quiet_gdal.hpp"
#include "import/footprints/city_json_attributes.hpp"
#include "import/footprints/city_json_values.hpp"
#include "import/source/findings.hpp"
#include "import/source/source_context.hpp"

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

/// Planes that differ by less than this in direction, and in metres, are one.
constexpr double kSameDirection = 1e-3, kSamePlace = 0.02;
/// The least upward part of a unit normal for a surface that is no wall.
constexpr double kUpright = 0.05;
/// Bytes of memory that a byte of text takes while it is read.
constexpr std::uint64_t kMemoryPerByte = 16;

class CityModel {
 public:
  CityModel(const CityJsonQuery& query, const std::string& to_crs)
      : query_(query), findings_(query.path), model_(parse(query)), attributes_(query.path, query.kept) {
    in_place({}, [&] { place_vertices(to_crs); });
  }

  FootprintSource read() {
    std::map<std::string, int> others;
    in_place({}, [&] {
      const CityJsonCounts counts(model_);
      check_templates(model_, counts);
      const Json& objects = member_or_empty(model_, "CityObjects", Json::value_t::object);
      for (const auto& [name, value] : objects.items())
        in_place(name, [&, &title = name, &city_object = value] { read(title, city_object, counts, others); });
      keep_attributes(objects);
    });
    for (const auto& [type, count] : others)
      source_.warnings.push_back(fmt::format("{}: {} objects of type {} passed over", query_.path, count, type));
    for (std::string& line : findings_.lines()) source_.warnings.push_back(std::move(line));
    for (std::string& line : attributes_.warnings()) source_.warnings.push_back(std::move(line));
    return std::move(source_);
  }

 private:
  static Json parse(const CityJsonQuery& query) {
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(query.path, unknown);
    if (!unknown && bytes > query.memory_bytes / kMemoryPerByte)
      throw InputError(
          fmt::format("{}: {} MB of CityJSON take some {} MB of memory to read, more than the {} MB there "
                      "are to work in; give more, or cut the model into parts",
                      query.path, bytes >> 20, bytes * kMemoryPerByte >> 20, query.memory_bytes >> 20));
    return parse_city_json(query.path);
  }

  /// Reports an error of `read` as one in this object of the file, or in the file where there is no name.
  template <class Read>
  void in_place(const std::string& name, const Read& read) const {
    try {
      read();
    } catch (const BadCityJson& error) {
      throw FileError(query_.path, name.empty() ? error.what() : fmt::format("{}: {}", name, error.what()));
    }
  }

  void read(const std::string& name, const Json& city_object, const CityJsonCounts& counts,
            std::map<std::string, int>& others) {
    const Json& geometries = member_or_empty(city_object, "geometry", Json::value_t::array);
    for (const Json& geometry : geometries) check_indices(geometry, counts);
    if (!is_building(city_object)) {
      ++others[text_member(city_object, "type")];
      return;
    }
    attributes_.note(city_object);
    if (!geometries.empty()) {
      add(name, geometries);
    } else if (!city_object.contains("children")) {
      pass_over(name, "has no geometry");
    }
  }

  /// Gives features their names, ids and attributes; so far they have been called by their keys.
  void keep_attributes(const Json& objects) {
    attributes_.finish(objects);
    source_.fields = attributes_.fields();
    for (FootprintFeature& feature : source_.features) {
      FeatureRecord record = attributes_.record(feature.name);
      if (!record.name.empty()) feature.name = record.name;
      if (query_.kept.any()) source_.records.push_back(std::move(record));
    }
  }

  /// Returns "EPSG:7415" for "urn:ogc:def:crs:EPSG::7415" and for "https://www.opengis.net/def/crs/EPSG/0/7415".
  std::string reference_system() const {
    const Json& metadata = member_or_empty(model_, "metadata", Json::value_t::object);
    if (!metadata.contains("referenceSystem") || metadata.at("referenceSystem").is_null()) return {};
    const std::string text = text_member(metadata, "referenceSystem");
    const std::size_t at = text.find_last_not_of("0123456789");
    if (text.find("EPSG") == std::string::npos || at == std::string::npos || at + 1 == text.size()) return text;
    return "EPSG:" + text.substr(at + 1);
  }

  void place_vertices(const std::string& to_crs) {
    std::array<double, 3> scale{1, 1, 1}, shift{0, 0, 0};
    if (model_.contains("transform")) {
      scale = coordinates(member(model_.at("transform"), "scale"), "scale of the transform");
      shift = coordinates(member(model_.at("transform"), "translate"), "translate of the transform");
    }
    const Crs crs = source_crs(query_.path, query_.crs, reference_system());
    const SourceHeights heights = source_heights(query_.path, std::nullopt, crs);
    source_.crs = heights.crs;
    const double metres = heights.axis.factor();
    std::vector<double> x, y;
    for (const Json& vertex : items_of(member(model_, "vertices"), "vertices")) {
      const std::array<double, 3> v = coordinates(vertex, "vertices");
      x.push_back(v[0] * scale[0] + shift[0]);
      y.push_back(v[1] * scale[1] + shift[1]);
      vertices_.push_back({0, 0, (v[2] * scale[2] + shift[2]) * metres});
    }
    PointTransform(crs.wkt, to_crs, query_.path).transform(x, y);
    for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_[i].x = x[i], vertices_[i].y = y[i];
  }

  void pass_over(const std::string& name, const std::string& why) {
    findings_.add(fmt::format("{}: passed over: {}", name, why));
  }

  void add(const std::string& name, const Json& geometries) {
    const Json* best = nullptr;
    double finest = -1;
    for (const Json& geometry : geometries) {
      const double detail = level_of_detail(geometry);
      if (depth_of(text_member(geometry, "type")) == 0 || detail >= 3 || detail <= finest) continue;
      best = &geometry;
      finest = detail;
    }
    if (!best)
      return pass_over(name, fmt::format("none of its geometries ({} ...) is a surface or solid of LoD 1 or 2",
                                         text_member(geometries.front(), "type")));
    std::vector<Surface> surfaces;
    const Json& semantics = member_or_empty(*best, "semantics", Json::value_t::object);
    collect(member(*best, "boundaries"), semantics.value("values", Json()), semantics,
            depth_of(text_member(*best, "type")), surfaces);
    if (!std::all_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) { return has_place(name, s); }))
      return pass_over(name, "a vertex has no place in the CRS of the store");
    add(name, surfaces);
  }

  void collect(const Json& boundaries, const Json& values, const Json& semantics, int depth,
               std::vector<Surface>& out) const {
    const auto& items = items_of(boundaries, depth > 1 ? "shells or surfaces" : "surfaces");
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Json value = values.is_array() && i < values.size() ? values[i] : Json();
      if (depth > 1) {
        collect(items[i], value, semantics, depth - 1, out);
        continue;
      }
      Surface surface{rings_of(items[i]), Facing::other};
      if (surface.rings.empty() || surface.rings.front().size() < 3) continue;
      surface.facing = value.is_number() ? named_facing(semantic(semantics, value)) : facing(surface);
      out.push_back(std::move(surface));
    }
  }

  std::vector<std::vector<Index>> rings_of(const Json& surface) const {
    std::vector<std::vector<Index>> rings;
    for (const Json& ring : items_of(surface, "rings")) {
      auto& indices = rings.emplace_back();
      for (const Json& number : items_of(ring, "vertex indices"))
        indices.push_back(static_cast<Index>(index_of(number, vertices_.size(), "vertices")));
    }
    return rings;
  }

  /// Whether all vertices of the surface have a place. Throws InputError for a height beyond all heights.
  bool has_place(const std::string& name, const Surface& surface) const {
    bool all = true;
    for (const auto& ring : surface.rings) {
      for (const Index v : ring) {
        if (!is_height(vertices_[v].z)) require_height(vertices_[v].z, query_.path + ": " + name);
        all = all && std::isfinite(vertices_[v].x) && std::isfinite(vertices_[v].y);
      }
    }
    return all;
  }

  static const Json& semantic(const Json& semantics, const Json& number) {
    const auto& surfaces = items_of(member(semantics, "surfaces"), "semantic surfaces");
    return surfaces[index_of(number, surfaces.size(), "semantic surfaces")];
  }

  static Facing named_facing(const Json& semantic) {
    const std::string type = text_member(semantic, "type");
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

  /// Joins surfaces where they share an edge and a plane.
  std::vector<Rings> plane_pieces(const std::vector<Surface>& surfaces) const {
    std::vector<SurfacePlane> planes;
    for (const Surface& s : surfaces) planes.push_back(plane(s));
    const auto count = static_cast<std::uint32_t>(surfaces.size());
    DisjointSets sets(count);
    std::map<std::pair<Index, Index>, std::uint32_t> left_of;
    for (std::uint32_t s = 0; s < count; ++s)
      for_each_edge(surfaces[s].rings, [&](Index a, Index b) { left_of[{a, b}] = s; });
    for (const auto& [edge, s] : left_of) {
      const auto other = left_of.find({edge.second, edge.first});
      if (other == left_of.end() || !same_plane(planes[s], planes[other->second], edge.first)) continue;
      sets.join(s, other->second);
    }
    std::map<std::uint32_t, std::vector<const Surface*>> groups;
    for (std::uint32_t s = 0; s < count; ++s) groups[sets.least(s)].push_back(&surfaces[s]);
    std::vector<Rings> pieces;
    for (const auto& [first, group] : groups) pieces.push_back(outline(group));
    return pieces;
  }

  bool same_plane(const SurfacePlane& a, const SurfacePlane& b, Index shared) const {
    double deviation = 0;
    for (std::size_t i = 0; i < 3; ++i) deviation = std::max(deviation, std::abs(a.normal[i] - b.normal[i]));
    const Point3& p = vertices_[shared];
    const auto off = [&](const SurfacePlane& s) {
      return std::abs(s.normal[0] * p.x + s.normal[1] * p.y + s.normal[2] * p.z - s.offset);
    };
    return deviation < kSameDirection && off(a) < kSamePlace && off(b) < kSamePlace;
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
  Findings findings_;
  const Json model_;
  CityJsonAttributes attributes_;
  std::vector<Point3> vertices_;
  FootprintSource source_;
};

}  // namespace

FootprintSource read_city_json(const CityJsonQuery& query, const std::string& to_crs) {
  const QuietGdal quiet;
  return CityModel(query, to_crs).read();
}

}  // namespace itin
