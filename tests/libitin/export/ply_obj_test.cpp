#include <gmock/gmock.h>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "libitin/export/binary_reader.hpp"
#include "libitin/export/export_fixture.hpp"

namespace itin::test {
namespace {

using ::testing::HasSubstr;

class PlyTest : public ExportTest {};
class ObjTest : public ExportTest {};
class MeshTest : public ExportTest {};

TEST_F(PlyTest, ReadsBackExactly) {
  const std::string bytes = bytes_of(exported("a.ply"));
  const std::string end = "end_header\n";
  const std::size_t header_size = bytes.find(end) + end.size();
  const std::string header = bytes.substr(0, header_size);
  EXPECT_EQ(header.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
  EXPECT_THAT(header, HasSubstr("comment crs PROJCS[\"OSGB"));
  EXPECT_THAT(header, HasSubstr("element vertex " + std::to_string(tin_.vertices.size()) +
                                "\nproperty double x\nproperty double y\nproperty double z\nproperty uint id_high\n"
                                "property uint id_low\nproperty ushort source\nelement face " +
                                std::to_string(tin_.triangles.size()) + "\nproperty list uchar int vertex_indices\n"));

  BinaryReader reader(std::string_view(bytes).substr(header_size));
  for (std::uint32_t v = 0; v < tin_.vertices.size(); ++v) {
    const double x = reader.read<double>(), y = reader.read<double>(), z = reader.read<double>();
    ASSERT_EQ((Point3{x, y, z}), tin_.point(v));
    ASSERT_EQ(tin_.grid.quantise({x, y, z}), tin_.vertices[v]);
    const std::uint64_t high = reader.read<std::uint32_t>(), low = reader.read<std::uint32_t>();
    ASSERT_EQ(high << 32 | low, tin_.id(v));
    ASSERT_EQ(reader.read<std::uint16_t>(), tin_.sources[v]);
  }
  for (const Triangle& t : tin_.triangles) {
    ASSERT_EQ(reader.read<std::uint8_t>(), 3);
    for (const std::uint32_t v : t) ASSERT_EQ(reader.read<std::uint32_t>(), v);
  }
  EXPECT_TRUE(reader.at_end());
}

TEST_F(PlyTest, HeaderHasNoStrayLines) {
  options_.crs_wkt = "LOCAL_CS[\"two\nlines\"]";
  const std::string bytes = bytes_of(exported("a.ply"));
  EXPECT_THAT(bytes, HasSubstr("comment crs LOCAL_CS[\"two lines\"]\n"));
}

TEST_F(PlyTest, EmptyTin) {
  tin_ = {};
  EXPECT_THAT(bytes_of(exported("a.ply")), HasSubstr("element vertex 0\n"));
}

TEST_F(ObjTest, ReadsBackExactly) {
  std::istringstream text(bytes_of(exported("a.obj")));
  std::vector<Point3> points;
  std::vector<Triangle> triangles;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string kind, a, b, c, more;
    words >> kind >> a >> b >> c;
    if (kind == "#") continue;
    EXPECT_FALSE(words >> more) << line;
    if (kind == "v") {
      points.push_back({std::stod(a), std::stod(b), std::stod(c)});
    } else {
      ASSERT_EQ(kind, "f");
      const auto index = [](const std::string& word) { return static_cast<std::uint32_t>(std::stoul(word)) - 1; };
      triangles.push_back({index(a), index(b), index(c)});
    }
  }
  ASSERT_EQ(points.size(), tin_.vertices.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) ASSERT_EQ(points[v], tin_.point(v));
  EXPECT_EQ(triangles, tin_.triangles);
}

TEST_F(MeshTest, ReadsBackExactly) {
  std::istringstream text(bytes_of(exported("a.2dm")));
  std::string first, second;
  std::getline(text, first), std::getline(text, second);
  EXPECT_EQ(first, "MESH2D");  // QGIS knows the file by it
  EXPECT_EQ(second, "NUM_MATERIALS_PER_ELEM 1");
  std::vector<Point3> points;
  std::vector<Triangle> triangles;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string kind, a, b, c, material, more;
    std::size_t id = 0;
    words >> kind >> id >> a >> b >> c;
    if (kind == "ND") {
      points.push_back({std::stod(a), std::stod(b), std::stod(c)});
      EXPECT_EQ(id, points.size());
    } else {
      ASSERT_EQ(kind, "E3T");
      const auto index = [](const std::string& word) { return static_cast<std::uint32_t>(std::stoul(word)) - 1; };
      triangles.push_back({index(a), index(b), index(c)});
      EXPECT_EQ(id, triangles.size());
      EXPECT_TRUE(words >> material && material == "1") << line;
    }
    EXPECT_FALSE(words >> more) << line;
  }
  ASSERT_EQ(points.size(), tin_.vertices.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) ASSERT_EQ(points[v], tin_.point(v));
  EXPECT_EQ(triangles, tin_.triangles);
}

TEST_F(MeshTest, MaterialsAreThemes) {
  tin_.raised_theme.assign(tin_.vertices.size(), 0);
  tin_.raised_theme[tin_.triangles[2][1]] = 3;
  std::istringstream text(bytes_of(exported("a.2dm")));
  std::size_t triangle = 0;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("E3T")) continue;
    EXPECT_TRUE(line.ends_with(fmt::format(" {}", tin_.theme(tin_.triangles[triangle]) + 1))) << line;
    ++triangle;
  }
  EXPECT_EQ(triangle, tin_.triangles.size());
}

}  // namespace
}  // namespace itin::test
