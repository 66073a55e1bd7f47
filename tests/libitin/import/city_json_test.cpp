// The tops of buildings in CityJSON, whatever their faces are called and wherever they face.
#include "import/footprints/city_json.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gdal/crs.hpp"
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

}  // namespace
}  // namespace itin
