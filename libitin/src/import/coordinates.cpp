#include <cmath>

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>

#include "import/quiet_gdal.hpp"

namespace itin {

namespace {

OGRSpatialReference understood(const std::string& crs) {
  const QuietGdal quiet;
  OGRSpatialReference reference;
  if (crs.empty() || reference.SetFromUserInput(crs.c_str()) != OGRERR_NONE) {
    throw InputError(fmt::format("unknown coordinate reference system '{}'; give a code such as EPSG:4326", crs));
  }
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

}  // namespace

class CoordinateTransform::Impl {
 public:
  Impl(const std::string& from_crs, const std::string& to_crs) : from_(understood(from_crs)), to_(understood(to_crs)) {
    const QuietGdal quiet;
    transformation_.reset(OGRCreateCoordinateTransformation(&from_, &to_));
    if (!transformation_) {
      throw InputError(fmt::format("no transformation from {} to {}", from_.GetName(), to_.GetName()));
    }
  }

  Point2 transform(Point2 p) const {
    const QuietGdal quiet;
    Point2 q = p;
    if (!transformation_->Transform(1, &q.x, &q.y) || !std::isfinite(q.x) || !std::isfinite(q.y)) {
      throw InputError(fmt::format("{},{} in {} cannot be transformed to {}; check the order of the coordinates", p.x,
                                   p.y, from_.GetName(), to_.GetName()));
    }
    return q;
  }

 private:
  struct Destroy {
    void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
  };
  OGRSpatialReference from_, to_;
  std::unique_ptr<OGRCoordinateTransformation, Destroy> transformation_;
};

CoordinateTransform::CoordinateTransform(const std::string& from_crs, const std::string& to_crs)
    : impl_(std::make_unique<Impl>(from_crs, to_crs)) {}
CoordinateTransform::CoordinateTransform(CoordinateTransform&&) noexcept = default;
CoordinateTransform& CoordinateTransform::operator=(CoordinateTransform&&) noexcept = default;
CoordinateTransform::~CoordinateTransform() = default;

Point2 CoordinateTransform::operator()(Point2 p) const {
  return impl_->transform(p);
}

std::string crs_identifier(const std::string& wkt) {
  const QuietGdal quiet;
  const OGRSpatialReference reference(wkt.c_str());
  const char* authority = reference.GetAuthorityName(nullptr);
  const char* code = reference.GetAuthorityCode(nullptr);
  return authority != nullptr && code != nullptr ? fmt::format("{}:{}", authority, code) : wkt;
}

std::string crs_title(const std::string& wkt) {
  const QuietGdal quiet;
  const OGRSpatialReference reference(wkt.c_str());
  const char* name = reference.GetName();
  return name != nullptr ? name : "unnamed";
}

}  // namespace itin
