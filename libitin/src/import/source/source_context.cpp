#include "import/source/source_context.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/height_limit.hpp>

#include "gdal/vertical_axis.hpp"

namespace itin {

namespace {

// No ground lies beyond these; a height beyond is a marker for missing data, or in the wrong unit.
constexpr double kLowest = -12000, kHighest = 20000;

// Marks of missing heights: the least and greatest numbers of common types, and what netCDF and Surfer fill in.
constexpr double kMissingMarks[] = {-3.4028234663852886e38,
                                    3.4028234663852886e38,
                                    -1.7976931348623157e308,
                                    1.7976931348623157e308,
                                    -2147483648.0,
                                    2147483647.0,
                                    4294967295.0,
                                    1e20,
                                    9.969209968386869e36,
                                    1.70141e38,
                                    1.7014118346046923e38};
// The share by which a mark may be off: some were written as single precision, or with few digits.
constexpr double kMarkShare = 1e-6;

/// The CRS that the file itself states. Where --crs has a horizontal part, the file's need not be understood.
Crs own_crs(const std::string& path, const std::string& found, bool needed) {
  if (found.empty()) return {};
  try {
    return parse_any_crs(found, path);
  } catch (const InputError&) {
    if (needed) throw;
    return {};
  }
}

/// Removes the datum of heights; their unit stays.
void forget_datum(Crs& crs, const std::string& path) {
  if (!crs.heights) return;
  crs.heights->datum.clear();
  crs.whole = parse_crs(crs.wkt, path).whole;
}

}  // namespace

Crs source_crs(const std::string& path, const std::string& option_crs, const std::string& found,
               Elevations elevations) {
  const Crs given = option_crs.empty() ? Crs{} : parse_any_crs(option_crs, "`crs`");
  const Crs own = own_crs(path, found, given.wkt.empty());
  Crs crs = given.wkt.empty() ? own : given;
  if (crs.wkt.empty())
    throw InputError(fmt::format("{}: does not say its {}CRS; give it with `crs` EPSG:xxxx", path,
                                 given.heights || own.heights ? "horizontal " : ""),
                     "crs");
  crs.given = !given.wkt.empty();
  if (crs.given && !own.wkt.empty() && !PointTransform(own.wkt, given.wkt, path).identity()) crs.overridden = own.wkt;
  crs.heights_given = given.heights.has_value();
  crs.heights = crs.heights_given ? given.heights : own.heights;
  // The ellipsoid is that of the file's own CRS, of which nothing is left where another one is given.
  const bool in_own_crs = elevations == Elevations::in_coordinates && given.wkt.empty();
  const bool on_ellipsoid = crs.heights && crs.heights->datum == kEllipsoid && !crs.heights_given;
  if (elevations == Elevations::none || (on_ellipsoid && !in_own_crs)) forget_datum(crs, path);
  return crs;
}

bool is_missing_mark(double height) {
  return std::any_of(std::begin(kMissingMarks), std::end(kMissingMarks),
                     [&](double mark) { return std::abs(height - mark) <= kMarkShare * std::abs(mark); });
}

std::string warning_of_marks(const std::string& path, std::uint64_t count, double mark) {
  return fmt::format(
      "{}: {} heights of what customarily marks missing data, such as {:g}, were taken as missing, though "
      "the file does not declare it",
      path, count, mark);
}

Placement::Placement(std::string path, const Crs& crs, const HeightAxis& heights, const SourceContext& context,
                     Missing missing)
    : path_(std::move(path)),
      transform_(crs.wkt, context.crs_wkt, path_),
      height_factor_(heights.factor()),
      grid_(context.grid),
      missing_(missing) {
  if (context.scale != nullptr) true_cells_.emplace(*context.scale);
}

void Placement::require_heights(std::span<const double> x, std::span<const double> y, std::span<const double> z) const {
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double height = z[i] * height_factor_;
    if (is_height(height) || std::isnan(height) || is_missing_mark(z[i])) continue;
    require_height(height, fmt::format("{}: at {:.10g},{:.10g}", path_, x[i], y[i]));
  }
}

