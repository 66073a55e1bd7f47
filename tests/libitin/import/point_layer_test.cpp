#include "import/points/point_layer.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <optional>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>

#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::TemporaryDirectory;
using ::testing::HasSubstr;

struct TestFeature {
  std::string wkt;               ///< empty: no geometry
  std::optional<double> height;  ///< attribute `h`
  std::string kind = "ground";   ///< attribute `kind`
};

struct TestLayer {
  std::string name = "points";
  OGRwkbGeometryType type = wkbPoint25D;
  std::vector<TestFeature> features;
};

void write_layer(GDALDataset& dataset, const TestLayer& layer) {
  OGRSpatialReference crs;
  crs.importFromEPSG(27700);
  OGRLayer* out = dataset.CreateLayer(layer.name.c_str(), &crs, layer.type, nullptr);
  ASSERT_NE(out, nullptr);
  OGRFieldDefn h("h", OFTReal), kind("kind", OFTString);
  ASSERT_EQ(out->CreateField(&h), OGRERR_NONE);
  ASSERT_EQ(out->CreateField(&kind), OGRERR_NONE);
  for (const TestFeature& from : layer.features) {
    OGRFeature feature(out->GetLayerDefn());
    if (!from.wkt.empty()) {
      OGRGeometry* geometry = nullptr;
      ASSERT_EQ(OGRGeometryFactory::createFromWkt(from.wkt.c_str(), nullptr, &geometry), OGRERR_NONE) << from.wkt;
      if (from.kind == "Z is NaN") geometry->toPoint()->setZ(std::nan(""));
      feature.SetGeometryDirectly(geometry);
    }
    if (from.height) feature.SetField("h", *from.height);
    feature.SetField("kind", from.kind.c_str());
    ASSERT_EQ(out->CreateFeature(&feature), OGRERR_NONE);
  }
}

class PointLayer : public testing::Test {
 protected:
  std::string write(const std::vector<TestLayer>& layers, const char* driver = "GPKG", const char* name = "a.gpkg") {
    GDALAllRegister();
    const std::string path = directory_.file(name);
    const GDALDatasetUniquePtr dataset(
        GetGDALDriverManager()->GetDriverByName(driver)->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    for (const TestLayer& layer : layers) write_layer(*dataset, layer);
    return path;
  }
  std::string write(const std::vector<TestFeature>& features, OGRwkbGeometryType type = wkbPoint25D) {
    return write({TestLayer{"points", type, features}});
  }

  std::vector<Point3> read(const std::string& path, const ImportOptions& options = {}) {
    std::vector<Point3> points;
    const auto reader = open_point_layer(path, options);
    filtered_ = reader->read([&](PointBatch& batch, double) {
      for (std::size_t i = 0; i < batch.size(); ++i) points.push_back({batch.x[i], batch.y[i], batch.z[i]});
    });
    without_geometry_ = reader->without_geometry();
    return points;
  }

  template <class E>
  std::string refusal(const std::string& path, const ImportOptions& options = {}) {
    try {
      read(path, options);
    } catch (const E& error) {
      EXPECT_THAT(error.what(), HasSubstr(path));
      return error.what();
    }
    ADD_FAILURE() << "accepted " << path;
    return {};
  }

  TemporaryDirectory directory_;
  std::uint64_t filtered_ = 0, without_geometry_ = 0;
};

const std::vector<TestFeature> kTwoFeatures{{"POINT Z (300000 200000 12.5)", 1},
                                            {"POINT Z (300010 200020 -3)", 2, "roof"}};

TEST_F(PointLayer, ReadsZFromManyFormats) {
  const std::vector<Point3> expected{{300000, 200000, 12.5}, {300010, 200020, -3}};
  for (const auto& [driver, name] :
       {std::pair{"GPKG", "a.gpkg"}, {"ESRI Shapefile", "b.shp"}, {"FlatGeobuf", "d.fgb"}}) {
    const std::string path = write({TestLayer{"points", wkbPoint25D, kTwoFeatures}}, driver, name);
    // FlatGeobuf sorts its features along a curve.
    EXPECT_THAT(read(path), testing::UnorderedElementsAreArray(expected)) << driver;
    EXPECT_THAT(open_point_layer(path, {})->crs(), HasSubstr("British National Grid")) << driver;
  }
  EXPECT_EQ(open_point_layer(directory_.file("a.gpkg"), {})->centre(), (Point2{300000, 200000}));
}

TEST_F(PointLayer, ReadsGeoJson) {
  const std::string path = directory_.write("a.geojson", R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"h":"7.5"},"geometry":{"type":"Point","coordinates":[-3.1,51.4,5]}},
    {"type":"Feature","properties":{"h":" 8 "},"geometry":{"type":"MultiPoint","coordinates":[[-3,51,6],[-2,52,7]]}}]})");
  EXPECT_EQ(read(path), (std::vector<Point3>{{-3.1, 51.4, 5}, {-3, 51, 6}, {-2, 52, 7}}));
  ImportOptions options;
  options.z_field = "h";
  EXPECT_EQ(read(path, options), (std::vector<Point3>{{-3.1, 51.4, 7.5}, {-3, 51, 8}, {-2, 52, 8}}));
}

