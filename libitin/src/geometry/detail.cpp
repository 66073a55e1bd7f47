#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <itin/detail.hpp>
#include <itin/error.hpp>

namespace itin {

namespace {

void require_tolerance(const std::string& where, double metres) {
  if (!std::isfinite(metres) || metres < 0)
    throw InputError(fmt::format("{} must be a finite number of metres, 0 or more, not {}", where, metres),
                     "tolerance");
}

}  // namespace

Detail Detail::tolerance(double metres) {
  require_tolerance("tolerance", metres);
  return Detail({}, {{std::numeric_limits<double>::infinity(), metres}});
}

Detail Detail::rings(Point2 centre, std::vector<Ring> rings) {
  if (!std::isfinite(centre.x) || !std::isfinite(centre.y))
    throw InputError("rings: the centre is not a finite position", "rings");
  if (rings.empty()) throw InputError("rings: there is none; give radius:tolerance, nearest first", "rings");
  for (std::size_t i = 0; i < rings.size(); ++i) {
    require_tolerance(fmt::format("rings: the tolerance of ring {}", i + 1), rings[i].tolerance);
    if (std::isnan(rings[i].radius) || rings[i].radius <= 0)
      throw InputError(
          fmt::format("rings: the radius of ring {} must be greater than 0, not {}", i + 1, rings[i].radius), "rings");
    if (i == 0) continue;
    if (rings[i].radius <= rings[i - 1].radius)
      throw InputError(fmt::format("rings: the radius of ring {}, {}, must be greater than the one before, {}", i + 1,
                                   rings[i].radius, rings[i - 1].radius),
                       "rings");
    if (rings[i].tolerance < rings[i - 1].tolerance)
      throw InputError(fmt::format("rings: the tolerance of ring {}, {}, must not be less than the one before, {}",
                                   i + 1, rings[i].tolerance, rings[i - 1].tolerance),
                       "rings");
  }
  return Detail(centre, std::move(rings));
}

}  // namespace itin
