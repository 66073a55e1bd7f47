#include <algorithm>
#include <cmath>
#include <limits>

#include <itin/mesh_export.hpp>

#include "export/glb_file.hpp"
#include "export/step_progress.hpp"

namespace itin {

namespace {

/// The light of a part of an sRGB colour, 0 to 1.
double light_of(std::uint8_t part) {
  const double value = part / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// The unit normal of a triangle on its front.
Point3 front_of(const std::array<Point3, 3>& t) {
  const Point3 u{t[1].x - t[0].x, t[1].y - t[0].y, t[1].z - t[0].z},
      v{t[2].x - t[0].x, t[2].y - t[0].y, t[2].z - t[0].z};
  const Point3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const double length = std::max(std::hypot(n.x, n.y, n.z), std::numeric_limits<double>::min());
  return {n.x / length, n.y / length, n.z / length};
}

class MeshWriter {
 public:
  MeshWriter(const std::vector<ColouredMesh>& meshes, const std::string& crs_wkt) : crs_wkt_(crs_wkt) {
    for (const ColouredMesh& mesh : meshes)
      if (!mesh.triangles.empty()) meshes_.push_back(&mesh), triangles_ += mesh.triangles.size();
    for_each_corner([&](const Point3& p) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    });
    if (!meshes_.empty())
      origin_ = {std::round((low_.x + high_.x) / 2), std::round((low_.y + high_.y) / 2), std::round(low_.z)};
  }

  void write(const PendingFile& output, Progress& progress) const {
    GlbLayout layout;
    const nlohmann::ordered_json document = this->document(layout);
    BufferedFile file(output);
    begin_glb(file, document, layout.bytes());
    StepProgress steps(progress, 2 * triangles_);
    const auto write_vector = [&](const GltfVector& v) {
      for (const float c : v) file.little_endian(c);
    };
    for_each_triangle([&](const std::array<Point3, 3>& t) {
      for (const Point3& p : t) write_vector(position(p));
      steps.step();
    });
    for_each_triangle([&](const std::array<Point3, 3>& t) {
      const Point3 n = front_of(t);
      for (int corner = 0; corner < 3; ++corner) write_vector(gltf_axes(n.x, n.y, n.z));
      steps.step();
    });
    file.close();
  }

 private:
  template <class Visit>
  void for_each_triangle(const Visit& visit) const {
    for (const ColouredMesh* mesh : meshes_)
      for (const auto& triangle : mesh->triangles) visit(triangle);
  }
  template <class Visit>
  void for_each_corner(const Visit& visit) const {
    for_each_triangle([&](const std::array<Point3, 3>& t) { std::for_each(t.begin(), t.end(), visit); });
  }

  GltfVector position(const Point3& p) const { return gltf_axes(p.x - origin_.x, p.y - origin_.y, p.z - origin_.z); }

  nlohmann::ordered_json document(GlbLayout& layout) const {
    nlohmann::ordered_json document = begun_glb(), scene = empty_glb_scene({}, origin_, crs_wkt_);
    if (!meshes_.empty()) {
      const std::size_t positions = layout.add(3 * triangles_, 12, gltf::kArrayBuffer),
                        normals = layout.add(3 * triangles_, 12, gltf::kArrayBuffer);
      std::size_t first = 0;
      for (std::size_t i = 0; i < meshes_.size(); ++i) {
        scene["nodes"].push_back(i);
        add_mesh(document, *meshes_[i], {positions, normals}, first);
        first += 3 * meshes_[i]->triangles.size();
      }
      document["bufferViews"] = layout.views();
      document["buffers"] = nlohmann::ordered_json::array({{{"byteLength", layout.bytes()}}});
    }
    document["scenes"] = nlohmann::ordered_json::array({std::move(scene)});
    return document;
  }

  /// Adds a mesh whose corners are those of both views from `first` on.
  void add_mesh(nlohmann::ordered_json& document, const ColouredMesh& mesh, const std::array<std::size_t, 2>& views,
                std::size_t first) const {
    const std::size_t number = document["nodes"].size();
    document["nodes"].push_back({{"name", mesh.name}, {"mesh", number}});
    const std::size_t accessors = document["accessors"].size();
    for (const std::size_t view : views)
      document["accessors"].push_back({{"bufferView", view},
                                       {"byteOffset", 12 * first},
                                       {"componentType", gltf::kFloat},
                                       {"count", 3 * mesh.triangles.size()},
                                       {"type", "VEC3"}});
    const auto [low, high] = range_of(mesh);
    document["accessors"][accessors]["min"] = low, document["accessors"][accessors]["max"] = high;
    document["meshes"].push_back(
        {{"name", mesh.name},
         {"primitives",
          nlohmann::ordered_json::array({{{"attributes", {{"POSITION", accessors}, {"NORMAL", accessors + 1}}},
                                          {"material", number},
                                          {"mode", 4}}})}});
    const Rgba& c = mesh.colour;
    document["materials"].push_back(
        {{"name", mesh.name},
         {"pbrMetallicRoughness",
          {{"metallicFactor", 0},
           {"roughnessFactor", 1},
           {"baseColorFactor", {light_of(c.red), light_of(c.green), light_of(c.blue), 1}}}}});
  }

  /// The least and the greatest coordinates, which the format demands.
  std::pair<GltfVector, GltfVector> range_of(const ColouredMesh& mesh) const {
    GltfVector low = position(mesh.triangles.front().front()), high = low;
    for (const auto& triangle : mesh.triangles) {
      for (const Point3& corner : triangle) {
        const GltfVector p = position(corner);
        for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
      }
    }
    return {low, high};
  }

  static constexpr double kFar = std::numeric_limits<double>::infinity();

  const std::string& crs_wkt_;
  std::vector<const ColouredMesh*> meshes_;
  std::size_t triangles_ = 0;
  Point3 low_{kFar, kFar, kFar}, high_{-kFar, -kFar, -kFar}, origin_;
};

}  // namespace

void write_meshes(const std::string& path, const std::string& crs_wkt, const std::vector<ColouredMesh>& meshes,
                  bool overwrite, Progress& progress) {
  PendingFile output(path, overwrite);
  MeshWriter(meshes, crs_wkt).write(output, progress);
  output.commit();
}

}  // namespace itin
