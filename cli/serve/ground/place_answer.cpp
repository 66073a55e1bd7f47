#include "serve/ground/place_answer.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include <itin/celestial_body.hpp>
#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/grid_reference.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>

#include "options/places/off_the_data.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

constexpr const char* kAt = "at";

const std::string& place_text(const HttpQuery& query) {
  const auto at = std::find_if(query.begin(), query.end(), [](const auto& pair) { return pair.first == kAt; });
  if (at == query.end()) throw InputError("at: give a place, x,y");
  for (const auto& [name, value] : query)
    if (name != kAt) throw InputError(fmt::format("{}: is not asked for here; give at alone", name));
  return at->second;
}

/// Longitude and latitude, or nothing where the store's CRS does not lead there.
std::optional<Point2> lon_lat(Point2 position, const StoreMetadata& metadata, const CelestialBody& body) {
  try {
    return CoordinateTransform(metadata.crs_wkt, body.geographic_crs)(position);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// A reference of the National Grid where the store is in it, else of UTM.
Document grid_reference(Point2 position, const std::optional<Point2>& geographic, const StoreMetadata& metadata,
                        const CelestialBody& body) {
  std::optional<std::string> reference;
  if (is_national_grid(metadata.crs_wkt))
    reference = national_grid_reference(position);
  else if (geographic && body.is_earth)
    reference = utm_reference(*geographic);
  return reference ? Document(*reference) : Document(nullptr);
}

}  // namespace

Document place_answer(const ServedStore& served, const HttpQuery& query, Progress& progress) {
  const StoreMetadata& metadata = served.metadata();
  const std::string& text = place_text(query);
  const Place place = parse_place(kAt, text);
  const Point2 position = on_the_data(fmt::format("{} '{}'", kAt, text), place, InCrs{}, metadata);
  const CelestialBody body = body_of(metadata.crs_wkt);
  const std::optional<Point2> geographic = lon_lat(position, metadata, body);
  SilentProgress quiet(progress);
  const auto ground = heights_at(served.store(), {position}, Detail::tolerance(0), ThemeChoice::none(), quiet).front();
  return {{"x", position.x},
          {"y", position.y},
          {"lon", geographic ? Document(geographic->x) : Document(nullptr)},
          {"lat", geographic ? Document(geographic->y) : Document(nullptr)},
          {"grid_reference", grid_reference(position, geographic, metadata, body)},
          {"ground_m", ground ? Document(*ground) : Document(nullptr)},
          {"height_m", place.height ? Document(*place.height) : Document(nullptr)}};
}

}  // namespace itin::cli
