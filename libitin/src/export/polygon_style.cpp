#include "export/polygon_style.hpp"

#include <utility>

#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <itin/markup.hpp>

namespace itin {

std::string polygon_style(const std::vector<RegionClass>& classes) {
  std::string categories, symbols;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const RegionClass& c = classes[i];
    categories += fmt::format("      <category render=\"true\" symbol=\"{}\" value=\"{}\" label=\"{}\"/>\n", i, c.value,
                              escaped_markup(c.name));
    symbols += fmt::format(
        "      <symbol type=\"fill\" name=\"{0}\" alpha=\"0.7\" clip_to_extent=\"1\" force_rhr=\"0\">\n"
        "        <layer class=\"SimpleFill\" pass=\"0\" locked=\"0\" enabled=\"1\">\n"
        "          <prop k=\"color\" v=\"{1},{2},{3},255\"/>\n          <prop k=\"outline_style\" v=\"no\"/>\n"
        "          <prop k=\"style\" v=\"solid\"/>\n        </layer>\n      </symbol>\n",
        i, c.colour.red, c.colour.green, c.colour.blue);
  }
  return "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
         "<qgis version=\"3.22\" styleCategories=\"Symbology\">\n"
         "  <renderer-v2 type=\"categorizedSymbol\" attr=\"value\" symbollevels=\"0\" enableorderby=\"0\" "
         "forceraster=\"0\">\n    <categories>\n" +
         categories + "    </categories>\n    <symbols>\n" + symbols +
         "    </symbols>\n  </renderer-v2>\n  <layerGeometryType>2</layerGeometryType>\n</qgis>\n";
}

namespace {

/// Returns null where the table cannot be made.
OGRLayer* layer_styles_table(GDALDataset& geopackage) {
  OGRLayer* const table = geopackage.CreateLayer("layer_styles", nullptr, wkbNone, nullptr);
  if (table == nullptr) return nullptr;
  const std::pair<const char*, OGRFieldType> fields[] = {{"f_table_catalog", OFTString},
                                                         {"f_table_schema", OFTString},
                                                         {"f_table_name", OFTString},
                                                         {"f_geometry_column", OFTString},
                                                         {"styleName", OFTString},
                                                         {"styleQML", OFTString},
                                                         {"styleSLD", OFTString},
                                                         {"useAsDefault", OFTInteger},
                                                         {"description", OFTString},
                                                         {"owner", OFTString},
                                                         {"ui", OFTString},
                                                         {"update_time", OFTDateTime}};
  for (const auto& [name, type] : fields) {
    OGRFieldDefn field(name, type);
    if (std::string(name) == "useAsDefault") field.SetSubType(OFSTBoolean);
    if (table->CreateField(&field) != OGRERR_NONE) return nullptr;
  }
  return table;
}

}  // namespace

bool add_layer_styles(GDALDataset& geopackage, const std::vector<std::pair<std::string, std::string>>& styles) {
  OGRLayer* const table = layer_styles_table(geopackage);
  if (table == nullptr) return false;
  for (const auto& [layer, style] : styles) {
    OGRFeature row(table->GetLayerDefn());
    for (const char* empty : {"f_table_catalog", "f_table_schema", "styleSLD", "owner"}) row.SetField(empty, "");
    row.SetField("f_table_name", layer.c_str());
    row.SetField("f_geometry_column", "geom");
    row.SetField("styleName", layer.c_str());
    row.SetField("styleQML", style.c_str());
    row.SetField("useAsDefault", 1);
    row.SetField("description", "classes in their colours");
    row.SetField("update_time", 1970, 1, 1, 0, 0, 0.0F, 100);
    if (table->CreateFeature(&row) != OGRERR_NONE) return false;
  }
  return true;
}

}  // namespace itin
