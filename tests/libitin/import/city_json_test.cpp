// The tops of buildings in CityJSON, whatever their faces are called and wherever they face.
#include "import/footprints/city_json.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>

#include "gdal/crs.hpp"
#include "import/footprints/city_json_values.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A hall of 20 by 10 m with a flat roof at 8 m, beside a porch of 5 by 10 m at 3 m, on a floor of both. Its faces are
/// the floor (0), the roofs of the hall (1) and of the porch (2), and the wall between these roofs (3).
constexpr const char* kFaces = "[[0,1,4,5]],[[6,7,8,9]],[[10,11,12,13]],[[10,7,8,13]]";
constexpr const char* kVertices =
    "[0,0,0],[0,10,0],[20,10,0],[20,0,0],[25,10,0],[25,0,0],[0,0,8],[20,0,8],[20,10,8],[0,10,8],[20,0,3],[25,0,3],"
    "[25,10,3],[20,10,3]";

class CityTops : public testing::Test {
 protected:
  FootprintSource read(const std::string& faces, const std::string& semantics = "") {
    CityJsonQuery query;
    query.path = directory_.write(
        "city.json",
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[85000,447000,0]},
        "CityObjects":{"hall":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[)" +
            faces + "]" + semantics + R"(}]}},"vertices":[)" + kVertices + "]}");
    query.crs = "EPSG:28992";
    return read_city_json(query, parse_crs("EPSG:28992", "test").wkt);
  }
  /// The members of a geometry that call its faces so.
  static std::string called(const std::string& floor, const std::string& hall, const std::string& porch) {
    return R"(,"semantics":{"surfaces":[{"type":")" + floor + R"("},{"type":")" + hall + R"("},{"type":")" + porch +
           R"("},{"type":"WallSurface"}],"values":[0,1,2,3]})";
  }
  /// The elevations of the roof's surfaces, ascending; all are level.
  static std::vector<double> tops(const FootprintSource& source) {
    std::vector<double> elevations;
    for (const FootprintFeature& feature : source.features)
      for (const RoofSurface& surface : feature.surfaces) elevations.push_back(surface.rings.at(0).at(0).z);
    std::sort(elevations.begin(), elevations.end());
    return elevations;
  }

  test::TemporaryDirectory directory_;
};

TEST_F(CityTops, CountWhateverTheyAreCalled) {
  for (const std::string porch : {"RoofSurface", "OuterFloorSurface", "WallSurface", "Window", "+GreenSurface"}) {
    const FootprintSource source = read(kFaces, called("GroundSurface", "RoofSurface", porch));
    EXPECT_THAT(tops(source), ElementsAre(3, 8)) << porch;
    EXPECT_THAT(source.warnings, IsEmpty()) << porch;
    EXPECT_EQ(source.features.at(0).base, 0) << porch;
  }
  EXPECT_THAT(tops(read(kFaces, called("GroundSurface", "OuterFloorSurface", "OuterFloorSurface"))), ElementsAre(3, 8));
  EXPECT_THAT(tops(read(kFaces, called("GroundSurface", "+RoofOfGlass", "+RoofOfGlass"))), ElementsAre(3, 8));
}

TEST_F(CityTops, CountThoughRoofAndGroundAreMistakenForEachOther) {
  const FootprintSource source = read(kFaces, called("RoofSurface", "GroundSurface", "GroundSurface"));
  EXPECT_THAT(tops(source), ElementsAre(3, 8));
  EXPECT_EQ(source.features.at(0).base, 0);
}

TEST_F(CityTops, CountWhereverTheyFace) {
  const std::string floor = "[[0,1,4,5]]", hall = "[[6,7,8,9]]", porch = "[[10,11,12,13]]";
  const std::string floor_up = "[[5,4,1,0]]", hall_down = "[[9,8,7,6]]", porch_down = "[[13,12,11,10]]";
  for (const std::string& f : {floor, floor_up})
    for (const std::string& h : {hall, hall_down})
      for (const std::string& p : {porch, porch_down}) {
        const std::string faces = f + "," + h + "," + p + ",[[10,7,8,13]]";
        for (const std::string& semantics : {std::string(), called("GroundSurface", "RoofSurface", "RoofSurface")}) {
          const FootprintSource source = read(faces, semantics);
          EXPECT_THAT(tops(source), ElementsAre(3, 8)) << faces;
          EXPECT_EQ(source.features.at(0).base, 0) << faces;
          EXPECT_THAT(source.warnings, IsEmpty()) << faces;
        }
      }
}

