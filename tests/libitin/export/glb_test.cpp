// A small reader that holds the file to what the glTF 2.0 specification asks of it.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <itin/mesh_export.hpp>

#include "libitin/export/binary_reader.hpp"
#include "libitin/export/export_fixture.hpp"

namespace itin::test {
namespace {

using Json = nlohmann::json;

struct Glb {
  Json json;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    BinaryReader reader(bytes);
    EXPECT_EQ(reader.take(4), "glTF");
    EXPECT_EQ(reader.read<std::uint32_t>(), 2u);
    EXPECT_EQ(reader.read<std::uint32_t>(), bytes.size());
    const auto json_size = reader.read<std::uint32_t>();
    EXPECT_EQ(json_size % 4, 0u);
    EXPECT_EQ(reader.take(4), "JSON");
    json = Json::parse(reader.take(json_size));
    if (reader.at_end()) return;
    const auto binary_size = reader.read<std::uint32_t>();
    EXPECT_EQ(binary_size % 4, 0u);
    EXPECT_EQ(reader.take(4), std::string_view("BIN\0", 4));
    binary = reader.take(binary_size);
    EXPECT_TRUE(reader.at_end());
    EXPECT_EQ(json.at("buffers").at(0).at("byteLength"), binary.size());
  }

  /// All components of an accessor, element after element.
  template <typename T>
  std::vector<T> read(std::size_t accessor_index, std::size_t components) const {
    const Json& accessor = json.at("accessors").at(accessor_index);
    const Json& view = json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::size_t element = components * sizeof(T), stride = view.value("byteStride", element);
    const std::size_t first = accessor.value("byteOffset", std::size_t{0}), length = view.at("byteLength");
    const std::size_t offset = view.at("byteOffset").get<std::size_t>() + first, count = accessor.at("count");
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_EQ(stride % 4, 0u);
    EXPECT_GE(stride, element);
    EXPECT_LE(offset - first + length, binary.size());
    EXPECT_LE(first + stride * (count - 1) + element, length);
    std::vector<T> values;
    for (std::size_t i = 0; i < count; ++i) {
      BinaryReader reader(std::string_view(binary).substr(offset + i * stride, element));
      for (std::size_t c = 0; c < components; ++c) values.push_back(reader.read<T>());
    }
    return values;
  }
};

class GlbTest : public ExportTest {};

TEST_F(GlbTest, ReadsBack) {
  const Glb glb(bytes_of(exported("a.glb")));
  EXPECT_EQ(glb.json.at("asset").at("version"), "2.0");
  const Json& scene = glb.json.at("scenes").at(glb.json.at("scene").get<std::size_t>());
  const Json& node = glb.json.at("nodes").at(scene.at("nodes").at(0).get<std::size_t>());
  const Json& primitive = glb.json.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives").at(0);
  EXPECT_EQ(primitive.at("mode"), 4);
  EXPECT_TRUE(glb.json.at("materials").at(primitive.at("material").get<std::size_t>()).at("doubleSided"));
  const Json& attributes = primitive.at("attributes");
  EXPECT_EQ(scene.at("extras").at("crs"), options_.crs_wkt);
  EXPECT_EQ(scene.at("extras").at("itin"), "test");
  const auto origin = scene.at("extras").at("origin").get<std::array<double, 3>>();

  const auto positions = glb.read<float>(attributes.at("POSITION"), 3);
  const auto ids = glb.read<std::uint16_t>(attributes.at("_VERTEX_ID"), 4);
  const auto sources = glb.read<std::uint16_t>(attributes.at("_SOURCE"), 1);
  ASSERT_EQ(positions.size(), 3 * tin_.vertices.size());
  const Box box = tin_.bounds();
  const double bound = std::max(box.width(), box.height()) * 0x1p-23;
  for (std::uint32_t v = 0; v < tin_.vertices.size(); ++v) {
    const Point3 p = tin_.point(v);
    ASSERT_NEAR(origin[0] + positions[3 * v], p.x, bound);
    ASSERT_NEAR(origin[2] + positions[3 * v + 1], p.z, bound);
    ASSERT_NEAR(origin[1] - positions[3 * v + 2], p.y, bound);
    std::uint64_t id = 0;
    for (std::size_t i = 4; i-- > 0;) id = id << 16 | ids[4 * v + i];
    ASSERT_EQ(id, tin_.id(v));
    ASSERT_EQ(sources[v], tin_.sources[v]);
  }
  const auto indices = glb.read<std::uint32_t>(primitive.at("indices"), 1);
  ASSERT_EQ(indices.size(), 3 * tin_.triangles.size());
  for (std::size_t i = 0; i < indices.size(); ++i) ASSERT_EQ(indices[i], tin_.triangles[i / 3][i % 3]);
}

TEST_F(GlbTest, StatesTheBoundsOfItsPositions) {
  const Glb glb(bytes_of(exported("a.glb")));
  const Json& attributes = glb.json.at("meshes").at(0).at("primitives").at(0).at("attributes");
  const std::size_t accessor = attributes.at("POSITION");
  const auto positions = glb.read<float>(accessor, 3);
  std::array<float, 3> low{positions[0], positions[1], positions[2]}, high = low;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], positions[i]);
    high[i % 3] = std::max(high[i % 3], positions[i]);
  }
  EXPECT_EQ((glb.json.at("accessors").at(accessor).at("min").get<std::array<float, 3>>()), low);
  EXPECT_EQ((glb.json.at("accessors").at(accessor).at("max").get<std::array<float, 3>>()), high);
}

