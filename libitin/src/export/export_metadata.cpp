#include "export/export_metadata.hpp"

#include <algorithm>
#include <memory>

#include <ogr_spatialref.h>

#include <itin/error.hpp>

#include "gdal/files/quiet_gdal.hpp"

namespace itin {

nlohmann::ordered_json parsed_metadata(const std::string& metadata_json) {
  if (metadata_json.empty()) return nlohmann::ordered_json::object();
  auto metadata = nlohmann::ordered_json::parse(metadata_json, nullptr, false);
  if (!metadata.is_object()) throw InputError("export: the metadata is not a JSON object", "metadata_json");
  return metadata;
}

std::string dumped(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string theme_name(const TinExportOptions& options, std::uint16_t theme) {
  return theme >= 1 && theme <= options.theme_names.size() ? options.theme_names[theme - std::size_t{1}]
                                                           : std::string();
}

std::string crs_urn(const std::string& crs_wkt) {
  if (crs_wkt.empty()) return {};
  const QuietGdal quiet;
  OGRSpatialReference crs;
  const bool understood = crs.SetFromUserInput(crs_wkt.c_str()) == OGRERR_NONE;
  const std::unique_ptr<OGRSpatialReference> match(understood ? crs.FindBestMatch(90, "EPSG") : nullptr);
  const char* code = match ? match->GetAuthorityCode(nullptr) : nullptr;
  if (!code)
    throw InputError(
        "GeoJSON names a CRS by its EPSG code, and the store's CRS has none; write .gpkg in place of .geojson");
  return std::string("urn:ogc:def:crs:EPSG::") + code;
}

}  // namespace itin
