#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/table_columns.hpp>

namespace itin {
namespace {

struct Mast {
  std::string name;
  double x = 0;
  std::optional<double> height = {};
  std::size_t serves = 0;
  bool ours = false;
};

const std::vector<Mast> kMasts{{"Garth, \"North\"", 318000.12345, 30, 7, true}, {"Caerphilly", 1e-7, std::nullopt, 0}};

std::vector<TableColumn<Mast>> mast_columns() {
  return {{"name", [](const Mast& m) { return m.name; }},
          {"x", [](const Mast& m) { return m.x; }, kInCsv, "{:.3f}"},
          {"height_m", [](const Mast& m) { return m.height; }},
          {"serves", [](const Mast& m) { return m.serves; }, kInLayer | kInDocument},
          {"ours", [](const Mast& m) { return m.ours; }, kInCsv | kInDocument},
          {"flag", [](const Mast& m) { return m.ours; }, kInCsv, kFlagsAsNumbers}};
}

TEST(TableColumns, MakeACsvInWhichNothingIsAnEmptyCell) {
  EXPECT_EQ(csv_of(mast_columns(), kMasts),
            "name,x,height_m,ours,flag\n"
            "\"Garth, \"\"North\"\"\",318000.123,30,yes,1\n"
            "Caerphilly,0.000,,no,0\n");
}

TEST(TableColumns, MakeALayerWhoseFieldsHaveTheTypesOfTheValues) {
  using enum VectorLayer::Type;
  const VectorLayer layer = layer_of("masts", VectorLayer::Shape::kPoints, mast_columns(), kMasts, [](const Mast& m) {
    return std::vector<Point3>{{m.x, 2, 3}};
  });
  const std::vector<std::pair<std::string, VectorLayer::Type>> fields{
      {"name", kText}, {"height_m", kNumber}, {"serves", kWhole}};
  EXPECT_EQ(layer.fields, fields);
  ASSERT_EQ(layer.features.size(), 2U);
  EXPECT_EQ(layer.features[0].points.front().x, kMasts[0].x);
  EXPECT_EQ(layer.features[0].values, (std::vector<VectorLayer::Value>{kMasts[0].name, 30.0, std::int64_t{7}}));
  EXPECT_EQ(layer.features[1].values[1], VectorLayer::Value());
}

TEST(TableColumns, MakeDocumentsWithoutWhatIsEmpty) {
  EXPECT_EQ(documents_of(mast_columns(), kMasts).dump(),
            R"([{"name":"Garth, \"North\"","height_m":30.0,"serves":7,"ours":true},)"
            R"({"name":"Caerphilly","serves":0,"ours":false}])");
}

TEST(TableColumns, KeepEveryDigitUnlessTheyAreToldOtherwise) {
  const std::vector<TableColumn<double>> columns{{"v", [](double v) { return v; }}};
  const double third = 1 / 3.0;
  const std::string csv = csv_of(columns, std::vector<double>{third});
  EXPECT_EQ(std::stod(csv.substr(2)), third);
}

}  // namespace
}  // namespace itin
