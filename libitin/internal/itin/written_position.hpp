// Positions as people write them: degrees with minutes and seconds, references to Great Britain's National Grid and to
// squares of MGRS, and Maidenhead locators.
//
//   if (const auto place = written_position("ST 10375 83525")) use(place->position, place->crs);     // EPSG:27700
//   if (const auto place = written_position("51\xC2\xB0 32' 37.3\" N, 3\xC2\xB0 17' 36.2\" W")) ...  // EPSG:4326
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <itin/geometry.hpp>

namespace itin {

struct WrittenPosition {
  Point2 position;  ///< easting and northing, or longitude and latitude
  std::string crs;  ///< the CRS of the position: EPSG:27700, EPSG:4326 or a zone of UTM on WGS 84
};

/// Reads a latitude and a longitude, each with its letter N, S, E or W behind it, in either order; two letters and an
/// even number of digits of the National Grid, or a reference of MGRS, which mean the south-western corner of the
/// square; a locator of 6 characters or more, which means the middle of the square; or latitude and longitude as web
/// maps copy them, "54.523388, -3.145489", with a comma and a blank. Nothing for other texts, `x,y` among them.
std::optional<WrittenPosition> written_position(std::string_view text);

/// Reads `x,y`, with or without blanks: coordinates in a CRS that the text does not state. Nothing for other texts.
std::optional<Point2> written_coordinates(std::string_view text);

/// What a text is that written_position() cannot read, for messages.
inline constexpr const char* kNoWrittenPosition =
    "no grid reference, and no latitude and longitude with their letters or as 51.5437, -3.2934";

/// Reads degrees, with minutes and seconds (below 60) where they are given, negative for S and W: "51 32 37.3 N",
/// "-3.2934". A comma between two digits is decimal. Nothing where the text is no angle, or has a letter other than
/// `positive` and `negative`.
std::optional<double> written_angle(std::string_view text, char positive, char negative);

}  // namespace itin
