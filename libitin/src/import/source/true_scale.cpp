#include "import/source/true_scale.hpp"

#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin {

namespace {

/// Returns the images of the places that have one.
std::vector<Point2> transformed(std::span<const Point2> places, const PointTransform& transform) {
  std::vector<double> x, y;
  for (const Point2& p : places) x.push_back(p.x), y.push_back(p.y);
  transform.transform(x, y);
  std::vector<Point2> images;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) images.push_back({x[i], y[i]});
  return images;
}

[[noreturn]] void refuse(const std::string& path, const Crs& crs) {
  throw InputError(
      fmt::format("{}: lies where {} is not defined; check the file's CRS (`crs`), or choose another for the store "
                  "with `to_crs`",
                  path, crs.name),
      "crs");
}

}  // namespace

std::vector<Point2> TrueScale::places_of(const OpenedFile& file) {
  const std::string wkt = file.crs().wkt;
  if (wkt != file_wkt_) from_file_.emplace(file_wkt_ = wkt, crs_.wkt, file.path());
  return transformed(places_in(file.extent()), *from_file_);
}

GridScale TrueScale::of(const OpenedFile& file) {
  const Crs own = file.crs();
  // A transformation would take numbers beyond the world to a place within it.
  const bool other = own.metric() && own.wkt != crs_.wkt;
  if (other && !ScaleMeter(own).at(places_in(file.extent()))) refuse(file.path(), own);
  const auto scale = meter_.at(places_of(file));
  if (!scale) refuse(file.path(), crs_);
  return *scale;
}

void TrueScale::require(const OpenedFile& file) {
  const GridScale scale = of(file);
  require(file.path(), places_of(file), scale);
}

void TrueScale::require(const std::string& path, const Box& area) const {
  const std::vector<Point2> places = places_in(area);
  if (const auto scale = meter_.at(places)) require(path, places, *scale);
}

void TrueScale::require(const std::string& path, std::span<const Point2> places, const GridScale& scale) const {
  if (scale.is_true()) return;
  const std::string remedy =
      store_exists_ ? "import it into a store of its own"
                    : fmt::format(
                          "give `to_crs` one made for that place, such as '{}', or import it into a store of "
                          "its own, in pieces where it is wide",
                          nearer_crs(places));
  throw InputError(fmt::format("{}: lengths in {}, the store's CRS, are {} there, where {} % are allowed; {}", path,
                               crs_.name, error_in_words(scale), 100 * scale.allowed, remedy));
}

/// Suggests the UTM zone where lengths are true in it, else a projection about the middle, which is true for hundreds
/// of kilometres around.
std::string TrueScale::nearer_crs(std::span<const Point2> places) const {
  const Point2 middle = places[places.size() / 2];
  try {
    const Crs zone = utm_zone(crs_, middle, crs_.name);
    const auto scale = ScaleMeter(zone).at(transformed(places, {crs_.wkt, zone.wkt, crs_.name}));
    if (scale && scale->is_true()) return zone.name;
  } catch (const InputError&) {
    // Near the poles there is no zone.
  }
  const Point2 centre = meter_.lon_lat(std::span(&middle, 1)).front();
  return fmt::format("+proj=laea +lat_0={:.0f} +lon_0={:.0f} +datum=WGS84 +units=m", centre.y, centre.x);
}

}  // namespace itin
