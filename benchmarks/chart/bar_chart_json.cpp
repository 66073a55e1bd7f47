#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>

#include "chart/bar_chart.hpp"

namespace itin::bars {

namespace {

using nlohmann::json;

Bar bar_from(const json& document, std::size_t series_count) {
  Bar bar{document.at("series").get<std::size_t>(), document.at("value").get<double>(),
          document.at("text").get<std::string>()};
  if (bar.series >= series_count) throw InputError(fmt::format("series: there is none with number {}", bar.series));
  if (!std::isfinite(bar.value) || bar.value < 0) throw InputError("value: give a number of at least 0");
  return bar;
}

}  // namespace

BarChart bar_chart_from(const json& document) {
  try {
    BarChart chart;
    chart.title = document.at("title");
    chart.note = document.at("note");
    chart.axis = document.at("axis");
    if (document.contains("line")) chart.line = document.at("line").get<double>();
    chart.series = document.at("series").get<std::vector<std::string>>();
    for (const json& group : document.at("groups")) {
      chart.groups.push_back({group.at("name").get<std::string>(), {}});
      for (const json& bar : group.at("bars")) chart.groups.back().bars.push_back(bar_from(bar, chart.series.size()));
    }
    return chart;
  } catch (const json::exception& error) {
    throw InputError(fmt::format("this is no chart: {}", error.what()));
  }
}

}  // namespace itin::bars
