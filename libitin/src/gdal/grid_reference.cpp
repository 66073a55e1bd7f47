#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/grid_reference.hpp>

namespace itin {

namespace {

/// Returns a letter of a five by five block, counted from the north-west, without I.
char letter(int index) {
  return static_cast<char>('A' + index + (index > 7 ? 1 : 0));
}

}  // namespace

bool is_national_grid(const std::string& crs_wkt) {
  return crs_identifier(crs_wkt) == "EPSG:27700";
}

std::optional<std::string> national_grid_reference(Point2 position, int figures) {
  constexpr double kSquare = 100000;
  if (!(position.x >= 0 && position.x < 7 * kSquare && position.y >= 0 && position.y < 13 * kSquare))
    return std::nullopt;
  const int east = static_cast<int>(position.x / kSquare), north = static_cast<int>(position.y / kSquare);
  const int down = 19 - north;
  const double step = std::pow(10, 5 - figures);
  const auto cut = [&](double v) { return static_cast<int>(std::fmod(v, kSquare) / step); };
  return fmt::format("{}{} {:0{}} {:0{}}", letter(down - down % 5 + (east + 10) / 5), letter(down * 5 % 25 + east % 5),
                     cut(position.x), figures, cut(position.y), figures);
}

std::optional<int> utm_zone_at(Point2 lon_lat) {
  if (!(lon_lat.y >= -80 && lon_lat.y <= 84 && std::abs(lon_lat.x) <= 360)) return std::nullopt;
  return std::min(60, static_cast<int>((std::remainder(lon_lat.x, 360) + 180) / 6) + 1);
}

std::optional<std::string> utm_reference(Point2 lon_lat) {
  const std::optional<int> zone = utm_zone_at(lon_lat);
  if (!zone) return std::nullopt;
  const bool north = lon_lat.y >= 0;
  const Point2 p = CoordinateTransform("EPSG:4326", fmt::format("EPSG:{}", (north ? 32600 : 32700) + *zone))(lon_lat);
  return fmt::format("UTM {}{} {:.0f} {:.0f}", *zone, north ? "N" : "S", p.x, p.y);
}

}  // namespace itin