TEST_F(CityTops, AreNoClosuresWhichAreCounted) {
  const FootprintSource source = read(kFaces, called("GroundSurface", "RoofSurface", "ClosureSurface"));
  EXPECT_THAT(tops(source), ElementsAre(8));
  EXPECT_THAT(source.warnings, ElementsAre(HasSubstr("1 ClosureSurface left out, of hall for instance")));
}

TEST_F(CityTops, AreNoFloorsThatReachBeyondTheRoof) {
  for (const std::string& semantics : {std::string(), called("GroundSurface", "RoofSurface", "WallSurface")}) {
    const std::string faces = semantics.empty() ? "[[0,1,4,5]],[[6,7,8,9]]" : "[[0,1,4,5]],[[6,7,8,9]],[[10,7,8,13]]";
    EXPECT_THAT(tops(read(faces, semantics)), ElementsAre(8)) << faces;
  }
  // A building without a roof has no top, and says so.
  EXPECT_THAT(read("[[0,1,4,5]],[[10,7,8,13]]").warnings, Contains(HasSubstr("hall: passed over: has no roof")));
}

TEST_F(CityTops, MayBeAllThereIs) {
  EXPECT_THAT(tops(read("[[6,7,8,9]]")), ElementsAre(8));
  EXPECT_THAT(tops(read("[[9,8,7,6]]")), ElementsAre(8));
  EXPECT_THAT(tops(read("[[6,7,8,9]],[[10,11,12,13]]")), ElementsAre(3, 8));
}

TEST_F(CityTops, JoinPiecesOfOnePlaneThatAreWoundDifferently) {
  EXPECT_THAT(tops(read("[[0,1,4,5]],[[6,7,8]],[[6,9,8]],[[10,7,8,13]]")), ElementsAre(8));
}

TEST_F(CityTops, AreThoseOfTheGreatestLevelOfDetail) {
  CityJsonQuery query;
  query.crs = "EPSG:28992";
  query.path =
      directory_.write("lod.json", R"({"type":"CityJSON","version":"2.0","CityObjects":{"hut":{"type":"Building",
      "geometry":[{"type":"MultiSurface","lod":"2.2","boundaries":[[[0,1,2,3]]]},
                  {"type":"MultiSurface","lod":"3","boundaries":[[[4,5,6,7]]]}]}},
      "vertices":[[0,0,5],[9,0,5],[9,9,5],[0,9,5],[0,0,6],[9,0,6],[9,9,6],[0,9,6]]})");
  EXPECT_THAT(tops(read_city_json(query, parse_crs("EPSG:28992", "test").wkt)), ElementsAre(6));
}

TEST_F(CityTops, AreThoseOfTemplatesAtTheirPlaces) {
  CityJsonQuery query;
  query.crs = "EPSG:28992";
  // A square of 1 m at 1 m, twice as large and turned by a quarter, from 5 m above vertex 1.
  query.path = directory_.write("t.json", R"({"type":"CityJSON","version":"2.0",
      "transform":{"scale":[0.5,0.5,0.5],"translate":[85000,447000,0]},
      "geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2,3]]]}],
        "vertices-templates":[[0,0,1],[1,0,1],[1,1,1],[0,1,1]]},
      "CityObjects":{"hut":{"type":"Building","geometry":[{"type":"GeometryInstance","template":0,"boundaries":[1],
        "transformationMatrix":[0,-2,0,0,2,0,0,0,0,0,2,5,0,0,0,1]}]}},
      "vertices":[[0,0,0],[20,40,6]]})");
  const FootprintSource source = read_city_json(query, parse_crs("EPSG:28992", "test").wkt);
  ASSERT_THAT(tops(source), ElementsAre(10));
  double least = INFINITY, most = -INFINITY;
  for (const Point3& p : source.features[0].surfaces[0].rings[0])
    least = std::min(least, p.x), most = std::max(most, p.x);
  EXPECT_DOUBLE_EQ(least, 85008);
  EXPECT_DOUBLE_EQ(most, 85010);
}

