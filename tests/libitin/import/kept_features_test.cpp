// What imports keep of features besides geometry, and what they refuse or pass over.
#include "import/source/layers/kept_features.hpp"

#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include <itin/error.hpp>

#include "gdal/crs.hpp"
#include "import/footprints/city_json.hpp"
#include "import/footprints/footprint_reader.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

const AttributeValue kNone;
AttributeValue text_value(const std::string& value) {
  return value;
}
AttributeValue whole(std::int64_t value) {
  return value;
}

class KeptFeatures : public testing::Test {
 protected:
  std::string wkt() const { return parse_crs("EPSG:28992", "test").wkt; }

  FootprintSource read_layer(const FeatureQuery& kept) const {
    FootprintQuery query;
    query.path = path_;
    query.crs = "EPSG:28992";
    query.height = 3;
    query.kept = kept;
    NoProgress progress;
    return read_footprints(query, wkt(), {{100000, 400000}, 0.01}, progress);
  }
  /// Squares with these properties.
  FootprintSource read(const std::vector<std::string>& properties, const FeatureQuery& kept) {
    std::string features;
    for (const std::string& p : properties)
      features += (features.empty() ? "" : ",") +
                  (R"({"type":"Feature","properties":{)" + p +
                   R"(},"geometry":{"type":"Polygon","coordinates":[[[100000,400000],[100009,400000],)"
                   R"([100009,400009],[100000,400000]]]}})");
    path_ = directory_.write("f.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
    return read_layer(kept);
  }
  FootprintSource read_city(const std::string& attributes, const FeatureQuery& kept) {
    CityJsonQuery query;
    query.path = directory_.write("c.json", R"({"type":"CityJSON","version":"2.0","CityObjects":{
      "farm":{"type":"Building","children":["barn"],"attributes":)" +
                                                attributes + R"(},
      "barn":{"type":"BuildingPart","parents":["farm","yard"],"attributes":{"floors":2,"use":null},"geometry":[
        {"type":"MultiSurface","lod":"1","boundaries":[[[0,3,2,1]],[[4,5,6,7]]]}]},
      "yard":{"type":"CityObjectGroup","attributes":{"year":[1]}}},
      "vertices":[[0,0,0],[9,0,0],[9,9,0],[0,9,0],[0,0,5],[9,0,5],[9,9,5],[0,9,5]]})");
    query.crs = "EPSG:28992";
    query.kept = kept;
    return read_city_json(query, wkt());
  }

  const test::TemporaryDirectory directory_;
  const std::string long_ = std::string(kLongestText + 1, 'x');
  std::string path_;
};

TEST_F(KeptFeatures, AreAllThatALayerSays) {
  const FootprintSource source =
      read({R"("ref":"B 7","width":3.5,"floors":2,"built":"1887/06/21","tags":["a","b"])", R"("ref":null,"width":4)"},
           {.id_field = "ref", .name_field = "built"});
  using Type = AttributeType;
  EXPECT_EQ(source.fields,
            (std::vector<AttributeField>{
                {"ref", Type::text}, {"width", Type::number}, {"floors", Type::whole}, {"built", Type::text}}));
  ASSERT_EQ(source.records.size(), 2U);
  EXPECT_EQ(source.records[0].id, "B 7");
  EXPECT_EQ(source.records[0].name, "1887/06/21");
  EXPECT_THAT(source.records[0].values,
              ElementsAre(text_value("B 7"), AttributeValue(3.5), whole(2), text_value("1887/06/21")));
  EXPECT_EQ(source.records[1].id, "");
  EXPECT_THAT(source.records[1].values, ElementsAre(kNone, AttributeValue(4.0), kNone, kNone));
  EXPECT_EQ(source.features[0].name, "1887/06/21");
  EXPECT_EQ(source.features[1].name, "feature 1");
  EXPECT_THAT(source.warnings, ElementsAre(HasSubstr("f.geojson: field 'tags' is not kept: it holds StringList")));
}

