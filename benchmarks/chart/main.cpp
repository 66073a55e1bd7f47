// Draws a bar chart:
//
//   itin_chart OUT.png < chart.json            benchmarks/peers/charts.py shows the document
#include <cstdio>
#include <exception>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>
#include <itin/output_file.hpp>

#include "chart/bar_chart.hpp"

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw itin::InputError("usage: itin_chart OUT.png < chart.json");
    const auto format = itin::profile::Drawing::format_of(argv[1]);
    if (!format) throw itin::InputError(fmt::format("{}: charts are .png, .svg or .pdf", argv[1]));
    const auto chart = itin::bars::bar_chart_from(nlohmann::json::parse(std::cin));
    itin::write_file(argv[1], itin::bars::draw(chart, *format), true);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "itin_chart: {}\n", error.what());
    return 1;
  }
}
