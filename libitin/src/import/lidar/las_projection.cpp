#include "import/lidar/las_projection.hpp"

#include <cmath>

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <itin/error.hpp>

#include "gdal/crs.hpp"
#include "gdal/files/quiet_gdal.hpp"

namespace itin {

namespace {

constexpr std::uint16_t kModelType = 1024, kGeographicType = 2048, kProjectedType = 3072, kProjectedUnit = 3076,
                        kVerticalType = 4096, kVerticalUnit = 4099;
constexpr std::uint16_t kModelGeographic = 2;
constexpr std::uint16_t kUserDefined = 32767;

/// The key's code, unless it is absent, undefined (0) or user-defined.
std::optional<std::uint16_t> code(const LasFile& file, std::uint16_t key) {
  const auto& keys = file.projection().geo_keys;
  const auto found = keys.find(key);
  if (found == keys.end() || found->second == 0 || found->second == kUserDefined) return std::nullopt;
  return found->second;
}

std::optional<LinearUnit> unit_of(const LasFile& file, std::uint16_t key) {
  const auto stated = code(file, key);
  if (!stated) return std::nullopt;
  if (auto unit = linear_unit(*stated)) return unit;
  throw FileError(file.path(),
                  fmt::format("GeoTIFF key {}: EPSG:{} is no unit of length that is known; rewrite the file in metres",
                              key, *stated));
}

std::string projected_crs(const LasFile& file, std::uint16_t epsg) {
  std::string name = fmt::format("EPSG:{}", epsg);
  const auto unit = unit_of(file, kProjectedUnit);
  OGRSpatialReference crs;
  // A code that PROJ does not know is reported where the CRS is parsed.
  if (!unit || crs.importFromEPSG(epsg) != OGRERR_NONE) return name;
  if (std::abs(crs.GetLinearUnits() - unit->metres) <= 1e-9 * unit->metres) return name;
  crs.SetLinearUnitsAndUpdateParameters(unit->name.c_str(), unit->metres);
  return wkt_of(crs);
}

std::string crs_of_keys(const LasFile& file) {
  const auto model = code(file, kModelType);
  const auto projected = code(file, kProjectedType), geographic = code(file, kGeographicType);
  // Projected files name their geographic CRS too.
  if (projected && model != kModelGeographic) return projected_crs(file, *projected);
  const bool undefined_projection = file.projection().geo_keys.contains(kProjectedType) && model != kModelGeographic;
  if (geographic && !undefined_projection) return fmt::format("EPSG:{}", *geographic);
  return {};
}

/// The CRS with the vertical one that the keys name, if PROJ knows the vertical one.
std::string with_heights(const LasFile& file, const std::string& horizontal) {
  const auto epsg = code(file, kVerticalType);
  OGRSpatialReference plan, vertical, compound;
  if (!epsg || vertical.importFromEPSG(*epsg) != OGRERR_NONE || !vertical.IsVertical()) return horizontal;
  if (horizontal.empty()) return fmt::format("EPSG:{}", *epsg);
  // A horizontal CRS that PROJ does not know is reported where the CRS is parsed.
  if (plan.SetFromUserInput(horizontal.c_str()) != OGRERR_NONE) return horizontal;
  compound.SetCompoundCS(fmt::format("{} + {}", plan.GetName(), vertical.GetName()).c_str(), &plan, &vertical);
  return wkt_of(compound);
}

}  // namespace

LasProjection las_projection(const LasFile& file) {
  const std::string& wkt = file.projection().wkt;
  const QuietGdal quiet;
  const bool keys_count = wkt.empty() || !file.header().prefers_wkt;
  const std::string horizontal = keys_count ? crs_of_keys(file) : "";
  if (horizontal.empty() && !wkt.empty()) return {wkt, std::nullopt};
  return {with_heights(file, horizontal), unit_of(file, kVerticalUnit)};
}

}  // namespace itin
