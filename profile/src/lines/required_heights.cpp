#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <itin/error.hpp>
#include <profile/fresnel.hpp>
#include <profile/required_heights.hpp>

namespace itin::profile {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A linear function of t = distance / length, given by its values at 0 and 1.
struct Line {
  double start = 0, end = 0;
  double at(double t) const { return start * (1 - t) + end * t; }
  double slope() const { return end - start; }
};

/// The height that the ray must reach: the ground, the bulge of the Earth and a share of the Fresnel zone. Between two
/// points of the profile it is concave. So (demand - base) / weight, where base and weight are linear and weight > 0,
/// rises, then falls.
class Demand {
 public:
  Demand(const Profile& profile, const Requirement& requirement)
      : bulge_(requirement.earth.drop_coefficient() * profile.length_m * profile.length_m),
        radius_(requirement.fraction == 0
                    ? 0
                    : requirement.fraction * std::sqrt(requirement.wavelength * profile.length_m)) {
    nodes_.reserve(profile.points.size());
    for (const ProfilePoint& p : profile.points) {
      const double t = p.distance_m / profile.length_m;
      nodes_.push_back({t, p.ground_m, above_ground(t)});
    }
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      Node &from = nodes_[i], &to = nodes_[i + 1];
      if (to.t > from.t && profile.joined(i)) from.slope_on = (to.ground - from.ground) / (to.t - from.t);
    }
    constexpr std::size_t kNodes = 16;
    for (std::size_t first = 0; first < nodes_.size(); first += kNodes)
      stretches_.push_back(stretch(first, std::min(nodes_.size(), first + kNodes)));
  }

  /// The least factor such that base + factor * weight meets the demand everywhere; infinity where no factor does, and
  /// minus infinity where every one does.
  double peak(const Line& base, const Line& weight) const {
    double best = -kInfinity;
    for_each_stretch(base, weight, best, [&](const Stretch& s) {
      for (std::size_t i = s.first; i < s.end; ++i)
        if (!is_less(missing_at(i, base), weight.at(nodes_[i].t), best))
          best = std::max(best, ratio_at(i, base, weight));
    });
    // Most pieces certainly have less than the greatest ratio of all points.
    for_each_stretch(base, weight, best, [&](const Stretch& s) {
      for (std::size_t i = s.first; i < s.end; ++i)
        if (nodes_[i].slope_on && !is_less_inside(i, base, weight, best))
          best = std::max(best, ratio_inside(i, base, weight));
    });
    return best;
  }

 private:
  /// The demand above the ground.
  struct Above {
    double height, slope;
  };
  /// A point of the profile.
  struct Node {
    double t;
    double ground;
    Above above;
    std::optional<double> slope_on = {};  ///< the slope of the ground from here to the next point, where there is any
  };

  Above above_ground(double t) const {
    const Above bulge{bulge_ * t * (1 - t), bulge_ * (1 - 2 * t)};
    if (radius_ == 0) return bulge;
    const double root = std::sqrt(t * (1 - t));
    if (root == 0) return {bulge.height, t < 0.5 ? kInfinity : -kInfinity};
    return {bulge.height + radius_ * root, bulge.slope + radius_ * (1 - 2 * t) / (2 * root)};
  }

  /// Nodes one after another, and the pieces of ground that begin at these nodes.
  struct Stretch {
    std::size_t first, end;
    double from_t, to_t;
    double highest;  ///< no demand is higher
  };
  Stretch stretch(std::size_t first, std::size_t end) const {
    const std::size_t last = std::min(end, nodes_.size() - 1);
    Stretch s{first, end, nodes_[first].t, nodes_[last].t, -kInfinity};
    for (std::size_t i = first; i < end; ++i)
      s.highest = std::max(s.highest, nodes_[i].slope_on ? most_missing_inside(i, {}) : missing_at(i, {}));
    return s;
  }
  /// Leaves out stretches where every ratio is certainly less than the current `best`.
  template <class Visit>
  void for_each_stretch(const Line& base, const Line& weight, const double& best, const Visit& visit) const {
    for (const Stretch& s : stretches_) {
      const double most = s.highest - std::min(base.at(s.from_t), base.at(s.to_t));
      if (!is_less(most, divisor_of(most, weight, s.from_t, s.to_t), best)) visit(s);
    }
  }

  /// The weight between two places that makes the ratio greatest for a missing height of at most `most`.
  static double divisor_of(double most, const Line& weight, double from_t, double to_t) {
    const double first = weight.at(from_t), last = weight.at(to_t);
    return most > 0 ? std::min(first, last) : std::max(first, last);
  }

  double missing_at(std::size_t i, const Line& base) const {
    return nodes_[i].ground + nodes_[i].above.height - base.at(nodes_[i].t);
  }
  /// The most that may be missing along the piece that begins here, by its tangent at the point: a concave function is
  /// never above its tangent.
  double most_missing_inside(std::size_t i, const Line& base) const {
    const Node &from = nodes_[i], &to = nodes_[i + 1];
    return missing_at(i, base) + std::max(0.0, *from.slope_on + from.above.slope - base.slope()) * (to.t - from.t);
  }

  /// Whether missing / weight is certainly less than `best`, without a division.
  static bool is_less(double missing, double weight, double best) {
    constexpr double kRatioRounding = 1e-6;
    return missing < (best - kRatioRounding) * weight;
  }

