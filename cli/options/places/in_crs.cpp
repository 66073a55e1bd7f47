#include "options/places/in_crs.hpp"

#include <memory>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>

namespace itin::cli {

void InCrs::declare(CLI::App& app) {
  app.add_option("--in-crs", crs,
                 "CRS of the points given here, for instance EPSG:4326 for lon,lat (default: the store's)")
      ->type_name("CRS");
}

std::function<Point2(Point2)> InCrs::transform_to(const std::string& wkt) const {
  if (crs.empty()) return [](Point2 p) { return p; };
  std::shared_ptr<const CoordinateTransform> transform;
  try {
    transform = std::make_shared<CoordinateTransform>(crs, wkt);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--in-crs '{}': {}", crs, error.what()));
  }
  return [transform](Point2 p) { return (*transform)(p); };
}

}  // namespace itin::cli
