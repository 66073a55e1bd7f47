// A chart of horizontal bars in groups, drawn as the charts of profiles are.
//
//   const BarChart chart = bar_chart_from(json);
//   const std::string png = draw(chart, profile::Drawing::Format::kPng);
//
// Bars begin at zero on a linear axis that they all share.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "drawing/drawing.hpp"

namespace itin::bars {

struct Bar {
  std::size_t series = 0;  ///< an index into BarChart::series
  double value = 0;        ///< at least 0
  std::string text;        ///< at its end
};

struct BarGroup {
  std::string name;
  std::vector<Bar> bars;
};

struct BarChart {
  std::string title, note;
  std::string axis;            ///< what the bars measure, with its unit
  std::optional<double> line;  ///< a value marked across all groups
  std::vector<std::string> series;
  std::vector<BarGroup> groups;
};

/// Reads a chart; benchmarks/peers/charts.py shows the document. Throws InputError with the field that is missing or
/// wrong.
BarChart bar_chart_from(const nlohmann::json& document);

/// Returns the file's bytes.
std::string draw(const BarChart& chart, profile::Drawing::Format format);

}  // namespace itin::bars
