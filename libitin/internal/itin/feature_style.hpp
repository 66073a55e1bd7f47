// Styles by which QGIS draws lines and points in colours by the classes of a field.
//
//   layer.style = line_style("service", {{"served", "Served", {0, 114, 178}}});
#pragma once

#include <span>
#include <string>

#include <itin/raster.hpp>

namespace itin {

struct FeatureClass {
  const char* name;  ///< in tables and layers
  const char* text;  ///< in legends
  Rgba colour;
};

std::string line_style(const std::string& field, std::span<const FeatureClass> classes, double width_mm);
std::string point_style(const std::string& field, std::span<const FeatureClass> classes);
/// The style of a layer whose points are all of one class.
std::string point_style(const FeatureClass& all);

}  // namespace itin
