// Footprints from files: small ones written here, and the real ones.
#include "import/footprints/footprint_reader.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <set>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>

#include "gdal/crs.hpp"
#include "import/footprints/city_json.hpp"
#include "libitin/features/feature_fixture.hpp"
#include "support/delaunay_tin.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::reported;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

NoProgress quiet;

std::string data(const std::string& name) {
  return std::string(ITIN_DATA_DIR) + "/" + name;
}

#define SKIP_WITHOUT(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path) << " is absent"

std::string wkt(const std::string& crs) {
  return parse_crs(crs, "test").wkt;
}

class FootprintReader : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) { return directory_.write(name, text); }
  std::string layer(const std::string& features) {
    return write("f.geojson", R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:27700"}},
      "features":[)" + features + "]}");
  }
  FootprintSource read(FootprintQuery query) { return read_footprints(query, wkt("EPSG:27700"), grid_, quiet); }

  test::TemporaryDirectory directory_;
  Grid grid_{{300000, 200000}, 0.01};
};

std::string feature(const std::string& properties, const std::string& type, const std::string& coordinates) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}";
}

const char* const kSquare = "[[300000,200000],[300010,200000],[300010,200010],[300000,200010],[300000,200000]]";
const char* const kHole = "[[300003,200003],[300006,200003],[300006,200006],[300003,200006],[300003,200003]]";

TEST_F(FootprintReader, ReadsPolygonsMultipolygonsHolesAndLines) {
  FootprintQuery query;
  query.path = layer(feature(R"("h":7.5,"n":"a")", "Polygon", std::string("[") + kSquare + "," + kHole + "]") + "," +
                     feature(R"("h":null,"n":"b")", "MultiPolygon", std::string("[[") + kSquare + "]]") + "," +
                     feature(R"("h":2,"n":"c")", "LineString", "[[300020,200000],[300030,200000]]") + "," +
                     feature(R"("h":2,"n":"d")", "Point", "[300020,200000]"));
  query.height_field = "h";
  query.kept.name_field = "n";
  query.thickness = 0.5;
  const FootprintSource source = read(query);
  ASSERT_EQ(source.features.size(), 3U);
  EXPECT_EQ(source.features[0].rings.size(), 2U);
  EXPECT_EQ(source.features[0].height, 7.5);
  EXPECT_FALSE(source.features[1].height);
  EXPECT_EQ(source.features[1].rings.size(), 1U);
  ASSERT_EQ(source.features[2].rings.size(), 1U);
  for (const Point2& p : source.features[2].rings[0]) EXPECT_NEAR(std::abs(p.y - 200000), 0.25, 1e-9);
  ASSERT_EQ(source.warnings.size(), 1U);
  EXPECT_NE(source.warnings[0].find("d: passed over: is a POINT"), std::string::npos) << source.warnings[0];
}

TEST_F(FootprintReader, SelectsAndNamesWhatIsMissing) {
  FootprintQuery query;
  query.path = layer(feature(R"("h":7.5)", "Polygon", std::string("[") + kSquare + "]"));
  query.where = "h > 10";
  EXPECT_THROW(read(query), InputError);
  query.where = "height > 10";
  EXPECT_THROW(read(query), FileError);
  query.where.clear();
  query.height_field = "height";
  EXPECT_THROW(read(query), FileError);
  query.height_field.clear();
  query.layer = "nothing";
  EXPECT_THROW(read(query), FileError);
  query.path = "/nowhere.gpkg";
  EXPECT_THROW(read(query), FileError);
}

TEST_F(FootprintReader, UsesZAsAsked) {
  FootprintQuery query;
  query.path = layer(feature(R"("b":40)", "Polygon",
                             "[[[300000,200000,51],[300010,200000,52],[300010,200010,53],[300000,200000,51]]]"));
  EXPECT_FALSE(read(query).features[0].base);
  EXPECT_EQ(read(query).warnings.size(), 1U);
  query.z = FootprintZ::base;
  EXPECT_EQ(read(query).features[0].base, 51);
  query.base_field = "b";
  query.z = FootprintZ::top;
  EXPECT_EQ(read(query).features[0].base, 40);
  EXPECT_EQ(read(query).features[0].height, 13);
}