  /// The ratio at a point. At an end where the weight is 0 no factor helps. If anything is missing there, the demand is
  /// impossible. Where ray and ground just meet, the ratio has a limit (L'Hopital), which the piece beside the end
  /// determines.
  double ratio_at(std::size_t i, const Line& base, const Line& weight) const {
    const double missing = missing_at(i, base), divisor = weight.at(nodes_[i].t);
    if (divisor > 0) return missing / divisor;
    if (missing != 0) return missing > 0 ? kInfinity : -kInfinity;
    return limit_at_end(i, base, weight);
  }
  double limit_at_end(std::size_t i, const Line& base, const Line& weight) const {
    const std::size_t first = nodes_[i].t < 0.5 ? i : i - 1;
    if (first >= nodes_.size() || !nodes_[first].slope_on) return -kInfinity;
    return (*nodes_[first].slope_on + nodes_[i].above.slope - base.slope()) / weight.slope();
  }

  /// Whether every ratio along the piece is certainly less than `best`.
  bool is_less_inside(std::size_t i, const Line& base, const Line& weight, double best) const {
    const double most = most_missing_inside(i, base);
    return is_less(most, divisor_of(most, weight, nodes_[i].t, nodes_[i + 1].t), best);
  }

  /// The greatest ratio inside the piece; minus infinity where none lies inside. The derivative's numerator falls along
  /// the piece, so a maximum lies inside only if it changes sign.
  double ratio_inside(std::size_t i, const Line& base, const Line& weight) const {
    const Node &from = nodes_[i], &to = nodes_[i + 1];
    const double slope_of_ground = *from.slope_on;
    const auto missing = [&](double t, const Above& above) {
      return from.ground + slope_of_ground * (t - from.t) + above.height - base.at(t);
    };
    const auto rising = [&](double t, const Above& above) {
      const double slope = slope_of_ground + above.slope - base.slope();
      if (std::isinf(slope)) return slope > 0;
      return slope * weight.at(t) > missing(t, above) * weight.slope();
    };
    if (!rising(from.t, from.above) || rising(to.t, to.above)) return -kInfinity;
    double low = from.t, high = to.t;
    while (true) {
      const double middle = low + (high - low) / 2;
      if (middle <= low || middle >= high) break;
      (rising(middle, above_ground(middle)) ? low : high) = middle;
    }
    return weight.at(low) > 0 ? missing(low, above_ground(low)) / weight.at(low) : -kInfinity;
  }

  double bulge_, radius_;
  std::vector<Node> nodes_;
  std::vector<Stretch> stretches_;
};

/// Demands on heights, counted from the grounds of the two ends.
class HeightDemand {
 public:
  HeightDemand(const Profile& profile, const Requirement& requirement, const EndGrounds& grounds)
      : demand_(profile, requirement), ground_{grounds.from_m, grounds.to_m} {}

  std::optional<double> from_alone(double to) const { return least({ground_.start, ground_.end + to}, {1, 0}); }
  std::optional<double> to_alone(double from) const { return least({ground_.start + from, ground_.end}, {0, 1}); }
  std::optional<double> both() const { return least(ground_, {1, 1}); }

 private:
  std::optional<double> least(const Line& base, const Line& weight) const {
    const double height = demand_.peak(base, weight);
    if (height == kInfinity) return std::nullopt;
    return std::max(height, 0.0);
  }

  Demand demand_;
  Line ground_;
};

/// The first end's height at which the curve ends: the second end needs next to no height there. It is at most about
/// three times the equal heights.
double curve_end(const HeightDemand& demand, const PlannedHeights& planned, double both) {
  const double alone = demand.from_alone(0).value_or(3 * both);
  return std::max({std::min(alone, 3 * both), 1.5 * both, planned.from_m, 1.0});
}

void require_grounded_ends(const Profile& profile) {
  if (!has_ground_at_ends(profile)) throw InputError("heights at the ends of a profile need ground at both ends");
}

}  // namespace

RequiredHeights required_heights(const Profile& profile, const PlannedHeights& planned, const Requirement& requirement,
                                 const std::optional<EndGrounds>& grounds) {
  require_grounded_ends(profile);
  if (!profile.has_length()) throw InputError("required heights need a profile with a length");
  const HeightDemand demand(profile, requirement, grounds.value_or(ends_of(profile)));
  return {demand.from_alone(planned.to_m), demand.to_alone(planned.from_m), demand.both()};
}

std::vector<HeightPair> height_curve(const Profile& profile, const PlannedHeights& planned,
                                     const Requirement& requirement, const std::optional<double>& both_equal_m,
                                     const std::optional<EndGrounds>& grounds) {
  std::vector<HeightPair> curve;
  if (!both_equal_m) return curve;
  require_grounded_ends(profile);
  const HeightDemand demand(profile, requirement, grounds.value_or(ends_of(profile)));
  const double end = curve_end(demand, planned, *both_equal_m);
  for (int i = 0; i < kCurvePoints; ++i) {
    const double from = end * i / (kCurvePoints - 1);
    curve.push_back({from, demand.to_alone(from)});
  }
  return curve;
}

VisibleHeight visible_height(const Profile& profile, double eye_m, const TallObject& object, const Earth& earth,
                             const std::optional<EndGrounds>& grounds) {
  require_grounded_ends(profile);
  VisibleHeight seen;
  if (profile.has_length()) {
    const auto least = HeightDemand(profile, Requirement{earth}, grounds.value_or(ends_of(profile))).to_alone(eye_m);
    seen.from_m = least ? *least : object.tip_m;
  }
  seen.from_m = std::min(seen.from_m, object.tip_m);
  const auto up_to = [&](double top_m) {
    const double visible_m = std::max(top_m - seen.from_m, 0.0);
    return VisiblePart{visible_m, top_m > 0 ? visible_m / top_m : 0};
  };
  seen.tip = up_to(object.tip_m);
  if (object.hub_m) seen.hub = up_to(*object.hub_m);
  return seen;
}

}  // namespace itin::profile
