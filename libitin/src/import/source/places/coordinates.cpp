#include <cmath>
#include <span>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>

#include "gdal/crs.hpp"

namespace itin {

namespace {

constexpr const char* kPlace = "coordinates";

}  // namespace

class CoordinateTransform::Impl {
 public:
  Impl(const Crs& from, const Crs& to) : from_(from.name), to_(to.name), transform_(from.wkt, to.wkt, kPlace) {}

  Point2 transform(Point2 p) const {
    Point2 q = p;
    transform_.transform(std::span(&q.x, 1), std::span(&q.y, 1));
    if (!std::isfinite(q.x) || !std::isfinite(q.y)) {
      throw InputError(fmt::format("{},{} in {} cannot be transformed to {}; check the order of the coordinates", p.x,
                                   p.y, from_, to_));
    }
    return q;
  }

 private:
  std::string from_, to_;
  PointTransform transform_;
};

CoordinateTransform::CoordinateTransform(const std::string& from_crs, const std::string& to_crs)
    : impl_(std::make_unique<Impl>(parse_crs(from_crs, kPlace), parse_crs(to_crs, kPlace))) {}
CoordinateTransform::CoordinateTransform(CoordinateTransform&&) noexcept = default;
CoordinateTransform& CoordinateTransform::operator=(CoordinateTransform&&) noexcept = default;
CoordinateTransform::~CoordinateTransform() = default;

Point2 CoordinateTransform::operator()(Point2 p) const {
  return impl_->transform(p);
}

}  // namespace itin
