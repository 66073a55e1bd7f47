#include "import/footprints/city_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>
#include <itin/height_limit.hpp>

#include "features/plan/plan_overlay.hpp"
#include "gdal/crs.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "import/footprints/city_faces.hpp"
#include "import/footprints/city_geometry.hpp"
#include "import/footprints/city_json_attributes.hpp"
#include "import/footprints/city_json_values.hpp"
#include "import/footprints/city_vertices.hpp"
#include "import/source/crs_doubts.hpp"
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
      : query_(query), findings_(query.path), documents_(parse(query)), attributes_(query.path, query.kept) {
    in_place({}, [&] { find_crs(to_crs); });
  }

  FootprintSource read() {
    in_place({}, [&] {
      check_templates(head(), CityJsonCounts(head(), head()));
      for (const Json& document : documents_) read(document);
      attributes_.finish(objects_);
      keep_attributes();
    });
    for (std::string& doubt : crs_doubts(query_.path, crs_, vertices_->extent()))
      source_.warnings.push_back(std::move(doubt));
    for (const auto& [type, count] : others_)
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
  static std::vector<Json> parse(const CityJsonQuery& query) {
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

  /// The document that has what is the same for all: CRS, transform, templates.
  const Json& head() const { return documents_.front(); }

  void find_crs(const std::string& to_crs) {
    crs_ = source_crs(query_.path, query_.crs, reference_system(head()), Elevations::in_coordinates);
    if (query_.datums != nullptr) query_.datums->add(crs_, query_.path);
    SourceHeights heights = source_heights(query_.path, std::nullopt, crs_);
    vertices_.emplace(head(), crs_, heights.axis.factor(), to_crs, query_.path);
    source_.crs = std::move(heights.crs);
    if (!heights.warning.empty()) source_.warnings.push_back(std::move(heights.warning));
  }

  void read(const Json& document) {
    const CityJsonCounts counts(document, head());
    const std::size_t first = vertices_->add(document.at("vertices"));
    for (const auto& [name, value] : member_or_empty(document, "CityObjects", Json::value_t::object).items())
      in_place(name, [&, &key = name, &city_object = value] { read(key, city_object, counts, first); });
  }

  void read(const std::string& name, const Json& city_object, const CityJsonCounts& counts, std::size_t first) {
    const Json& geometries = member_or_empty(city_object, "geometry", Json::value_t::array);
    for (const Json& geometry : geometries) check_indices(geometry, counts);
    if (!is_building(city_object)) {
      ++others_[text_member(city_object, "type")];
      return;
    }
    if (!objects_.try_emplace(name, &city_object).second) return pass_over(name, "is in the file already");
    attributes_.note(city_object);
    if (!geometries.empty()) {
      add(name, geometries, first);
    } else if (!city_object.contains("children")) {
      pass_over(name, "has no geometry");
    }
  }

  /// Gives features their names, ids and attributes; so far they have been called by their keys.
  void keep_attributes() {
    source_.fields = attributes_.fields();
    for (FootprintFeature& feature : source_.features) {
      FeatureRecord record = attributes_.record(feature.name);
      if (!record.name.empty()) feature.name = record.name;
      if (query_.kept.any()) source_.records.push_back(std::move(record));
    }
  }

  void pass_over(const std::string& name, const std::string& why) {
    findings_.add(fmt::format("{}: passed over: {}", name, why));
  }

  /// Adds the building, whose document's vertex 0 has the number `first`.
  void add(const std::string& name, const Json& geometries, std::size_t first) {
    const CityGeometry finest = finest_geometry(geometries, head());
    if (finest.shape == nullptr)
      return pass_over(name, fmt::format("none of its geometries ({} ...) is a surface or solid",
                                         text_member(geometries.front(), "type")));
    if (!finest.is_instance()) return add(name, faces_of_shape(*finest.shape, first), vertices_->placed());
    const std::size_t about = first + finest.own->at("boundaries").at(0).get<std::size_t>();
    add(name, faces_of_shape(*finest.shape, 0),
        vertices_->instance(member(head().at("geometry-templates"), "vertices-templates"),
                            finest.own->at("transformationMatrix"), about));
  }

  void add(const std::string& name, const std::vector<CityFace>& faces, const std::vector<Point3>& vertices) {
    if (!all_have_places(name, faces, vertices))
      return pass_over(name, "a vertex has no place in the CRS of the store");
    BuildingTop top;
    try {
      top = top_of(faces, vertices);
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

  /// Throws InputError for a height beyond all heights.
  bool all_have_places(const std::string& name, const std::vector<CityFace>& faces,
                       const std::vector<Point3>& vertices) const {
    bool all = true;
    for (const CityFace& face : faces) {
      for (const auto& ring : face.rings) {
        for (const std::uint32_t v : ring) {
          if (!is_height(vertices[v].z)) require_height(vertices[v].z, query_.path + ": " + name);
          all = all && std::isfinite(vertices[v].x) && std::isfinite(vertices[v].y);
        }
      }
    }
    return all;
  }

  const CityJsonQuery& query_;
  Findings findings_;
  const std::vector<Json> documents_;  ///< one, or the first one and the features of a sequence
  CityJsonAttributes attributes_;
  CityObjects objects_;  ///< the buildings of all documents
  Crs crs_;
  std::optional<CityVertices> vertices_;
  std::map<std::string, int> others_;  ///< numbers of objects that are no buildings, by type
  std::size_t closures_ = 0;           ///< number of closures that were left out
  std::string closed_;                 ///< the first building with one
  FootprintSource source_;
};

}  // namespace

FootprintSource read_city_json(const CityJsonQuery& query, const std::string& to_crs) {
  const QuietGdal quiet;
  return CityModel(query, to_crs).read();
}

}  // namespace itin