TEST_F(FootprintReader, TakesThePlanOfModelsInThreeDimensions) {
  const std::string faces =
      "((300000 200000 0,300000 200010 0,300010 200010 0,300010 200000 0,300000 200000 0)),"
      "((300000 200000 9,300010 200000 9,300010 200010 9,300000 200010 9,300000 200000 9)),"
      "((300000 200000 0,300010 200000 0,300010 200000 9,300000 200000 9,300000 200000 0)),"
      "((300000 200010 0,300000 200010 9,300010.001 200010 9,300010 200010 0,300000 200010 0))";
  for (const std::string type : {"POLYHEDRALSURFACE Z", "MULTIPOLYGON Z"}) {
    FootprintQuery query;
    query.path = write("f.csv", "id,h,WKT\n1,9,\"" + type + "(" + faces + ")\"\n");
    query.crs = "EPSG:27700";
    query.height_field = "h";
    const FootprintSource source = read(query);
    ASSERT_EQ(source.features.size(), 1U) << type;
    EXPECT_EQ(source.features[0].rings.size(), 1U) << type;
    EXPECT_EQ(source.features[0].height, 9);
    for (const std::string& line : source.warnings) EXPECT_EQ(line.find("crosses"), std::string::npos) << line;
  }
}

TEST_F(FootprintReader, ReadsHeightsAsPeopleWriteThem) {
  const std::string square = "[[[300000,200000],[300010,200000],[300010,200010],[300000,200000]]]";
  FootprintQuery query;
  query.height_field = "h";
  const auto height = [&](const std::string& json) {
    query.path = layer(feature("\"h\":" + json, "Polygon", square));
    return read(query).features.at(0).height.value_or(-1);
  };
  EXPECT_DOUBLE_EQ(height(R"("12 m")"), 12);
  EXPECT_DOUBLE_EQ(height(R"("12,5m")"), 12.5);
  EXPECT_DOUBLE_EQ(height(R"("12.5 metres")"), 12.5);
  EXPECT_DOUBLE_EQ(height(R"("40 ft")"), 40 * 0.3048);
  EXPECT_DOUBLE_EQ(height(R"("39'4\"")"), (39 + 4 / 12.0) * 0.3048);
  EXPECT_DOUBLE_EQ(height(R"("39'")"), 39 * 0.3048);
  EXPECT_DOUBLE_EQ(height(R"("12")"), 12);
  EXPECT_EQ(height(R"("12 bananas")"), -1);
  query.storey = 3.2;
  EXPECT_DOUBLE_EQ(height(R"("4")"), 12.8);
  EXPECT_DOUBLE_EQ(height("4"), 12.8);
  EXPECT_DOUBLE_EQ(height(R"("12 m")"), 12);
}

TEST_F(FootprintReader, TakesFeetForFeet) {
  FootprintQuery query;
  query.path =
      write("f.csv", "id,h,WKT\n1,100,\"POLYGON((1000000 200000,1000030 200000,1000030 200030,1000000 200000))\"\n");
  query.crs = "EPSG:2263";  // New York, US survey feet
  query.height_field = "h";
  const FootprintSource source = read_footprints(query, wkt("EPSG:26918"), {{585000, 4511000}, 0.01}, quiet);
  ASSERT_EQ(source.features.size(), 1U);
  EXPECT_NEAR(*source.features[0].height, 30.48006, 1e-4);
}

/// A cube of a building, in which the text `from` became `to`.
std::string cube_with(const std::string& from, const std::string& to) {
  std::string text = R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},
    "appearance":{"materials":[{"name":"brick"}]},
    "geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}],
      "vertices-templates":[[0,0,0],[1,0,0],[0,1,0]]},
    "CityObjects":{"hut":{"type":"Building","geometry":[
      {"type":"GeometryInstance","template":0,"boundaries":[0],
       "transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},
      {"type":"MultiSurface","lod":"2","boundaries":[[[0,3,2,1]],[[4,5,6,7]]],
       "semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"RoofSurface"}],"values":[0,1]},
       "material":{"":{"values":[0,null]}}}]}},
    "vertices":[[0,0,0],[9,0,0],[9,9,0],[0,9,0],[0,0,5],[9,0,5],[9,9,5],[0,9,5]]})";
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(FootprintReader, RefusesIndicesThatAreNoWholeNumbersInRange) {
  const auto read_text = [&](const std::string& text) {
    CityJsonQuery query;
    query.path = write("cube.json", text);
    query.crs = "EPSG:28992";
    return read_city_json(query, wkt("EPSG:28992"));
  };
  EXPECT_EQ(read_text(cube_with("5]", "5]")).features.size(), 1U);
  EXPECT_EQ(read_text(cube_with("[4,5,6,7]", "[4,5,6,7.0]")).features.size(), 1U);
  struct Damage {
    std::string from, to, said;
  };
  std::vector<Damage> damages;
  for (const std::string bad : {"-1", "1.5", "8", "4294967296", "4294967300", "1e300", "\"1\"", "true", "{}"}) {
    damages.push_back({"[4,5,6,7]", "[4,5,6," + bad + "]", "is no index of one of 8 vertices"});
    damages.push_back({"\"boundaries\":[0]", "\"boundaries\":[" + bad + "]", "is no index of one of 8 vertices"});
    damages.push_back({"\"values\":[0,1]", "\"values\":[0," + bad + "]", "is no index of one of 2 semantic surfaces"});
    damages.push_back({"[0,null]", "[" + bad + ",null]", "is no index of one of 1 materials"});
    damages.push_back({"\"template\":0", "\"template\":" + bad, "is no index of one of 1 geometry templates"});
    damages.push_back({"[0,1,2]", "[0,1," + bad + "]", "is no index of one of 3 vertices"});
  }
  for (const std::string bad : {"[1,1]", "[1,1,\"1\"]", "1", "[1,1,null]"}) {
    damages.push_back({"\"scale\":[1,1,1]", "\"scale\":" + bad, "scale of the transform"});
    damages.push_back({"[9,9,5]", bad, "vertices"});
  }
  damages.push_back({"[4,5,6,7]", "[[[[[[4,5,6,7]]]]]]", "nested more than 5 deep"});
  // No deeper recursion than that.
  damages.push_back({"[4,5,6,7]", std::string(200000, '[') + std::string(200000, ']'), "nested more than 5 deep"});
  damages.push_back({"[4,5,6,7]", "7", "an array of vertex indices belongs"});
  damages.push_back({"\"type\":\"Building\",", "", "hut: has no 'type'"});
  damages.push_back({"\"lod\":\"2\",\"boundaries\":[[[0,3", "\"lod\":[],\"boundaries\":[[[0,3", "'lod' is an array"});
  damages.push_back({"[9,9,5]", "[9,9,1e999]", "holds a number beyond all bounds"});
  damages.push_back({"[9,9,5]", "[9,9,", "is no JSON"});
  for (const Damage& damage : damages) {
    const std::string text = cube_with(damage.from, damage.to);
    EXPECT_THAT([&] { read_text(text); },
                ThrowsMessage<FileError>(AllOf(HasSubstr("cube.json: "), HasSubstr(damage.said))))
        << damage.to;
  }
  EXPECT_THAT([&] { read_text(cube_with("[9,9,5]", "[9,9,5e6]")); },
              ThrowsMessage<InputError>(HasSubstr("cube.json: hut: a height of 5e+06 m is beyond 1000000 m")));
}

TEST_F(FootprintReader, RefusesHeightsBeyondAllAndNamesTheFeature) {
  FootprintQuery query;
  query.path =
      layer(feature(R"("h":5e6)", "Polygon", "[[[300000,200000],[300010,200000],[300010,200010],[300000,200000]]]"));
  query.height_field = "h";
  EXPECT_THAT([&] { read(query); },
              ThrowsMessage<InputError>(HasSubstr("feature 0: h: a height of 5e+06 m is beyond")));
}

TEST_F(FootprintReader, RefusesBrokenCityJson) {
  CityJsonQuery query;
  query.path = write("a.json", R"({"type":"CityJSON","version":"2.0","CityObjects":{"x":{"type":"Building","geometry":[
    {"type":"Solid","lod":"1","boundaries":[[[[0,1,7]]]]}]}},"vertices":[[0,0,0],[1,0,0],[0,1,0]]})");
  query.crs = "EPSG:28992";
  EXPECT_THROW(read_city_json(query, wkt("EPSG:28992")), FileError);
  query.path = write("b.json", "{ not json");
  EXPECT_THROW(read_city_json(query, wkt("EPSG:28992")), FileError);
  query.path = write("c.json", R"({"type":"Feature"})");
  EXPECT_THROW(read_city_json(query, wkt("EPSG:28992")), FileError);
  query.path = "/nowhere.json";
  EXPECT_THROW(read_city_json(query, wkt("EPSG:28992")), FileError);
}