TEST_F(PointLayer, FieldAndFilter) {
  ImportOptions options;
  options.z_field = "h";
  options.where = "kind = 'roof'";
  EXPECT_EQ(read(write(kTwoFeatures), options), (std::vector<Point3>{{300010, 200020, 2}}));
  EXPECT_EQ(filtered_, 1u);
}

TEST_F(PointLayer, MissingHeightsAreVoidsAndMissingGeometriesAreCounted) {
  ImportOptions options;
  options.z_field = "h";
  const auto points =
      read(write({{"POINT (1 2)", std::nullopt}, {"", 5}, {"POINT EMPTY", 5}, {"POINT (3 4)", 6}}, wkbPoint), options);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_TRUE(std::isnan(points[0].z));
  EXPECT_EQ(points[1], (Point3{3, 4, 6}));
  EXPECT_EQ(without_geometry_, 2u);
}

TEST_F(PointLayer, NoHeightAtAllNamesTheOption) {
  EXPECT_THAT(refusal<InputError>(write({{"POINT (1 2)", 3}}, wkbPoint)), HasSubstr("`z_field`"));
  const std::string path = write({TestLayer{"points", wkbPoint25D, {{"POINT (1 2)", std::nullopt}}}}, "GPKG", "b.gpkg");
  ImportOptions options;
  options.z_field = "h";
  EXPECT_THAT(refusal<InputError>(path, options), HasSubstr("`z_field`"));
}

TEST_F(PointLayer, LinesAndPolygonsAreRefused) {
  EXPECT_THAT(refusal<InputError>(write({{"LINESTRING (1 2,3 4)", 3}}, wkbLineString)), HasSubstr("`kind`"));
  const std::vector<TestFeature> mixed{{"POINT Z (1 2 3)", 3}, {"POLYGON ((0 0,1 0,0 1,0 0))", 3}};
  EXPECT_THAT(refusal<InputError>(write({TestLayer{"mixed", wkbUnknown, mixed}}, "GPKG", "b.gpkg")),
              HasSubstr("`kind`"));
}

TEST_F(PointLayer, UnknownNamesAreAnsweredWithTheKnown) {
  const std::string path =
      write({TestLayer{"points", wkbPoint25D, kTwoFeatures}, TestLayer{"spots", wkbPoint25D, kTwoFeatures}});
  EXPECT_THAT(refusal<FileError>(path), HasSubstr(R"(["points", "spots"])"));
  ImportOptions options;
  options.layer = "contours";
  EXPECT_THAT(refusal<FileError>(path, options), HasSubstr(R"('contours'; it has ["points", "spots"])"));
  options.layer = "spots";
  EXPECT_EQ(read(path, options).size(), 2u);
  options.z_field = "elevation";
  EXPECT_THAT(refusal<FileError>(path, options), HasSubstr(R"('elevation'; it has ["h", "kind"])"));
  options.z_field = "kind";
  EXPECT_THAT(refusal<InputError>(path, options), HasSubstr("feature 1: kind 'ground' is not a finite number"));
  options.z_field.clear();
  options.where = "no such = 'thing";
  EXPECT_THAT(refusal<InputError>(path, options), HasSubstr("`where`"));
  options.where = "elevation > 100";
  EXPECT_THAT(refusal<FileError>(path, options), HasSubstr("a field that layer 'spots' does not have"));
  options.where = "h > 100";
  EXPECT_THAT(refusal<InputError>(path, options),
              HasSubstr("`where` h > 100 leaves none of 2 features of layer 'spots'"));
}

TEST_F(PointLayer, NonFiniteNumbersNameTheFeature) {
  ImportOptions options;
  options.z_field = "h";
  EXPECT_THAT(refusal<InputError>(write({{"POINT (1 2)", 3}, {"POINT (1 2)", HUGE_VAL}}), options),
              HasSubstr("feature 2: h "));
  const std::string path =
      write({TestLayer{"points", wkbPoint25D, {{"POINT Z (1 2 3)", 3}, {"POINT Z (4 5 6)", 3, "Z is NaN"}}}}, "GPKG",
            "b.gpkg");
  EXPECT_THAT(refusal<InputError>(path), HasSubstr("feature 2: Z "));
}

TEST_F(PointLayer, FilesThatAreNotLayers) {
  EXPECT_THAT(refusal<FileError>("/nowhere/a.gpkg"), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal<FileError>(directory_.write("a.gpkg", "nonsense")), HasSubstr("cannot be read"));
  EXPECT_THAT(refusal<FileError>(write({TestLayer{"empty", wkbPoint25D, {}}}, "GPKG", "b.gpkg")),
              HasSubstr("holds no points"));
}

}  // namespace
}  // namespace itin
