#include "options/places/off_the_data.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/celestial_body.hpp>
#include <itin/coordinates.hpp>
#include <itin/error.hpp>

namespace itin::cli {

namespace {

constexpr const char* kLonLat = "EPSG:4326";

/// The point in the store's CRS; nothing where it has no place in it. Throws InputError for an unknown CRS.
std::optional<Point2> transformed(Point2 p, const InCrs& in_crs, const StoreMetadata& metadata) {
  const auto transform = in_crs.transform_to(metadata.crs_wkt);
  try {
    return transform(p);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool within(Point2 p, const InCrs& in_crs, const StoreMetadata& metadata) {
  const std::optional<Point2> place = transformed(p, in_crs, metadata);
  return place && is_on_the_data(*place, metadata);
}

/// A place read from a file, as it stands in the file; in the store's CRS where that cannot be told.
Point2 as_given(Point2 place, const InCrs& in_crs, const StoreMetadata& metadata) {
  if (in_crs.crs.empty()) return place;
  try {
    return CoordinateTransform(metadata.crs_wkt, in_crs.crs)(place);
  } catch (const InputError&) {
    return place;
  }
}

bool may_be_degrees(Point2 p) {
  return std::abs(p.x) <= 180 && std::abs(p.y) <= 180;
}

std::string likely_mistake(Point2 given, const InCrs& in_crs, const StoreMetadata& metadata) {
  const Point2 swapped{given.y, given.x};
  if (within(swapped, in_crs, metadata))
    return fmt::format("its coordinates are swapped: give {:.10g},{:.10g}", swapped.x, swapped.y);
  if (in_crs.crs.empty() && may_be_degrees(given) && body_of(metadata.crs_wkt).is_earth) {
    const InCrs lon_lat{kLonLat};
    if (within(given, lon_lat, metadata)) return fmt::format("it is in degrees: give --in-crs {}, too", kLonLat);
    if (within(swapped, lon_lat, metadata))
      return fmt::format(
          "it is in degrees, latitude first: give {:.10g},{:.10g} and --in-crs {}, or '{:.10g}, {:.10g}'", swapped.x,
          swapped.y, kLonLat, given.x, given.y);
  }
  return "move it onto the data, or say by --in-crs what its coordinates are";
}

}  // namespace

std::optional<std::string> off_the_data(Point2 given, const InCrs& in_crs, const StoreMetadata& metadata) {
  if (within(given, in_crs, metadata)) return std::nullopt;
  const std::optional<Point2> place = transformed(given, in_crs, metadata);
  const std::string there = in_crs.crs.empty() ? ""
                            : place            ? fmt::format(" at {:.10g},{:.10g}", place->x, place->y)
                                               : " where the store's CRS does not reach";
  return fmt::format("lies off the data{}, which is {}; {}", there, extent_of(metadata),
                     likely_mistake(given, in_crs, metadata));
}

Point2 on_the_data(const std::string& what, const Place& place, const InCrs& in_crs, const StoreMetadata& metadata) {
  const InCrs own = in_crs.of(place);
  if (const auto off = off_the_data(place.position, own, metadata)) throw InputError(what + ": " + *off);
  return own.transform_to(metadata.crs_wkt)(place.position);
}

void require_on_the_data(const std::string& what, Point2 place, const InCrs& in_crs, const StoreMetadata& metadata) {
  if (is_on_the_data(place, metadata)) return;
  const Point2 given = as_given(place, in_crs, metadata);
  const std::string at = fmt::format("{}, at {:.10g},{:.10g}", what, given.x, given.y);
  throw InputError(fmt::format("{}: {}", at, off_the_data(given, in_crs, metadata).value_or("lies off the data")));
}

void require_any_on_the_data(const std::string& first, const std::vector<Point2>& places, const InCrs& in_crs,
                             const StoreMetadata& metadata) {
  const bool any = std::any_of(places.begin(), places.end(), [&](Point2 p) { return is_on_the_data(p, metadata); });
  if (!any && !places.empty()) require_on_the_data(first, places.front(), in_crs, metadata);
}

}  // namespace itin::cli
