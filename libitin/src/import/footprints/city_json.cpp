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

#include "features/plan_overlay.hpp"
#include "gdal/crs.hpp"
#include "gdal/quiet_gdal.hpp"
#include "import/footprints/city_faces.hpp"
#include "import/footprints/city_json_attributes.hpp"
#include "import/footprints/city_json_values.hpp"
#include "import/source/findings.hpp"
#include "import/source/source_context.hpp"

namespace itin {

namespace {

using Json = nlohmann::json;

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
    if (closures_ > 0)
      source_.warnings.push_back(
          fmt::format("{}: {} ClosureSurface{} left out, of {} for instance; they close openings", query_.path,
                      closures_, closures_ == 1 ? "" : "s", closed_));
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
    const Crs crs = source_crs(query_.path, query_.crs, reference_system(), Elevations::in_coordinates);
    if (query_.datums != nullptr) query_.datums->add(crs, query_.path);
    SourceHeights heights = source_heights(query_.path, std::nullopt, crs);
    source_.crs = std::move(heights.crs);
    if (!heights.warning.empty()) source_.warnings.push_back(std::move(heights.warning));
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
    std::vector<CityFace> faces;
    const Json& semantics = member_or_empty(*best, "semantics", Json::value_t::object);
    collect(member(*best, "boundaries"), semantics.value("values", Json()), semantics,
            depth_of(text_member(*best, "type")), faces);
    if (!std::all_of(faces.begin(), faces.end(), [&](const CityFace& face) { return has_place(name, face); }))
      return pass_over(name, "a vertex has no place in the CRS of the store");
    add(name, faces);
  }

  void collect(const Json& boundaries, const Json& values, const Json& semantics, int depth,
               std::vector<CityFace>& out) const {
    const auto& items = items_of(boundaries, depth > 1 ? "shells or surfaces" : "surfaces");
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Json value = values.is_array() && i < values.size() ? values[i] : Json();
      if (depth > 1) {
        collect(items[i], value, semantics, depth - 1, out);
        continue;
      }
      CityFace face{rings_of(items[i])};
      if (face.rings.empty() || face.rings.front().size() < 3) continue;
      if (value.is_number()) face.name = face_name(semantic(semantics, value));
      out.push_back(std::move(face));
    }
  }

  std::vector<std::vector<std::uint32_t>> rings_of(const Json& surface) const {
    std::vector<std::vector<std::uint32_t>> rings;
    for (const Json& ring : items_of(surface, "rings")) {
      auto& indices = rings.emplace_back();
      for (const Json& number : items_of(ring, "vertex indices"))
        indices.push_back(static_cast<std::uint32_t>(index_of(number, vertices_.size(), "vertices")));
    }
    return rings;
  }

  /// Whether all vertices of the face have a place. Throws InputError for a height beyond all heights.
  bool has_place(const std::string& name, const CityFace& face) const {
    bool all = true;
    for (const auto& ring : face.rings) {
      for (const std::uint32_t v : ring) {
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

  static FaceName face_name(const Json& semantic) {
    const std::string type = text_member(semantic, "type");
    if (type == "RoofSurface") return FaceName::roof;
    if (type == "GroundSurface") return FaceName::ground;
    return type == "ClosureSurface" ? FaceName::closure : FaceName::other;
  }

  void add(const std::string& name, const std::vector<CityFace>& faces) {
    BuildingTop top;
    try {
      top = top_of(faces, vertices_);
    } catch (const OverlayError& error) {
      return pass_over(name, error.what());
    }
    if (top.closures > 0 && closures_ == 0) closed_ = name;
    closures_ += top.closures;
    if (top.surfaces.empty()) return pass_over(name, "has no roof: all of its faces are walls or floors");
    FootprintFeature& feature = source_.features.emplace_back();
    feature.name = name;
    feature.surfaces = std::move(top.surfaces);
    if (query_.ground_as_base) feature.base = top.base;
  }

  const CityJsonQuery& query_;
  Findings findings_;
  const Json model_;
  CityJsonAttributes attributes_;
  std::vector<Point3> vertices_;
  std::size_t closures_ = 0;  ///< number of closures that were left out
  std::string closed_;        ///< the first building with one
  FootprintSource source_;
};

}  // namespace

FootprintSource read_city_json(const CityJsonQuery& query, const std::string& to_crs) {
  const QuietGdal quiet;
  return CityModel(query, to_crs).read();
}

}  // namespace itin
