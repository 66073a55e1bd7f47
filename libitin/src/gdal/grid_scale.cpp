#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string_view>

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/grid_scale.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "gdal/scale_meter.hpp"

namespace itin {

namespace {

// Half the length of the lines whose scale is measured, metres: long enough that a geodesic's tenth of a millimetre
// does not matter, short enough that the scale hardly changes.
constexpr double kHalfLine = 250;
// The scale at a place is an ellipse, which three directions determine.
constexpr std::array<Point2, 3> kDirections{{{1, 0}, {0, 1}, {std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2}}};
constexpr std::size_t kEnds = 2 * kDirections.size();
// How far from itself a place may come back from its longitude and latitude, metres.
constexpr double kReturned = 1;
constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

std::vector<Point2> line_ends(std::span<const Point2> places) {
  std::vector<Point2> ends;
  for (const Point2& p : places) {
    for (const Point2& d : kDirections) {
      ends.push_back({p.x - kHalfLine * d.x, p.y - kHalfLine * d.y});
      ends.push_back({p.x + kHalfLine * d.x, p.y + kHalfLine * d.y});
    }
  }
  return ends;
}

/// Returns the least and the greatest scale at one place. Lengths on the ground come from a linear map of the grid, so
/// that their squares are a quadratic form: the inverse of Tissot's indicatrix.
std::optional<GridScale> scale_of(std::span<const Point2> ends, const Ellipsoid& ellipsoid) {
  std::array<double, kDirections.size()> squares{};
  for (std::size_t k = 0; k < squares.size(); ++k) {
    const Point2 &a = ends[2 * k], &b = ends[2 * k + 1];
    if (!std::isfinite(a.x + a.y + b.x + b.y)) return std::nullopt;
    const double ground = geodesic(a, b, ellipsoid).distance_m / (2 * kHalfLine);
    squares[k] = ground * ground;
  }
  const double mean = (squares[0] + squares[1]) / 2;
  const double spread = std::hypot((squares[0] - squares[1]) / 2, squares[2] - mean);
  if (!(mean - spread > 0)) return std::nullopt;
  return GridScale{1 / std::sqrt(mean + spread), 1 / std::sqrt(mean - spread)};
}

/// Tells whether the CRS shows the whole world on a cylinder about the equator.
bool lies_about_equator(const OGRSpatialReference& crs) {
  constexpr std::array<std::string_view, 6> kProjections{SRS_PT_MERCATOR_1SP,       SRS_PT_MERCATOR_2SP,
                                                         SRS_PT_EQUIRECTANGULAR,    SRS_PT_CYLINDRICAL_EQUAL_AREA,
                                                         SRS_PT_MILLER_CYLINDRICAL, SRS_PT_GALL_STEREOGRAPHIC};
  const char* const projection = crs.GetAttrValue("PROJECTION");
  return projection != nullptr && std::find(kProjections.begin(), kProjections.end(), projection) != kProjections.end();
}

}  // namespace

ScaleMeter::ScaleMeter(const Crs& crs) {
  if (!crs.metric()) throw InputError(fmt::format("{}: its axes are not in metres", crs.name));
  const QuietGdal quiet;
  const OGRSpatialReference projected = horizontal_crs(crs.wkt, crs.name);
  if (lies_about_equator(projected)) allowed_ = kGreatestScaleErrorOfWorld;
  const std::unique_ptr<OGRSpatialReference> geographic(projected.CloneGeogCS());
  if (!geographic) throw InputError(fmt::format("{}: has no ellipsoid", crs.name));
  degrees_ = in_degrees(geographic->GetAngularUnits());
  const double inverse_flattening = geographic->GetInvFlattening();
  ellipsoid_ = {geographic->GetSemiMajor(), inverse_flattening > 0 ? 1 / inverse_flattening : 0};
  to_geographic_.emplace(crs.wkt, wkt_of(*geographic), crs.name);
  from_geographic_.emplace(wkt_of(*geographic), crs.wkt, crs.name);
}

std::vector<Point2> ScaleMeter::lon_lat(std::span<const Point2> places) const {
  std::vector<double> x, y;
  for (const Point2& p : places) x.push_back(p.x), y.push_back(p.y);
  to_geographic_->transform(x, y);
  std::vector<Point2> result;
  for (std::size_t i = 0; i < x.size(); ++i) result.push_back({x[i] * degrees_, y[i] * degrees_});
  from_geographic_->transform(x, y);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(std::hypot(x[i] - places[i].x, y[i] - places[i].y) <= kReturned)) result[i] = {kNowhere, kNowhere};
  return result;
}

std::optional<GridScale> ScaleMeter::at(std::span<const Point2> places) const {
  const std::vector<Point2> ends = lon_lat(line_ends(places));
  std::optional<GridScale> extremes;
  for (std::size_t i = 0; i < ends.size(); i += kEnds) {
    const auto scale = scale_of(std::span(ends).subspan(i, kEnds), ellipsoid_);
    if (!scale) continue;
    if (!extremes) extremes = scale;
    extremes = {std::min(extremes->least, scale->least), std::max(extremes->greatest, scale->greatest), allowed_};
  }
  return extremes;
}

std::vector<Point2> places_in(const Box& area) {
  constexpr int kSteps = 4;
  std::vector<Point2> places;
  for (int column = 0; column <= kSteps; ++column)
    for (int row = 0; row <= kSteps; ++row)
      places.push_back({area.xmin + area.width() * column / kSteps, area.ymin + area.height() * row / kSteps});
  return places;
}

std::string error_in_words(const GridScale& scale) {
  const bool is_long = scale.greatest - 1 >= 1 - scale.least;
  const double percent = 100 * scale.error();
  return fmt::format("up to {:.{}f} % too {}", percent, percent < 10 ? 2 : 1, is_long ? "long" : "short");
}

std::optional<GridScale> grid_scale(const std::string& crs, const Box& area) {
  return ScaleMeter(parse_crs(crs, "CRS")).at(places_in(area));
}

std::optional<GridScale> grid_scale_if_known(const std::string& crs, const Box& area) {
  try {
    return grid_scale(crs, area);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace itin