void Placement::place(std::span<double> x, std::span<double> y, std::span<const double> z,
                      std::vector<GridPoint>& points) {
  points.clear();
  require_heights(x, y, z);
  transform_.transform(x, y);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double height = z[i] * height_factor_;
    if (std::isnan(height)) {
      ++voids_;
    } else if (!is_height(height) || (missing_ == Missing::kNotDeclared && is_usual_nodata(z[i]))) {
      ++marks_;
      mark_ = z[i];
    } else if (!(height >= kLowest && height <= kHighest)) {
      ++out_of_range_;
    } else if (std::isnan(x[i]) || std::isnan(y[i])) {
      ++unmapped_;
    } else if (!grid_.covers({x[i], y[i]})) {
      beyond_.add({x[i], y[i]});
    } else if (true_cells_ && !true_cells_->hold({x[i], y[i]})) {
      astray_.add({x[i], y[i]});
    } else {
      points.push_back(grid_.quantise({x[i], y[i], height}));
      bounds_.extend(points.back().x, points.back().y);
    }
  }
  placed_ += points.size();
}

std::string Placement::beyond_the_grid() const {
  return fmt::format(
      "{:.12g}, {:.12g} lies beyond the {:.0f} km about {:.12g}, {:.12g} that the store's grid holds at {} m",
      beyond_.first.x, beyond_.first.y, kGridHalfSide * grid_.resolution / 1000, grid_.origin.x, grid_.origin.y,
      grid_.resolution);
}

GridBox Placement::bounds() const {
  GridBox bounds = bounds_;
  if (9 * astray_.count <= placed_) return bounds;
  for (const Point2& p : {Point2{astray_.box.xmin, astray_.box.ymin}, Point2{astray_.box.xmax, astray_.box.ymax}}) {
    const GridPoint corner = grid_.quantise({p.x, p.y, 0});
    bounds.extend(corner.x, corner.y);
  }
  return bounds;
}

ReadCounts Placement::counts() const {
  if (placed_ == 0 && beyond_.count > 0)
    throw InputError(fmt::format("{}: position {}; import it into a store of its own, or give a coarser `resolution`",
                                 path_, beyond_the_grid()),
                     "resolution");
  ReadCounts counts{placed_, voids_ + marks_ + out_of_range_ + unmapped_, 0, bounds(), {}};
  const auto left_out = [&](const Far& points, const std::string& where) {
    if (points.count > 0)
      counts.warnings.push_back(fmt::format(
          "{}: {} left out: position {}; check for swapped axes, and for 0, 0 in place of a position that is not known",
          path_, counted(points.count, "point"), where));
  };
  left_out(beyond_, beyond_the_grid());
  left_out(astray_, fmt::format("{:.12g}, {:.12g} lies where lengths in the store's CRS are not true", astray_.first.x,
                                astray_.first.y));
  if (marks_ > 0) counts.warnings.push_back(warning_of_marks(path_, marks_, mark_));
  if (out_of_range_ > 0)
    counts.warnings.push_back(
        fmt::format("{}: {} heights below {} m or above {} m were taken as missing; check their "
                    "unit and the file's nodata value",
                    path_, out_of_range_, kLowest, kHighest));
  if (unmapped_ > 0)
    counts.warnings.push_back(
        fmt::format("{}: {} points have no position in the store's CRS, and were taken as missing", path_, unmapped_));
  return counts;
}

std::string utc_now() {
  std::time_t seconds = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  if (const char* const given = std::getenv("SOURCE_DATE_EPOCH")) {
    constexpr std::time_t kLast = 253402300799;  // the last second of the year 9999
    const std::string_view text = given;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
    if (error != std::errc() || end != text.data() + text.size() || seconds < 0 || seconds > kLast)
      throw InputError(
          fmt::format("SOURCE_DATE_EPOCH '{}': give a whole number of seconds since 1970, or unset it", text));
  }
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(seconds));
}

}  // namespace itin
