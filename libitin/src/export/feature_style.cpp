
#include <fmt/format.h>

#include <itin/feature_style.hpp>
#include <itin/markup.hpp>

namespace itin {

namespace {

std::string option(const char* name, const std::string& value) {
  return fmt::format(R"(<Option type="QString" name="{}" value="{}"/>)", name, value);
}

std::string colour_text(const Rgba& c) {
  return fmt::format("{},{},{},255", c.red, c.green, c.blue);
}

/// A style with a symbol of this type for each class; layer_of(class) returns what draws it.
template <class LayerOf>
std::string classified_style(const char* type, const std::string& field, std::span<const FeatureClass> classes,
                             const LayerOf& layer_of) {
  std::string categories, symbols;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    categories += fmt::format("    <category symbol=\"{}\" value=\"{}\" label=\"{}\" render=\"true\"/>\n", i,
                              escaped_markup(classes[i].name), escaped_markup(classes[i].text));
    symbols += fmt::format("    <symbol type=\"{}\" name=\"{}\" alpha=\"1\" clip_to_extent=\"1\">{}</symbol>\n", type,
                           i, layer_of(classes[i]));
  }
  return fmt::format(
      "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
      "<qgis version=\"3.22\" styleCategories=\"Symbology\">\n"
      " <renderer-v2 type=\"categorizedSymbol\" attr=\"{}\" symbollevels=\"0\" forceraster=\"0\">\n"
      "  <categories>\n{}  </categories>\n  <symbols>\n{}  </symbols>\n </renderer-v2>\n</qgis>\n",
      escaped_markup(field), categories, symbols);
}

std::string symbol_layer(const char* type, const std::string& options) {
  return fmt::format(R"(<layer class="{}" enabled="1" locked="0" pass="0"><Option type="Map">{}</Option></layer>)",
                     type, options);
}

}  // namespace

std::string line_style(const std::string& field, std::span<const FeatureClass> classes, double width_mm) {
  return classified_style("line", field, classes, [&](const FeatureClass& c) {
    return symbol_layer("SimpleLine", option("line_color", colour_text(c.colour)) + option("line_style", "solid") +
                                          option("line_width", fmt::format("{:g}", width_mm)) +
                                          option("line_width_unit", "MM"));
  });
}

std::string point_style(const std::string& field, std::span<const FeatureClass> classes) {
  return classified_style("marker", field, classes, [](const FeatureClass& c) {
    return symbol_layer("SimpleMarker", option("name", "circle") + option("color", colour_text(c.colour)) +
                                            option("outline_color", "35,35,35,255") + option("size", "2") +
                                            option("size_unit", "MM"));
  });
}

std::string point_style(const FeatureClass& all) {
  return point_style(fmt::format("'{}'", all.name), {&all, 1});  // QGIS takes the field's name for an expression
}

}  // namespace itin