void print(const std::string& what, const FootprintSource& source, const FeatureMesh& mesh) {
  std::cout << what << ": " << source.features.size() << " features, " << mesh.built << " built, " << mesh.refused
            << " refused (" << 100.0 * static_cast<double>(mesh.refused) / static_cast<double>(source.features.size())
            << " %), " << mesh.flat_instead << " flat instead, " << mesh.vertices.size() << " vertices, "
            << mesh.findings.size() << " findings\n";
  for (std::size_t i = 0; i < std::min<std::size_t>(mesh.findings.size(), 12); ++i)
    std::cout << "  " << mesh.findings[i].text << "\n";
}

Grid grid_about(const FootprintSource& source) {
  for (const FootprintFeature& f : source.features) {
    if (!f.rings.empty()) return {{std::floor(f.rings[0][0].x), std::floor(f.rings[0][0].y)}, 0.01};
    if (!f.surfaces.empty())
      return {{std::floor(f.surfaces[0].rings[0][0].x), std::floor(f.surfaces[0].rings[0][0].y)}, 0.01};
  }
  return {};
}

void expect_sound(const FeatureMesh& mesh) {
  std::vector<GridEdge> edges;
  for (const FeatureSegment& s : mesh.segments)
    edges.emplace_back(test::at(mesh.vertices[s.from]), test::at(mesh.vertices[s.to]));
  if (edges.size() < 8000) {
    test::expect_planar(mesh);
    if (!reported(mesh, "were joined")) test::expect_masked(mesh);
  }
  EXPECT_FALSE(mesh.segments.empty());
}

