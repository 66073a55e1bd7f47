#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>
#include <itin/topology.hpp>

#include "libitin/export/export_fixture.hpp"

namespace itin::test {
namespace {

using Json = nlohmann::json;

class TopologyJsonTest : public ExportTest {
 protected:
  Json document(TopologyKind kind) {
    const std::string path = directory_.file("a.json");
    options_.overwrite = true;
    export_topology(tin_, kind, path, options_, progress_);
    return Json::parse(bytes_of(path));
  }
};

Json json_of(std::optional<std::uint32_t> index) {
  return index ? Json(*index) : Json(nullptr);
}

TEST_F(TopologyJsonTest, EveryKindHasTheVertices) {
  for (const auto kind : {TopologyKind::TriangleBased, TopologyKind::VertexBased, TopologyKind::EdgeBased}) {
    const Json json = document(kind);
    EXPECT_EQ(json.at("itin"), "test");
    EXPECT_EQ(json.at("command").at("verb"), "tin");
    EXPECT_EQ(json.at("crs"), options_.crs_wkt);
    ASSERT_EQ(json.at("vertices").size(), tin_.vertices.size());
    for (std::uint32_t v = 0; v < tin_.vertices.size(); ++v) {
      const Point3 p = tin_.point(v);
      ASSERT_EQ(json.at("vertices")[v], (Json{p.x, p.y, p.z}));
      ASSERT_EQ(json.at("vertex_ids")[v], std::to_string(tin_.id(v)));
      ASSERT_EQ(json.at("sources")[v], tin_.sources[v]);
    }
  }
}

TEST_F(TopologyJsonTest, TriangleBased) {
  const Json json = document(topology_kind("triangle"));
  EXPECT_EQ(json.at("topology"), "triangle");
  EXPECT_EQ(json.at("triangles"), Json(tin_.triangles));
  const Topology topology(tin_);
  ASSERT_EQ(json.at("adjacent_triangles").size(), tin_.triangles.size());
  for (std::uint32_t t = 0; t < tin_.triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto twin = topology.twin(3 * t + i);
      ASSERT_EQ(json.at("adjacent_triangles")[t][i],
                json_of(twin ? std::optional(Topology::face(*twin)) : std::nullopt));
    }
}

TEST_F(TopologyJsonTest, VertexBased) {
  const Json json = document(topology_kind("vertex"));
  EXPECT_EQ(json.at("topology"), "vertex");
  const Topology topology(tin_);
  for (std::uint32_t v = 0; v < tin_.vertices.size(); ++v) {
    const auto neighbours = topology.vertices_of_vertex(v);
    ASSERT_EQ(json.at("neighbours")[v], Json(std::vector<std::uint32_t>(neighbours.begin(), neighbours.end())));
    ASSERT_EQ(json.at("boundary")[v], topology.on_boundary(v));
  }
}

TEST_F(TopologyJsonTest, EdgeBased) {
  const Json json = document(topology_kind("edge"));
  EXPECT_EQ(json.at("topology"), "edge");
  const Topology topology(tin_);
  ASSERT_EQ(json.at("half_edges").size(), topology.half_edge_count());
  for (std::uint32_t h = 0; h < topology.half_edge_count(); ++h) {
    const Json expected{topology.origin(h), json_of(topology.twin(h)), Topology::next(h), Topology::face(h)};
    ASSERT_EQ(json.at("half_edges")[h], expected);
  }
}

TEST_F(TopologyJsonTest, NamesTheThemesOfLines) {
  EXPECT_FALSE(document(TopologyKind::TriangleBased).contains("lines"));
  const auto [a, b, c] = tin_.triangles[0];
  tin_.lines = {{std::min(a, b), std::max(a, b), 2}, {std::min(a, c), std::max(a, c), 1}};
  options_.theme_names = {"contours", "the \"old\" road"};
  for (const auto kind : {TopologyKind::TriangleBased, TopologyKind::VertexBased, TopologyKind::EdgeBased}) {
    const Json json = document(kind);
    ASSERT_EQ(json.at("lines").size(), 2u);
    EXPECT_EQ(json.at("lines")[0], (Json{tin_.lines[0].from, tin_.lines[0].to, "the \"old\" road"}));
    EXPECT_EQ(json.at("lines")[1], (Json{tin_.lines[1].from, tin_.lines[1].to, "contours"}));
  }
}

TEST_F(TopologyJsonTest, RefusesOtherKindsAndEndings) {
  EXPECT_THROW(topology_kind("face"), InputError);
  EXPECT_THROW(export_topology(tin_, TopologyKind::EdgeBased, directory_.file("a.ply"), options_, progress_),
               InputError);
  EXPECT_TRUE(directory_.names().empty());
}

TEST_F(TopologyJsonTest, RefusesMetadataThatIsNoObject) {
  options_.metadata_json = "[1]";
  EXPECT_THROW(document(TopologyKind::EdgeBased), InputError);
  EXPECT_TRUE(directory_.names().empty());
}

}  // namespace
}  // namespace itin::test
