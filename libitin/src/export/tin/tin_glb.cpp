#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "export/export_metadata.hpp"
#include "export/glb_file.hpp"
#include "export/step_progress.hpp"
#include "export/tin/tin_formats.hpp"

namespace itin {

namespace {

using OrderedJson = nlohmann::ordered_json;
using namespace gltf;

class GlbWriter {
 public:
  GlbWriter(const Tin& tin, const TinExportOptions& options) : tin_(tin), options_(options) {
    for (const Triangle& t : tin.triangles) by_theme_[tin.theme(t)].push_back(t);
    box_ = {};
    for (const GridPoint& p : tin.vertices) {
      box_.extend(p.x, p.y);
      zmin_ = std::min(zmin_, p.z), zmax_ = std::max(zmax_, p.z);
    }
    if (tin.vertices.empty()) return;
    const auto middle = [](std::int32_t low, std::int32_t high) {
      return static_cast<std::int32_t>((std::int64_t{low} + high) / 2);
    };
    origin_ = {middle(box_.xmin, box_.xmax), middle(box_.ymin, box_.ymax), middle(zmin_, zmax_)};
  }

  void write(const PendingFile& output, Progress& progress) const {
    GlbLayout layout;
    const OrderedJson document = this->document(layout);
    BufferedFile file(output);
    begin_glb(file, document, layout.bytes());
    write_buffer(file, progress);
    file.close();
  }

 private:
  GltfVector position(const GridPoint& p) const {
    const double r = tin_.grid.resolution;
    return gltf_axes((p.x - origin_.x) * r, (p.y - origin_.y) * r, (double{1} * p.z - origin_.z) * r);
  }

  OrderedJson document(GlbLayout& layout) const {
    OrderedJson document = begun_glb();
    OrderedJson scene =
        empty_glb_scene(parsed_metadata(options_.metadata_json), tin_.grid.point(origin_), options_.crs_wkt);
    if (!tin_.triangles.empty()) {
      scene["nodes"] = {0};
      document["nodes"] = OrderedJson::array({{{"name", "surface"}, {"mesh", 0}}});
      add_mesh(document, layout);
    }
    document["scenes"] = OrderedJson::array({std::move(scene)});
    return document;
  }

  void add_mesh(OrderedJson& document, GlbLayout& layout) const {
    const std::size_t n = tin_.vertices.size(), m = 3 * tin_.triangles.size();
    // z south is -north: the largest northing is the least z.
    const GltfVector low = position({box_.xmin, box_.ymax, zmin_}), high = position({box_.xmax, box_.ymin, zmax_});
    document["accessors"] = {
        {{"bufferView", layout.add(n, 12, kArrayBuffer)},
         {"componentType", kFloat},
         {"count", n},
         {"type", "VEC3"},
         {"min", low},
         {"max", high}},
        {{"bufferView", layout.add(n, 12, kArrayBuffer)}, {"componentType", kFloat}, {"count", n}, {"type", "VEC3"}},
        {{"bufferView", layout.add(n, 4, kArrayBuffer)},
         {"componentType", kUnsignedByte},
         {"normalized", true},
         {"count", n},
         {"type", "VEC4"}},
        {{"bufferView", layout.add(n, 8, kArrayBuffer)},
         {"componentType", kUnsignedShort},
         {"count", n},
         {"type", "VEC4"}},
        {{"bufferView", layout.add(n, 4, kArrayBuffer)},
         {"componentType", kUnsignedShort},
         {"count", n},
         {"type", "SCALAR"}}};
    const std::size_t indices = layout.add(m, 4, kElementArrayBuffer);
    document["materials"] = OrderedJson::array();
    OrderedJson primitives = OrderedJson::array();
    std::size_t first = 0;
    for (const auto& [theme, triangles] : by_theme_) {
      document["accessors"].push_back({{"bufferView", indices},
                                       {"byteOffset", 4 * first},
                                       {"componentType", kUnsignedInt},
                                       {"count", 3 * triangles.size()},
                                       {"type", "SCALAR"}});
      first += 3 * triangles.size();
      primitives.push_back({{"attributes", attributes_of(theme)},
                            {"indices", document["accessors"].size() - 1},
                            {"material", document["materials"].size()},
                            {"mode", 4}});
      document["materials"].push_back(material_of(theme));
    }
    document["bufferViews"] = layout.views();
    document["buffers"] = OrderedJson::array({{{"byteLength", layout.bytes()}}});
    document["meshes"] = OrderedJson::array({{{"name", "surface"}, {"primitives", primitives}}});
  }

