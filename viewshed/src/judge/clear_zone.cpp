#include "judge/clear_zone.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <itin/grazing.hpp>

#include "line/infinity.hpp"
#include "line/set_bits.hpp"

namespace itin::viewshed {

namespace {

/// Tests whether one triangle reaches into the zone of one line.
class ZoneTest {
 public:
  ZoneTest(const SightLine& line, double zone, double fraction, double sure)
      : line_(line), zone_(zone), fraction_(fraction), sure_(sure) {}

  const SightLine& line() const { return line_; }

  bool cut_by(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
    if (line_.beside(a, b, c)) return false;
    const auto ground = line_.ground_over(a, b, c);
    if (!ground || lowest_spare(*ground) > sure_) return false;
    if (std::min(spare(*ground, ground->from), spare(*ground, ground->to)) < -sure_) return true;
    return least_fraction(*ground) < fraction_;
  }

  double depth() const { return fraction_ * zone_; }

 private:
  using Ground = SightLine::Ground;

  static double slope(const Ground& g) { return g.to > g.from ? (g.to_rise - g.from_rise) / (g.to - g.from) : 0; }
  /// The clearance beyond what is asked for.
  double spare(const Ground& g, double s) const {
    return -(g.from_rise + slope(g) * (s - g.from)) - line_.bulge().at(s) - depth() * std::sqrt(s * (1 - s));
  }
  /// A lower bound of the spare clearance, which is convex, and so above its tangent in the middle.
  double lowest_spare(const Ground& g) const {
    const double s = (g.from + g.to) / 2, radius = std::sqrt(s * (1 - s));
    const double middle = -(g.from_rise + g.to_rise) / 2 - line_.bulge().at(s) - depth() * radius;
    if (radius == 0) return middle;
    const double half_rise = (g.to_rise - g.from_rise) / 2, half = (g.to - g.from) / 2;
    return middle - std::abs(half_rise + half * (line_.bulge().drop * (1 - 2 * s) + depth() * (0.5 - s) / radius));
  }
  double least_fraction(const Ground& g) const {
    const LineOverGround flat(0, 0, 1, line_.bulge().drop);
    LeastFraction least(zone_, sure_);
    least.consider(g.from, flat.clearance({g.from, g.from_rise}));
    least.consider(g.to, flat.clearance({g.to, g.to_rise}));
    if (g.from < g.to) least.consider_inside(flat.piece({g.from, g.from_rise}, {g.to, g.to_rise}));
    return least.least() ? least.least()->fraction : fraction_;
  }

  SightLine line_;
  double zone_;  ///< the first zone's greatest radius, twice
  double fraction_;
  double sure_;  ///< beyond rounding
};

/// The lines of some tests, lowered by no more than depth sqrt(s (1 - s)).
struct LoweredLines : LineBundle {
  explicit LoweredLines(double grazing) {
    margin = grazing;
    end = kInfinity;
  }
  void add(const ZoneTest& test) {
    LineBundle::add(test.line());
    end = std::min(end, test.line().to_z());
    depth = std::max(depth, test.depth());
  }
  /// A height below every line, and never more than the lowest height: found by the tangent in the middle.
  double lowest_over(double first, double last) const {
    const double a = std::max(first, 0.0), b = std::min(last, 1.0), s = (a + b) / 2;
    const double radius = std::sqrt(s * (1 - s));
    if (radius == 0) return std::min(from_z, end);
    const double dz = end - from_z;
    const double height = from_z + s * (dz - bulge * (1 - s)) - depth * radius;
    const double slope = dz - bulge * (1 - 2 * s) - depth * (0.5 - s) / radius;
    return height - std::abs(slope) * (b - a) / 2;
  }

  double depth = 0;
};

}  // namespace

ClearZone::ClearZone(Pyramid lower, Pyramid upper, const Earth& earth, const FresnelCriterion& criterion)
    : drop_(earth.drop_coefficient() * lower->units().resolution),
      criterion_(criterion),
      lower_(std::move(lower)),
      upper_(std::move(upper)) {}

unsigned ClearZone::cut(const HeightPyramid& surface, const SightLines& lines) const {
  const Tin& tin = surface.tin();
  const double grazing = kGrazing / tin.grid.resolution;
  std::vector<ZoneTest> tests;
  tests.reserve(SightLines::kSize);
  LoweredLines bundle(grazing);
  for_each_bit(lines.active, [&](unsigned i) {
    // The line starts at the target: what cuts the zone is most often near it.
    const SightLine line({lines.to_x[i], lines.to_y[i], lines.to_z[i]},
                         {lines.from_x[i], lines.from_y[i], lines.from_z[i]}, drop_, grazing);
    tests.emplace_back(line, zone_of(line), criterion_.fraction, grazing);
    bundle.add(tests.back());
  });
  unsigned result = 0;
  RecentTriangles recent;
  surface.search(bundle, [&](std::uint32_t t) {
    if (recent.seen(t)) return;
    const Triangle& triangle = tin.triangles[t];
    const GridPoint &a = tin.vertices[triangle[0]], &b = tin.vertices[triangle[1]], &c = tin.vertices[triangle[2]];
    std::size_t n = 0;
    for_each_bit(lines.active, [&](unsigned i) {
      const ZoneTest& test = tests[n++];
      if ((result >> i & 1) == 0 && test.cut_by(a, b, c)) result |= 1U << i;
    });
    if (result == lines.active) bundle.reach = -1;
  });
  return result;
}

/// Twice the greatest radius of the line's first zone, grid units.
double ClearZone::zone_of(const SightLine& line) const {
  return std::sqrt(criterion_.wavelength / lower_->units().resolution * std::hypot(line.dx(), line.dy()));
}

std::optional<ClearZone::FirstCut> ClearZone::first_cut(const Point3& from, const Point3& to) const {
  const Tin& tin = lower_->tin();
  const double grazing = kGrazing / tin.grid.resolution;
  const SightLine line(from, to, drop_, grazing);
  const ZoneTest test(line, zone_of(line), criterion_.fraction, grazing);
  LoweredLines bundle(grazing);
  bundle.add(test);
  std::optional<FirstCut> first;
  lower_->search(bundle, [&](std::uint32_t t) {
    const Triangle& triangle = tin.triangles[t];
    const GridPoint &a = tin.vertices[triangle[0]], &b = tin.vertices[triangle[1]], &c = tin.vertices[triangle[2]];
    if (!test.cut_by(a, b, c)) return;
    const double at = line.ground_over(a, b, c)->from;
    if (first && (at > first->at || (at == first->at && t >= first->triangle))) return;
    first = {t, at};
  });
  return first;
}

unsigned ClearZone::certainly_cut(const SightLines& to_highest_targets) const {
  return cut(*lower_, to_highest_targets);
}

unsigned ClearZone::certainly_clear(const SightLines& to_lowest_targets) const {
  return to_lowest_targets.active & ~cut(upper_ ? *upper_ : *lower_, to_lowest_targets);
}

}  // namespace itin::viewshed