TEST_F(GlbTest, FacesAndNormalsLookUp) {
  const Glb glb(bytes_of(exported("a.glb")));
  const Json& primitive = glb.json.at("meshes").at(0).at("primitives").at(0);
  const auto p = glb.read<float>(primitive.at("attributes").at("POSITION"), 3);
  const auto normals = glb.read<float>(primitive.at("attributes").at("NORMAL"), 3);
  for (std::size_t v = 0; v < tin_.vertices.size(); ++v) {
    ASSERT_NEAR(std::hypot(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]), 1, 1e-6);
    ASSERT_GT(normals[3 * v + 1], 0);
  }
  for (const Triangle& t : tin_.triangles) {
    const auto at = [&](std::size_t corner, std::size_t axis) { return double{p[3 * t[corner] + axis]}; };
    // The y component of the cross product, which a viewer takes for the front face's direction.
    const double up = (at(1, 2) - at(0, 2)) * (at(2, 0) - at(0, 0)) - (at(1, 0) - at(0, 0)) * (at(2, 2) - at(0, 2));
    ASSERT_GT(up, 0);
  }
  const auto colours = glb.read<std::uint8_t>(primitive.at("attributes").at("COLOR_0"), 4);
  for (std::size_t v = 0; v < tin_.vertices.size(); ++v) ASSERT_EQ(colours[4 * v + 3], 255);
  EXPECT_TRUE(
      glb.json.at("accessors").at(primitive.at("attributes").at("COLOR_0").get<std::size_t>()).at("normalized"));
}

TEST_F(GlbTest, NormalOfASlope) {
  // Rises one in one towards the east: the normal leans west.
  tin_ = canonical_tin({{0, 0}, 1}, {{0, 0, 0}, {10, 0, 10}, {0, 10, 0}}, {0, 0, 0}, {{0, 1, 2}});
  const Glb glb(bytes_of(exported("a.glb")));
  const auto normals = glb.read<float>(1, 3);
  EXPECT_NEAR(normals[0], -std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(normals[1], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(normals[2], 0, 1e-6);
}

TEST_F(GlbTest, EmptyTinIsAnEmptyScene) {
  tin_ = {};
  const Glb glb(bytes_of(exported("a.glb")));
  EXPECT_TRUE(glb.binary.empty());
  EXPECT_FALSE(glb.json.contains("meshes"));
}

TEST(MeshGlb, HasANodeForEachMeshOnTheSideThatItFaces) {
  const TemporaryDirectory directory;
  // A wall of 2 m by 3 m that faces south, one that faces west, and nothing.
  const Point3 a{300000, 200000, 50}, b{300002, 200000, 50}, c{300002, 200000, 53}, d{300000, 200002, 50};
  const std::vector<ColouredMesh> meshes{{"served", {255, 0, 0}, {{a, b, c}}},
                                         {"nothing", {}, {}},
                                         {"hidden", {0, 0, 188}, {{d, a, {300000, 200000, 53}}}}};
  NoProgress progress;
  write_meshes(directory.file("a.glb"), "CRS", meshes, false, progress);
  const Glb glb(bytes_of(directory.file("a.glb")));
  const Json& scene = glb.json.at("scenes").at(0);
  EXPECT_EQ(scene.at("extras").at("crs"), "CRS");
  EXPECT_EQ(scene.at("extras").at("origin"), Json({300001, 200001, 50}));
  ASSERT_EQ(scene.at("nodes"), Json({0, 1}));
  EXPECT_EQ(glb.json.at("nodes").at(0).at("name"), "served");
  EXPECT_EQ(glb.json.at("nodes").at(1).at("name"), "hidden");
  EXPECT_FALSE(glb.json.at("materials").at(0).contains("doubleSided"));
  const Json red = glb.json.at("materials").at(0).at("pbrMetallicRoughness").at("baseColorFactor");
  EXPECT_EQ(red.at(0), 1);
  const Json blue = glb.json.at("materials").at(1).at("pbrMetallicRoughness").at("baseColorFactor");
  EXPECT_NEAR(blue.at(2).get<double>(), 0.5, 0.01);  // 188 of 255 in sRGB is half the light
  EXPECT_EQ(glb.read<float>(0, 3), (std::vector<float>{-1, 0, 1, 1, 0, 1, 1, 3, 1}));
  EXPECT_EQ(glb.read<float>(1, 3), (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}));     // south is +z
  EXPECT_EQ(glb.read<float>(3, 3), (std::vector<float>{-1, 0, 0, -1, 0, 0, -1, 0, 0}));  // west is -x
  EXPECT_EQ(glb.json.at("accessors").at(0).at("min"), Json({-1, 0, 1}));
  EXPECT_EQ(glb.json.at("accessors").at(0).at("max"), Json({1, 3, 1}));

  write_meshes(directory.file("empty.glb"), "CRS", {}, false, progress);
  EXPECT_FALSE(Glb(bytes_of(directory.file("empty.glb"))).json.contains("meshes"));
  EXPECT_THROW(write_meshes(directory.file("a.glb"), "CRS", meshes, false, progress), FileError);
}

}  // namespace
}  // namespace itin::test