  /// Returns a mesh's attributes: the terrain is coloured by height; features on it have their theme's colour.
  static OrderedJson attributes_of(std::uint16_t theme) {
    OrderedJson attributes = {{"POSITION", 0}, {"NORMAL", 1}};
    if (theme == 0) attributes["COLOR_0"] = 2;
    attributes["_VERTEX_ID"] = 3;
    attributes["_SOURCE"] = 4;
    return attributes;
  }

  OrderedJson material_of(std::uint16_t theme) const {
    static constexpr std::array<std::array<double, 4>, 6> kColours{{{0.55, 0.17, 0.10, 1},
                                                                    {0.09, 0.28, 0.08, 1},
                                                                    {0.30, 0.30, 0.32, 1},
                                                                    {0.13, 0.25, 0.50, 1},
                                                                    {0.52, 0.40, 0.10, 1},
                                                                    {0.35, 0.13, 0.40, 1}}};
    OrderedJson material = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
    if (theme != 0) material["baseColorFactor"] = kColours[(theme - 1U) % kColours.size()];
    return {{"name", theme == 0 ? "terrain" : theme_name(options_, theme)},
            {"pbrMetallicRoughness", material},
            {"doubleSided", true}};
  }

  /// Returns the sums of the triangles' normals weighted by area; upward, as every triangle's normal is.
  std::vector<std::array<double, 3>> normals() const {
    std::vector<std::array<double, 3>> sums(tin_.vertices.size());
    for (const Triangle& t : tin_.triangles) {
      const GridPoint &a = tin_.vertices[t[0]], &b = tin_.vertices[t[1]], &c = tin_.vertices[t[2]];
      const double ux = double{1} * b.x - a.x, uy = double{1} * b.y - a.y, uz = double{1} * b.z - a.z;
      const double vx = double{1} * c.x - a.x, vy = double{1} * c.y - a.y, vz = double{1} * c.z - a.z;
      const std::array<double, 3> normal{uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
      for (const std::uint32_t v : t)
        for (std::size_t i = 0; i < 3; ++i) sums[v][i] += normal[i];
    }
    return sums;
  }

  /// Returns a colour from lowland green over ochre and brown to white, as on school maps; linear RGBA.
  std::array<std::uint8_t, 4> colour(const GridPoint& p) const {
    static constexpr std::array<std::array<double, 3>, 4> kStops{
        {{60, 120, 50}, {200, 180, 90}, {140, 90, 50}, {245, 245, 245}}};
    const double range = std::max(double{1} * zmax_ - zmin_, 1.0);
    const double at = (double{1} * p.z - zmin_) / range * (kStops.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    std::array<std::uint8_t, 4> rgba{0, 0, 0, 255};
    for (std::size_t i = 0; i < 3; ++i) {
      rgba[i] = static_cast<std::uint8_t>(
          std::lround(std::lerp(kStops[below][i], kStops[below + 1][i], at - static_cast<double>(below))));
    }
    return rgba;
  }

  /// Writes the buffer in the order of add_mesh().
  void write_buffer(BufferedFile& file, Progress& progress) const {
    StepProgress steps(progress, 5 * tin_.vertices.size() + tin_.triangles.size());
    const auto each_vertex = [&](const auto& write_vertex) {
      for (std::uint32_t v = 0; v < tin_.vertices.size(); ++v) {
        write_vertex(v);
        steps.step();
      }
    };
    each_vertex([&](std::uint32_t v) {
      for (const float c : position(tin_.vertices[v])) file.little_endian(c);
    });
    const auto sums = normals();
    each_vertex([&](std::uint32_t v) {
      const auto& [east, north, up] = sums[v];
      const double length = std::hypot(east, north, up);
      for (const float c : gltf_axes(east / length, north / length, up / length)) file.little_endian(c);
    });
    each_vertex([&](std::uint32_t v) {
      for (const std::uint8_t c : colour(tin_.vertices[v])) file.little_endian(c);
    });
    each_vertex([&](std::uint32_t v) { file.little_endian(tin_.id(v)); });
    each_vertex([&](std::uint32_t v) { file.little_endian(std::uint32_t{tin_.sources[v]}); });
    for (const auto& [theme, triangles] : by_theme_) {
      for (const Triangle& t : triangles) {
        for (const std::uint32_t v : t) file.little_endian(v);
        steps.step();
      }
    }
  }

  const Tin& tin_;
  const TinExportOptions& options_;
  std::map<std::uint16_t, std::vector<Triangle>> by_theme_;
  GridBox box_;
  std::int32_t zmin_ = std::numeric_limits<std::int32_t>::max();
  std::int32_t zmax_ = std::numeric_limits<std::int32_t>::min();
  GridPoint origin_;
};

}  // namespace

void write_glb(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress) {
  GlbWriter(tin, options).write(output, progress);
}

}  // namespace itin
