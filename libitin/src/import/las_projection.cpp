#include "import/las_projection.hpp"

#include <cmath>

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <itin/error.hpp>

#include "import/crs.hpp"
#include "import/quiet_gdal.hpp"

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

std::optional<double> metres_per_unit(const LasFile& file, std::uint16_t key) {
  const auto unit = code(file, key);
  if (!unit) return std::nullopt;
  // EPSG units of measure.
  switch (*unit) {
    case 9001:
      return 1.0;
    case 9002:
      return 0.3048;
    case 9003:
      return 1200.0 / 3937.0;
    case 9005:
      return 0.3047972654;  // Clarke's foot
    case 9036:
      return 1000.0;
    case 9041:
      return 0.3047994715386762;  // British foot (Sears 1922)
    case 9070:
      return 0.3048007491;  // British foot (1936)
    case 9080:
      return 0.3047995102481469;  // Indian foot
    default:
      throw FileError(file.path(), fmt::format("GeoTIFF key {}: the linear unit EPSG:{} is not known; rewrite the file "
                                               "in metres or feet",
                                               key, *unit));
  }
}

std::optional<double> unit_of_vertical_crs(std::uint16_t epsg) {
  OGRSpatialReference crs;
  if (crs.importFromEPSG(epsg) != OGRERR_NONE || !crs.IsVertical()) return std::nullopt;
  return crs.GetTargetLinearUnits("VERT_CS");
}

std::string projected_crs(const LasFile& file, std::uint16_t epsg) {
  std::string name = fmt::format("EPSG:{}", epsg);
  const auto unit = metres_per_unit(file, kProjectedUnit);
  OGRSpatialReference crs;
  // A code that PROJ does not know is reported where the CRS is parsed.
  if (!unit || crs.importFromEPSG(epsg) != OGRERR_NONE) return name;
  if (std::abs(crs.GetLinearUnits() - *unit) <= 1e-9 * *unit) return name;
  crs.SetLinearUnitsAndUpdateParameters(fmt::format("{} m", *unit).c_str(), *unit);
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

}  // namespace

LasProjection las_projection(const LasFile& file) {
  const std::string& wkt = file.projection().wkt;
  const QuietGdal quiet;
  LasProjection result;
  if (wkt.empty() || !file.header().prefers_wkt) result.crs = crs_of_keys(file);
  if (result.crs.empty()) {
    result.crs = wkt;
    return result;
  }
  result.metres_per_height = metres_per_unit(file, kVerticalUnit);
  if (const auto vertical = code(file, kVerticalType); vertical && !result.metres_per_height)
    result.metres_per_height = unit_of_vertical_crs(*vertical);
  return result;
}

}  // namespace itin
