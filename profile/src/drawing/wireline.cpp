#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <profile/wireline.hpp>

namespace itin::profile {

namespace {

constexpr double kNearest = 2;    ///< metres: anything nearer is the ground at the viewer's feet
constexpr double kGrowth = 1.12;  ///< a band ends at most this many times as far away as it begins

/// Returns the limits between bands. The turbines' distances are among them, so that each turbine stands between two
/// bands.
std::vector<double> band_limits(const WirelineQuery& query) {
  std::vector<double> limits;
  for (double d = kNearest; d < query.reach_m; d *= kGrowth) limits.push_back(d);
  limits.push_back(query.reach_m);
  for (const WirelineTurbine& t : query.turbines) {
    const double d = std::hypot(t.position.x - query.eye.x, t.position.y - query.eye.y);
    if (d > kNearest && d < query.reach_m) limits.push_back(d);
  }
  std::sort(limits.begin(), limits.end());
  limits.erase(std::unique(limits.begin(), limits.end(), [](double a, double b) { return b - a < 1; }), limits.end());
  return limits;
}

/// The greatest tangent of the ground's elevation angle in each band along one line of sight.
class LineOfBands {
 public:
  LineOfBands(const std::vector<double>& limits, const Earth& earth, double eye)
      : limits_(limits),
        drop_(earth.drop_coefficient()),
        eye_(eye),
        greatest_(limits.size() - 1, -std::numeric_limits<double>::infinity()),
        at_(limits.size() - 1) {}

  /// A straight piece of the ground.
  void add(const Breakpoint& a, const Breakpoint& b) {
    if (b.distance <= limits_.front() || b.distance <= a.distance) return;
    const double slope = (b.position.z - a.position.z) / (b.distance - a.distance);
    auto band = static_cast<std::size_t>(std::max<std::ptrdiff_t>(
        0, std::upper_bound(limits_.begin(), limits_.end(), a.distance) - limits_.begin() - 1));
    for (; band + 1 < limits_.size() && limits_[band] < b.distance; ++band) {
      const double first = std::max(a.distance, limits_[band]), last = std::min(b.distance, limits_[band + 1]);
      const double base = a.position.z - slope * a.distance - eye_;
      const auto offer = [&](double d) {
        const double tangent = base / d + slope - drop_ * d;
        if (tangent > greatest_[band]) greatest_[band] = tangent, at_[band] = d;
      };
      offer(first), offer(last);
      if (base < 0 && drop_ > 0) offer(std::clamp(std::sqrt(-base / drop_), first, last));
    }
  }

  float angle_deg(std::size_t band) const {
    return std::isfinite(greatest_[band]) ? static_cast<float>(in_degrees(std::atan(greatest_[band])))
                                          : std::numeric_limits<float>::quiet_NaN();
  }
  /// Whether the ground falls behind its greatest angle in a band. If that angle is at the band's far limit, it falls
  /// where it does so in the next band; if it is at the near limit, the crest belongs to the band before.
  bool crest(std::size_t band) const {
    if (!std::isfinite(greatest_[band]) || at_[band] == limits_[band]) return false;
    if (at_[band] < limits_[band + 1]) return true;
    return band + 1 < at_.size() && std::isfinite(greatest_[band + 1]) && at_[band + 1] == limits_[band + 1];
  }

 private:
  const std::vector<double>& limits_;
  double drop_;
  double eye_;
  std::vector<double> greatest_, at_;
};

bool gap_between(const CrossSection& section, const Breakpoint& a, const Breakpoint& b) {
  return std::any_of(section.gaps.begin(), section.gaps.end(),
                     [&](const SectionGap& gap) { return gap.from >= a.distance && gap.to <= b.distance; });
}

void validate(const WirelineQuery& query) {
  if (!(query.width_deg > 0 && query.width_deg <= 360 && query.step_deg > 0 && query.step_deg <= query.width_deg))
    throw InputError(
        fmt::format("a wireline of {:g} degrees in steps of {:g}: give a width up to 360 and smaller steps",
                    query.width_deg, query.step_deg));
  if (!(query.reach_m > kNearest)) throw InputError(fmt::format("a wireline must reach farther than {:g} m", kNearest));
}

}  // namespace

double apparent_angle_deg(const Earth& earth, double distance_m, double above_eye_m) {
  return in_degrees(std::atan2(above_eye_m - earth.drop(distance_m), distance_m));
}

Wireline survey_wireline(const SectionSurface& surface, const WirelineQuery& query, Progress& progress) {
  validate(query);
  const std::vector<double> limits = band_limits(query);
  const auto lines = static_cast<std::size_t>(std::ceil(query.width_deg / query.step_deg)) + 1;
  std::vector<LineOfBands> seen(lines, LineOfBands(limits, query.earth, query.eye_elevation_m));
  CallProgress call(progress);
  std::atomic<std::size_t> done = 0;
  parallel_for(lines, [&](std::size_t i) {
    progress.throw_if_cancelled();
    const double azimuth = in_radians(query.from_deg + static_cast<double>(i) * query.step_deg);
    const Point2 to{query.eye.x + query.reach_m * std::sin(azimuth), query.eye.y + query.reach_m * std::cos(azimuth)};
    const CrossSection section = surface.between(query.eye, to);
    const auto& points = section.breakpoints;
    for (std::size_t p = 0; p + 1 < points.size(); ++p)
      if (!gap_between(section, points[p], points[p + 1])) seen[i].add(points[p], points[p + 1]);
    const std::size_t now = ++done;
    if (now % 32 == 0 || now == lines) call.report("wireline", static_cast<double>(now) / static_cast<double>(lines));
  });
  Wireline view;
  view.query = query;
  for (std::size_t b = 0; b + 1 < limits.size(); ++b) {
    WirelineBand& band = view.bands.emplace_back();
    band.from_m = limits[b], band.to_m = limits[b + 1];
    for (const LineOfBands& line : seen) {
      band.angle_deg.push_back(line.angle_deg(b));
      band.crest.push_back(line.crest(b));
    }
  }
  return view;
}

}  // namespace itin::profile
