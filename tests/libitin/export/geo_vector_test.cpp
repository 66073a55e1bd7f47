// GeoPackage and GeoJSON, read back by OGR.
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>

#include "libitin/export/export_fixture.hpp"

namespace itin::test {
namespace {

class GeoVectorTest : public ExportTest {
 protected:
  static GDALDatasetUniquePtr open(const std::string& path) {
    GDALAllRegister();
    GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
    EXPECT_TRUE(dataset) << path;
    return dataset;
  }

  void check_triangles(OGRLayer& layer) const {
    ASSERT_EQ(layer.GetFeatureCount(), static_cast<GIntBig>(tin_.triangles.size()));
    OGRSpatialReference expected;
    expected.importFromEPSG(27700);
    ASSERT_NE(layer.GetSpatialRef(), nullptr);
    EXPECT_TRUE(layer.GetSpatialRef()->IsSame(&expected));
    std::size_t t = 0;
    for (const auto& feature : layer) {
      const OGRPolygon* polygon = feature->GetGeometryRef()->toPolygon();
      const OGRLinearRing& ring = *polygon->getExteriorRing();
      ASSERT_EQ(ring.getNumPoints(), 4);
      EXPECT_FALSE(ring.isClockwise());
      for (int i = 0; i < 4; ++i) {
        const std::uint32_t v = tin_.triangles[t][static_cast<std::size_t>(i % 3)];
        ASSERT_EQ((Point3{ring.getX(i), ring.getY(i), ring.getZ(i)}), tin_.point(v));
        const std::string corner(1, "abca"[i]);
        ASSERT_EQ(static_cast<VertexId>(feature->GetFieldAsInteger64(("vertex_" + corner).c_str())), tin_.id(v));
        ASSERT_EQ(feature->GetFieldAsInteger(("source_" + corner).c_str()), tin_.sources[v]);
      }
      ++t;
    }
  }
};

TEST_F(GeoVectorTest, GeoPackageReadsBackExactly) {
  const auto dataset = open(exported("a.gpkg"));
  ASSERT_EQ(dataset->GetLayerCount(), 2);
  check_triangles(*dataset->GetLayerByName("triangles"));
  OGRLayer& vertices = *dataset->GetLayerByName("vertices");
  ASSERT_EQ(vertices.GetFeatureCount(), static_cast<GIntBig>(tin_.vertices.size()));
  std::uint32_t v = 0;
  for (const auto& feature : vertices) {
    const OGRPoint& p = *feature->GetGeometryRef()->toPoint();
    ASSERT_EQ((Point3{p.getX(), p.getY(), p.getZ()}), tin_.point(v));
    ASSERT_EQ(static_cast<VertexId>(feature->GetFieldAsInteger64("id")), tin_.id(v));
    ASSERT_EQ(feature->GetFieldAsInteger("source"), tin_.sources[v]);
    ++v;
  }
  ASSERT_NE(dataset->GetMetadataItem("METADATA_JSON"), nullptr);
  EXPECT_EQ(dataset->GetMetadataItem("METADATA_JSON"), options_.metadata_json);
}

TEST_F(GeoVectorTest, GeoJsonReadsBackExactly) {
  const auto dataset = open(exported("a.geojson"));
  ASSERT_EQ(dataset->GetLayerCount(), 1);
  check_triangles(*dataset->GetLayer(0));
}

TEST_F(GeoVectorTest, GeoJsonHasTheEdgesOfLinesBehindTheTriangles) {
  const auto [a, b, c] = tin_.triangles[0];
  tin_.lines = {{std::min(a, b), std::max(a, b), 2}, {std::min(a, c), std::max(a, c), 1}};
  options_.theme_names = {"contours", "the \"old\" road"};
  const auto dataset = open(exported("a.geojson"));
  std::size_t line = 0;
  for (const auto& feature : *dataset->GetLayer(0)) {
    const OGRGeometry& geometry = *feature->GetGeometryRef();
    if (wkbFlatten(geometry.getGeometryType()) != wkbLineString) continue;
    ASSERT_LT(line, tin_.lines.size());
    const LineEdge& e = tin_.lines[line++];
    const OGRLineString& ends = *geometry.toLineString();
    EXPECT_EQ((Point3{ends.getX(0), ends.getY(0), ends.getZ(0)}), tin_.point(e.from));
    EXPECT_EQ((Point3{ends.getX(1), ends.getY(1), ends.getZ(1)}), tin_.point(e.to));
    EXPECT_EQ(static_cast<VertexId>(feature->GetFieldAsInteger64("vertex_b")), tin_.id(e.to));
    EXPECT_EQ(feature->GetFieldAsString("theme"), options_.theme_names[e.theme - std::size_t{1}]);
  }
  EXPECT_EQ(line, 2u);
}

TEST_F(GeoVectorTest, EqualTinsGiveEqualFiles) {
  const std::string once = bytes_of(exported("a.gpkg")), again = bytes_of(exported("b.gpkg"));
  EXPECT_FALSE(once.empty());
  EXPECT_TRUE(once == again);
}

TEST_F(GeoVectorTest, EmptyTinGivesEmptyLayers) {
  tin_ = {};
  EXPECT_EQ(open(exported("a.gpkg"))->GetLayerByName("triangles")->GetFeatureCount(), 0);
  EXPECT_EQ(open(exported("a.geojson"))->GetLayer(0)->GetFeatureCount(), 0);
}

TEST_F(GeoVectorTest, GeoJsonFindsTheCodeOfAnUnlabelledCrs) {
  // As written by programs that leave authorities out.
  std::string& wkt = options_.crs_wkt;
  wkt = wkt_of(32630);
  for (std::size_t at; (at = wkt.find(",AUTHORITY[")) != std::string::npos;)
    wkt.erase(at, wkt.find("\"]", at) + 2 - at);
  EXPECT_NE(bytes_of(exported("a.geojson")).find("urn:ogc:def:crs:EPSG::32630"), std::string::npos);
}

TEST_F(GeoVectorTest, GeoJsonRefusesACrsItCannotName) {
  options_.crs_wkt = "LOCAL_CS[\"site grid\",UNIT[\"metre\",1]]";
  EXPECT_THROW(exported("a.geojson"), InputError);
  EXPECT_TRUE(directory_.names().empty());
  EXPECT_NO_THROW(exported("a.gpkg"));
}

}  // namespace
}  // namespace itin::test