/// The posts of a raster of metres, in its own CRS.
Tin raster_tin(const std::string& path) {
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
  double t[6];
  dataset->GetGeoTransform(t);
  const int columns = dataset->GetRasterXSize(), rows = dataset->GetRasterYSize();
  std::vector<double> z(static_cast<std::size_t>(columns) * rows);
  EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, z.data(), columns, rows, GDT_Float64, 0,
                                                0, nullptr),
            CE_None);
  return test::lattice_tin(columns, rows, t[1],
                           [&](auto c, auto r) { return z[static_cast<std::size_t>(rows - 1 - r) * columns + c]; },
                           0.01, {t[0] + t[1] / 2, t[3] + t[5] * (rows - 0.5)});
}

TEST(RealFootprints, Alexandria) {
  const std::string path = data("alexandria-va-2m/buildings.shp");
  SKIP_WITHOUT(path);
  const Tin tin = raster_tin(data("alexandria-va-2m/dtm.tif"));
  const TerrainHeights terrain(tin);
  for (const RoofKind roof : {RoofKind::flat, RoofKind::gabled, RoofKind::hipped, RoofKind::skeleton}) {
    FootprintQuery query;
    query.path = path;
    query.height_field = "HEIGHT";
    query.roof = roof;
    const FootprintSource source = read_footprints(query, wkt("EPSG:26918"), tin.grid, quiet);
    ASSERT_EQ(source.features.size(), 84U);
    const FeatureMesh mesh = test::meshed(source.features, &terrain);
    print("Alexandria, roof " + std::to_string(static_cast<int>(roof)), source, mesh);
    EXPECT_EQ(mesh.built + mesh.refused, 84U);
    EXPECT_GE(mesh.built, 80U);
    EXPECT_LE(mesh.flat_instead, 4U);
    expect_sound(mesh);
  }
}

