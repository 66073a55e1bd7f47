// The metadata that an export carries besides its triangles.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include <itin/tin_export.hpp>

namespace itin {

/// Returns TinExportOptions::metadata_json as an object, empty for nothing; members keep their order. Throws
/// InputError.
nlohmann::ordered_json parsed_metadata(const std::string& metadata_json);

/// Returns compact text; bytes that are not UTF-8 are replaced and are never an error.
std::string dumped(const nlohmann::ordered_json& json);

/// Returns the text on one line, for comments: line ends become spaces.
std::string on_one_line(std::string text);

/// Returns the name of a theme by its number, from 1; empty where the options do not say.
std::string theme_name(const TinExportOptions& options, std::uint16_t theme);

/// Returns the CRS for GeoJSON, "urn:ogc:def:crs:EPSG::27700"; empty for an unknown CRS. Throws InputError for one
/// without EPSG code.
std::string crs_urn(const std::string& crs_wkt);

}  // namespace itin
