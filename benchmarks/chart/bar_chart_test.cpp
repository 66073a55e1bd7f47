#include "chart/bar_chart.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>

#include "chart/bar_chart_layout.hpp"

namespace itin::bars {

namespace {

BarChart chart_of(std::size_t series, std::size_t groups) {
  BarChart chart{"Viewsheds beside gdal_viewshed", "of one run", "time, s", 1.0, {}, {}};
  for (std::size_t i = 0; i < series; ++i) chart.series.push_back("series with a long name, " + std::to_string(i));
  for (std::size_t g = 0; g < groups; ++g) {
    BarGroup group{"terrain " + std::string(20 * g, 'm'), {}};
    for (std::size_t i = 0; i < series; ++i) {
      const double value = 0.3 * static_cast<double>(g * i);
      group.bars.push_back({i, value, std::to_string(value) + " (12.34 s)"});
    }
    chart.groups.push_back(std::move(group));
  }
  return chart;
}

/// The letters' extent, a little less than the line's height.
Box box_of(const PlacedText& text) {
  const profile::Drawing measure(profile::Drawing::Format::kSvg, 1, 1);
  const double width = measure.text_width(text.text, text.lettering);
  double left = text.anchor.x;
  if (text.lettering.align == profile::Align::kCentre) left -= width / 2;
  if (text.lettering.align == profile::Align::kRight) left -= width;
  return {left, text.anchor.y - 0.75 * text.lettering.size, left + width, text.anchor.y + 0.2 * text.lettering.size};
}

void expect_legible(const BarChartLayout& layout) {
  std::vector<Box> boxes;
  for (const PlacedText& text : layout.texts) {
    const Box box = box_of(text);
    EXPECT_TRUE(box.xmin >= 0 && box.ymin >= 0 && box.xmax <= layout.width && box.ymax <= layout.height) << text.text;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_FALSE(box.meets(boxes[i])) << text.text << " and " << layout.texts[i].text;
    }
    boxes.push_back(box);
  }
}

TEST(BarChart, HasTextsThatStandApart) {
  for (const std::size_t series : {1, 3, 9}) {
    for (const std::size_t groups : {1, 9}) expect_legible(lay_out(chart_of(series, groups)));
  }
}

TEST(BarChart, HasBarsAsLongAsTheirValues) {
  const BarChart chart = chart_of(3, 4);
  const BarChartLayout layout = lay_out(chart);
  EXPECT_EQ(layout.axis.low, 0);
  EXPECT_EQ(layout.ticks.front(), 0);
  std::size_t at = 0;
  for (const BarGroup& group : chart.groups) {
    for (const Bar& bar : group.bars) {
      const PlacedBar& placed = layout.bars.at(at++);
      EXPECT_EQ(placed.series, bar.series);
      EXPECT_EQ(placed.box.xmin, layout.frame.xmin);
      EXPECT_NEAR(placed.box.xmax - placed.box.xmin, bar.value / layout.axis.high * layout.frame.width(), 1e-9);
      EXPECT_LE(placed.box.xmax, layout.frame.xmax);
    }
  }
  EXPECT_EQ(at, layout.bars.size());
}

TEST(BarChart, KeepsWhatBarsSayWhole) {
  const BarChart chart = chart_of(3, 9);
  const BarChartLayout layout = lay_out(chart);
  for (const BarGroup& group : chart.groups) {
    for (const Bar& bar : group.bars) {
      EXPECT_TRUE(std::any_of(layout.texts.begin(), layout.texts.end(), [&](const PlacedText& text) {
        return text.text == bar.text;
      })) << bar.text;
    }
  }
}

TEST(BarChart, ClearsNoBar) {
  const BarChartLayout layout = lay_out(chart_of(3, 9));
  ASSERT_EQ(layout.clearings.size(), layout.bars.size());
  for (const Box& cleared : layout.clearings) {
    for (const PlacedBar& bar : layout.bars) {
      const bool beside = cleared.ymin >= bar.box.ymax || bar.box.ymin >= cleared.ymax;
      EXPECT_TRUE(beside || cleared.xmin >= bar.box.xmax);
    }
  }
}

TEST(BarChart, CutsNamesThatAreTooLong) {
  BarChart chart = chart_of(2, 1);
  chart.groups[0].name = chart.title = chart.axis = std::string(400, 'w');
  expect_legible(lay_out(chart));
}

TEST(BarChart, IsReadFromJson) {
  const auto document = nlohmann::json::parse(R"({"title": "T", "note": "N", "axis": "time, s", "line": 1,
    "series": ["exact"], "groups": [{"name": "fractal", "bars": [{"series": 0, "value": 0.97, "text": "0.97 s"}]}]})");
  const BarChart chart = bar_chart_from(document);
  EXPECT_EQ(chart.line, 1.0);
  EXPECT_EQ(chart.groups.at(0).name, "fractal");
  EXPECT_EQ(chart.groups.at(0).bars.at(0).value, 0.97);
  EXPECT_TRUE(draw(chart, profile::Drawing::Format::kPng).starts_with("\x89PNG"));
  EXPECT_EQ(draw(chart, profile::Drawing::Format::kPng), draw(chart, profile::Drawing::Format::kPng));
  EXPECT_NE(draw(chart, profile::Drawing::Format::kSvg).find("0.97 s"), std::string::npos);
}

TEST(BarChart, RefusesWhatIsNoChart) {
  const auto valid = nlohmann::json::parse(R"({"title": "T", "note": "N", "axis": "A", "series": ["exact"],
    "groups": [{"name": "g", "bars": [{"series": 0, "value": 1, "text": ""}]}]})");
  EXPECT_NO_THROW(bar_chart_from(valid));
  for (const char* field : {"title", "note", "axis", "series", "groups"}) {
    nlohmann::json without = valid;
    without.erase(field);
    EXPECT_THROW(bar_chart_from(without), InputError) << field;
  }
  nlohmann::json wrong = valid;
  wrong["groups"][0]["bars"][0]["value"] = -1;
  EXPECT_THROW(bar_chart_from(wrong), InputError);
  wrong = valid;
  wrong["groups"][0]["bars"][0]["series"] = 1;
  EXPECT_THROW(bar_chart_from(wrong), InputError);
}

}  // namespace

}  // namespace itin::bars