TEST_F(KeptFeatures, AreThoseAskedFor) {
  const std::string one = R"("ref":"B 7","width":3.5,"tags":["a","b"])";
  const FootprintSource source = read({one}, {.attributes = {{"width"}}});
  EXPECT_EQ(source.records[0].id, "0");
  EXPECT_THAT(source.records[0].values, ElementsAre(AttributeValue(3.5)));
  EXPECT_THAT(read({one}, {.attributes = {{}}}).records, IsEmpty());
  const auto refuses = [&](const FeatureQuery& kept, const std::string& said) {
    EXPECT_THAT([&] { read({one}, kept); }, ThrowsMessage<Error>(HasSubstr(said)));
  };
  refuses({.attributes = {{"colour"}}},
          "f.geojson: layer 'f' has no field 'colour'; it has [\"ref\", \"width\", \"tags\"]");
  refuses({.id_field = "colour"}, "has no field 'colour'");
  refuses({.name_field = "colour"}, "has no field 'colour'");
  refuses({.attributes = {{"tags"}}},
          "field 'tags' holds StringList; `attributes` are numbers, texts, dates and times");
  refuses({.attributes = {{"width", "WIDTH"}}}, "`attributes`: 'width' comes twice");
  ImportOptions options;
  options.attributes = {{"ref", "width", "ref"}};
  EXPECT_THAT([&] { feature_query(options); }, ThrowsMessage<InputError>("`attributes`: 'ref' comes twice"));
}