TEST_F(CityTops, AreReadFromSequences) {
  CityJsonQuery query;
  query.kept.attributes = std::vector<std::string>{"storeys"};
  const auto building = [](const std::string& key, int storeys, int z) {
    const std::string top = std::to_string(z);
    return R"({"type":"CityJSONFeature","id":")" + key + R"(","CityObjects":{")" + key +
           R"(":{"type":"Building","attributes":{"storeys":)" + std::to_string(storeys) +
           R"(},"geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2,3]]]}]}},"vertices":[[0,0,)" + top +
           "],[9,0," + top + "],[9,9," + top + "],[0,9," + top + "]]}\n";
  };
  const std::string head = R"({"type":"CityJSON","version":"2.0","CityObjects":{},"vertices":[],
      "metadata":{"referenceSystem":"urn:ogc:def:crs,crs:EPSG::7415,crs:EPSG::5709"},
      "transform":{"scale":[1,1,1],"translate":[85000,447000,0]}})";
  std::string line = head;
  std::erase(line, '\n');
  query.path = directory_.write("a.city.jsonl", line + "\n" + building("b", 3, 8) + "\n" + building("a", 2, 5));
  const FootprintSource source = read_city_json(query, parse_crs("EPSG:28992", "test").wkt);
  EXPECT_THAT(tops(source), ElementsAre(5, 8));
  EXPECT_EQ(source.crs, "EPSG:7415");
  ASSERT_EQ(source.records.size(), 2U);
  EXPECT_EQ(source.records[0].id, "b");
  EXPECT_EQ(std::get<std::int64_t>(source.records[0].values.at(0)), 3);

  query.path = directory_.write("b.jsonl", line + "\n" + building("b", 3, 8) + building("b", 3, 8));
  EXPECT_THAT(read_city_json(query, parse_crs("EPSG:28992", "test").wkt).warnings,
              ElementsAre(HasSubstr("b: passed over: is in the file already")));
  query.path = directory_.write("c.jsonl", line + "\n{\"type\":\"CityJSONFeature\"");
  EXPECT_THAT([&] { read_city_json(query, parse_crs("EPSG:28992", "test").wkt); },
              testing::ThrowsMessage<FileError>(HasSubstr("line 2 is no JSON")));
}

TEST(CityJson, KnowsReferenceSystemsInEveryForm) {
  const auto stated = [](const std::string& text) {
    return reference_system({{"metadata", {{"referenceSystem", text}}}});
  };
  EXPECT_EQ(stated("urn:ogc:def:crs:EPSG::7415"), "EPSG:7415");
  EXPECT_EQ(stated("https://www.opengis.net/def/crs/EPSG/0/7415"), "EPSG:7415");
  EXPECT_EQ(stated("urn:ogc:def:crs,crs:EPSG::28992,crs:EPSG::5709"), "EPSG:28992+5709");
  EXPECT_EQ(stated("urn:ogc:def:crs,crs:EPSG:6.12:28992,crs:EPSG:6.12:5709"), "EPSG:28992+5709");
  EXPECT_EQ(stated("urn:ogc:def:crs,crs:EPSG::7415,crs:EPSG::5709"), "EPSG:7415");
  EXPECT_EQ(stated("http://www.opengis.net/def/crs-compound?1=http://www.opengis.net/def/crs/EPSG/0/28992&2="
                   "http://www.opengis.net/def/crs/EPSG/0/5709"),
            "EPSG:28992+5709");
  EXPECT_EQ(stated("EPSG:28992"), "EPSG:28992");
  EXPECT_EQ(reference_system(nlohmann::json::object()), "");
}

}  // namespace
}  // namespace itin