TEST(RealFootprints, DelftOutlinesWithThePeersHeights) {
  const std::string path = data("ahn3-bgt-delft/bgt/bgt_pand.sqlite");
  SKIP_WITHOUT(path);
  std::map<std::string, double> measured;
  std::ifstream peer(data("ahn3-bgt-delft/output/testarea.json"));
  const auto peers = nlohmann::json::parse(peer);
  for (const auto& [name, object] : peers["CityObjects"].items())
    if (object["type"] == "Building")
      measured[object["attributes"]["lokaalid"]] = object["attributes"]["measuredHeight"];
  ASSERT_EQ(measured.size(), 160U);
  FootprintQuery query;
  query.path = path;
  query.kept.name_field = "lokaalid";
  FootprintSource source = read_footprints(query, wkt("EPSG:28992"), {{84900, 447500}, 0.01}, quiet);
  ASSERT_EQ(source.features.size(), 160U);
  for (FootprintFeature& f : source.features) {
    f.height = measured.at(f.name);
    f.base = 0;
  }
  for (const RoofKind roof : {RoofKind::flat, RoofKind::skeleton}) {
    for (FootprintFeature& f : source.features) f.roof = roof;
    FeatureOptions options;
    options.grid = grid_about(source);
    NoProgress progress;
    const FeatureMesh mesh = build_feature_mesh(source.features, options, nullptr, progress);
    print("Delft, roof " + std::to_string(static_cast<int>(roof)), source, mesh);
    EXPECT_EQ(mesh.built + mesh.refused, 160U);
    EXPECT_GE(mesh.built, 150U);
    expect_sound(mesh);
  }
}

TEST(RealFootprints, DelftPlantsAndFences) {
  const std::string plants = data("ahn3-bgt-delft/bgt/bgt_begroeidterreindeel.sqlite");
  SKIP_WITHOUT(plants);
  const Tin tin = test::lattice_tin(90, 70, 8, [](auto c, auto r) { return std::sin(c * 0.7) + std::cos(r * 0.9); },
                                    0.01, {84600, 447350});
  const TerrainHeights terrain(tin);
  FootprintQuery query;
  query.path = plants;
  query.kind = FeatureKind::vegetation;
  query.height = 3;
  FootprintSource source = read_footprints(query, wkt("EPSG:28992"), tin.grid, quiet);
  FeatureMesh mesh = test::meshed(source.features, &terrain);
  print("Delft plants", source, mesh);
  EXPECT_EQ(mesh.built + mesh.refused, 126U);
  EXPECT_GE(mesh.built, 118U);
  expect_sound(mesh);
  query.path = data("ahn3-bgt-delft/bgt/bgt_scheiding.sqlite");
  query.kind = FeatureKind::wall;
  source = read_footprints(query, wkt("EPSG:28992"), tin.grid, quiet);
  mesh = test::meshed(source.features, &terrain);
  print("Delft fences", source, mesh);
  EXPECT_EQ(mesh.built + mesh.refused, 57U);
  expect_sound(mesh);
}

struct City {
  std::string path, crs;
  std::size_t buildings;
};

class RealCities : public testing::TestWithParam<City> {};

TEST_P(RealCities, StandUp) {
  const City city = GetParam();
  SKIP_WITHOUT(data(city.path));
  CityJsonQuery query;
  query.path = data(city.path);
  query.crs = city.crs;
  const FootprintSource source = read_city_json(query, wkt(city.crs));
  EXPECT_EQ(source.features.size(), city.buildings);
  for (const std::string& line : source.warnings) std::cout << "  " << line << "\n";
  FeatureOptions options;
  options.grid = grid_about(source);
  NoProgress progress;
  const FeatureMesh mesh = build_feature_mesh(source.features, options, nullptr, progress);
  print(city.path, source, mesh);
  EXPECT_EQ(mesh.built + mesh.refused, source.features.size());
  expect_sound(mesh);
  // No roof stands higher or lower than its surfaces.
  for (std::uint32_t f = 0; f < source.features.size(); ++f) {
    double low = INFINITY, high = -INFINITY;
    for (const RoofSurface& s : source.features[f].surfaces)
      for (const auto& ring : s.rings)
        for (const Point3& p : ring) low = std::min(low, p.z), high = std::max(high, p.z);
    const auto [least, greatest] = test::heights(mesh, f, SegmentClass::eaves);
    if (least > greatest) continue;
    EXPECT_GE(least, low - 0.3) << source.features[f].name;
    EXPECT_LE(greatest, high + 0.3) << source.features[f].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, RealCities,
                         testing::Values(City{"cityjson-samples/delft.json", "EPSG:28992", 160},
                                         City{"cityjson-samples/rotterdam_subset.json", "EPSG:28992", 16},
                                         City{"cityjson-samples/zurich_subset_lod2.json", "EPSG:2056", 161}));

}  // namespace
}  // namespace itin
