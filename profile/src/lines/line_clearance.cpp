#include "lines/line_clearance.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include <itin/clearance.hpp>

#include "lines/ground_pieces.hpp"

namespace itin::profile {

namespace {

/// Rounding changes a clearance by less than this, in metres.
constexpr double kClearanceRounding = 1e-6;

class Walk {
 public:
  Walk(const Profile& profile, const Antennas& antennas, const Earth& earth)
      : profile_(profile),
        antennas_(antennas),
        drop_(earth.drop_coefficient()),
        mirrored_(runs_backwards(profile)),
        line_(mirrored_ ? antennas.to_m : antennas.from_m, mirrored_ ? antennas.from_m : antennas.to_m,
              profile.length_m, drop_) {}

  std::optional<LineClearance> run() {
    if (profile_.points.empty()) return std::nullopt;
    if (!profile_.has_length()) return over_ends();
    clearances_.reserve(profile_.points.size());
    for (const ProfilePoint& p : profile_.points) {
      clearances_.push_back(clearance_over(p));
      consider(p, clearances_.back());
    }
    for (std::size_t i = 0; i + 1 < profile_.points.size(); ++i)
      if (may_be_least(i) && profile_.joined(i)) consider_inside(i);
    return result_;
  }

 private:
  /// Whether the walk is from the last point to the first. SightLines look along a line from its lesser end in (x, y);
  /// so does this, to agree to the last bit.
  static bool runs_backwards(const Profile& profile) {
    if (profile.points.empty()) return false;
    const ProfilePoint &a = profile.points.front(), &b = profile.points.back();
    return std::tie(b.x, b.y) < std::tie(a.x, a.y);
  }

  /// Finds the clearance over ends at one place, which have no ground between them: only the ground at the ends counts.
  std::optional<LineClearance> over_ends() {
    for (const ProfilePoint* p : {&profile_.points.front(), &profile_.points.back()})
      if (p->distance_m == 0 || p->distance_m == profile_.length_m) consider(*p, clearance_over(*p));
    return found_ ? std::optional(result_) : std::nullopt;
  }

  GroundPoint seen(const ProfilePoint& p) const {
    return {mirrored_ ? profile_.length_m - p.distance_m : p.distance_m, p.ground_m};
  }

  double clearance_over(const ProfilePoint& p) const {
    if (profile_.length_m == 0) return std::min(antennas_.from_m, antennas_.to_m) - p.ground_m;
    return line_.clearance(seen(p));
  }

  void consider(const ProfilePoint& p, double clearance) {
    if (found_ && clearance >= result_.clearance_m) return;
    found_ = true;
    result_.clearance_m = clearance;
    result_.critical = p;
  }

  /// Whether a place between two points may have less clearance than all points. Over straight ground the clearance is
  /// less than at both points by no more than the Earth bulges between them.
  bool may_be_least(std::size_t i) const {
    const double width = profile_.points[i + 1].distance_m - profile_.points[i].distance_m;
    const double bulge = drop_ * width * width / 4;
    return std::min(clearances_[i], clearances_[i + 1]) - bulge - kClearanceRounding < result_.clearance_m;
  }

  void consider_inside(std::size_t i) {
    const GroundPoint a = seen(profile_.points[i]), b = seen(profile_.points[i + 1]);
    const auto lowest = mirrored_ ? line_.lowest_between(b, a) : line_.lowest_between(a, b);
    if (!lowest) return;
    ProfilePoint p = ground_between(profile_, i, mirrored_ ? profile_.length_m - lowest->distance : lowest->distance);
    p.ground_m = lowest->z;
    consider(p, line_.clearance(*lowest));
  }

  const Profile& profile_;
  const Antennas& antennas_;
  double drop_;
  bool mirrored_;
  LineOverGround line_;
  std::vector<double> clearances_;  ///< over the points
  bool found_ = false;
  LineClearance result_;
};

}  // namespace

std::optional<LineClearance> line_clearance(const Profile& profile, const Antennas& antennas, const Earth& earth) {
  return Walk(profile, antennas, earth).run();
}

}  // namespace itin::profile