TEST_F(KeptFeatures, AreNoTextsBeyondTheLimit) {
  const std::string just = std::string(kLongestText, 'x');
  EXPECT_THAT(read({R"("note":")" + just + '"'}, {.attributes = {{"note"}}}).records[0].values,
              ElementsAre(text_value(just)));
  const std::vector<std::string> two{R"("note":")" + long_ + R"(","n":1)", R"("note":")" + long_ + R"(","n":2)"};
  const auto refuses = [&](const FeatureQuery& kept) {
    EXPECT_THAT([&] { read(two, kept); },
                ThrowsMessage<InputError>(HasSubstr(
                    "f.geojson: feature 0: note has 4097 bytes, and at most 4096 are kept; name another field")));
  };
  refuses({.attributes = {{"note"}}});
  refuses({.id_field = "note"});
  refuses({.name_field = "note"});
  // Where nobody asked for it, an import does not fail for it.
  const FootprintSource source = read(two, {});
  EXPECT_THAT(source.records[1].values, ElementsAre(kNone, whole(2)));
  EXPECT_THAT(source.warnings, ElementsAre(HasSubstr("f.geojson: texts with more than 4096 bytes are not kept: note of "
                                                     "feature 0 and 1 more")));
}

TEST_F(KeptFeatures, AreTheFirstOfTwoFieldsOfOneName) {
  path_ = directory_.write("f.csv",
                           "WKT,use,use\n\"POLYGON((100000 400000,100009 400000,100009 400009,100000 400000))\",a,b\n");
  const FootprintSource source = read_layer({});
  ASSERT_EQ(source.fields.size(), 2U);
  EXPECT_EQ(source.records[0].values[1], text_value("a"));
  EXPECT_THAT(source.warnings, ElementsAre(HasSubstr("f.csv: has two fields 'use'; the first is kept")));
}

TEST_F(KeptFeatures, AreAtMost255Fields) {
  std::string many = R"("f0":0)";
  for (std::size_t i = 1; i <= kMostAttributes; ++i) many += ",\"f" + std::to_string(i) + "\":0";
  EXPECT_THAT([&] { read({many}, {}); },
              ThrowsMessage<InputError>(
                  HasSubstr("f.geojson: a theme keeps at most 255 fields; name those to keep with `attributes`")));
  EXPECT_EQ(read({many}, {.attributes = {{"f255"}}}).fields.size(), 1U);
}

TEST_F(KeptFeatures, OfPartsOfABuildingAreItsOwn) {
  const std::string attributes =
      R"({"floors":1,"use":"byre","year":1790,"listed":true,"area":81.5,"owners":["a"],"big":18446744073709551615})";
  const FootprintSource source = read_city(attributes, {});
  using Type = AttributeType;
  EXPECT_EQ(source.fields, (std::vector<AttributeField>{{"area", Type::number},
                                                        {"big", Type::number},
                                                        {"floors", Type::whole},
                                                        {"listed", Type::whole},
                                                        {"use", Type::text},
                                                        {"year", Type::whole}}));
  ASSERT_EQ(source.records.size(), 1U);
  EXPECT_EQ(source.records[0].id, "barn");
  EXPECT_THAT(source.records[0].values, ElementsAre(AttributeValue(81.5), AttributeValue(18446744073709551615.0),
                                                    whole(2), whole(1), text_value("byre"), whole(1790)));
  const FootprintSource named =
      read_city(attributes, {.id_field = "year", .name_field = "use", .attributes = {{"floors"}}});
  EXPECT_EQ(named.records[0], (FeatureRecord{"1790", "byre", {std::int64_t{2}}}));
  EXPECT_EQ(named.features[0].name, "byre");
  const auto not_kept = HasSubstr("c.json: attributes that hold lists or objects are not kept: owners");
  EXPECT_THAT(source.warnings, Contains(not_kept));
  EXPECT_THAT(named.warnings, Not(Contains(not_kept)));
  // One building has a text where the other has a number.
  EXPECT_THAT(read_city(R"({"floors":"ground"})", {}).records[0].values, ElementsAre(text_value("2")));
}

TEST_F(KeptFeatures, OfBuildingsAreRefusedAsThoseOfLayers) {
  const auto refuses = [&](const std::string& attributes, const FeatureQuery& kept, const std::string& said) {
    EXPECT_THAT([&] { read_city(attributes, kept); }, ThrowsMessage<Error>(HasSubstr(said)));
  };
  const std::string owned = R"({"owners":["a"]})";
  refuses(owned, {.attributes = {{"colour"}}},
          "c.json: no building has an attribute 'colour'; they have [\"floors\", \"owners\"]");
  refuses(owned, {.id_field = "colour"}, "no building has an attribute 'colour'");
  refuses(owned, {.name_field = "owners"}, "c.json: attribute 'owners' holds lists or objects");
  refuses(R"({"note":")" + long_ + "\"}", {.attributes = {{"note"}}}, "c.json: barn: note has 4097 bytes");
  refuses("7", {}, "c.json: farm: ");
  EXPECT_THAT(read_city(R"({"note":")" + long_ + "\"}", {}).warnings,
              testing::Contains(HasSubstr("c.json: a text with more than 4096 bytes is not kept: note of barn")));
}

TEST_F(KeptFeatures, OfSeveralSourcesShareTheFieldsOfATheme) {
  std::vector<AttributeField> theme;
  using Type = AttributeType;
  EXPECT_THAT(places_among(theme, {{"a", Type::whole}, {"b", Type::whole}, {"c", Type::number}}, "x"),
              ElementsAre(0, 1, 2));
  const auto places = places_among(theme, {{"d", Type::text}, {"b", Type::number}, {"c", Type::text}}, "y");
  EXPECT_THAT(places, ElementsAre(3, 1, 2));
  EXPECT_EQ(theme, (std::vector<AttributeField>{
                       {"a", Type::whole}, {"b", Type::number}, {"c", Type::text}, {"d", Type::text}}));
  EXPECT_EQ(arranged({"1", "n", {text_value("x"), whole(2), kNone}}, places),
            (FeatureRecord{"1", "n", {kNone, whole(2), kNone, text_value("x")}}));
  std::vector<AttributeField> many(kMostAttributes, {"z", Type::text});
  EXPECT_THAT(
      [&] {
        places_among(many, {{"a", Type::text}}, "y.gpkg");
      },
      ThrowsMessage<InputError>(HasSubstr("y.gpkg: a theme keeps at most 255 fields")));
}

}  // namespace
}  // namespace itin
