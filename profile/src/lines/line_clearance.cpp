#include "lines/line_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <itin/clearance.hpp>
#include <itin/grazing.hpp>

#include "lines/ground_pieces.hpp"

namespace itin::profile {

namespace {

/// The part of a piece where the clearance is negative, if any: [first, second] within [from, to].
std::optional<std::pair<double, double>> cut_part(const ClearancePiece& p) {
  const bool at_from = p.at(p.from) < 0, at_to = p.at(p.to) < 0;
  if (at_from && at_to) return std::pair{p.from, p.to};  // convex: negative all between
  const double turn = p.least_within(p.from, p.to);
  if (p.at(turn) >= 0) return std::nullopt;
  const auto border = [&](double outside, double inside) {
    for (double middle = (outside + inside) / 2; middle != outside && middle != inside;
         middle = (outside + inside) / 2) {
      (p.at(middle) < 0 ? inside : outside) = middle;
    }
    return inside;
  };
  return std::pair{at_from ? p.from : border(p.from, turn), at_to ? p.to : border(p.to, turn)};
}

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
    for (const ProfilePoint& p : profile_.points) consider(p, clearance_over(p));
    for_each_piece(profile_, antennas_, drop_, [&](const ClearancePiece& piece, std::size_t i) { take(piece, i); });
    settle();
    return result_;
  }

 private:
  /// SightLines look along a line from its lesser end in (x, y); so does this, to agree to the last bit.
  static bool runs_backwards(const Profile& profile) {
    if (profile.points.empty()) return false;
    const ProfilePoint &a = profile.points.front(), &b = profile.points.back();
    return std::tie(b.x, b.y) < std::tie(a.x, a.y);
  }

  /// Ends at one place have no ground between them: only that at the ends counts.
  std::optional<LineClearance> over_ends() {
    for (const ProfilePoint* p : {&profile_.points.front(), &profile_.points.back()})
      if (p->distance_m == 0 || p->distance_m == profile_.length_m) consider(*p, clearance_over(*p));
    return found_ ? std::optional(result_) : std::nullopt;
  }

  GroundPoint seen(const ProfilePoint& p) const {
    return {mirrored_ ? profile_.length_m - p.distance_m : p.distance_m, p.ground_m};
  }

  /// The verdict is the clearance's; obstructions thinner than its rounding error follow it.
  void settle() {
    std::erase_if(result_.obstructions, [](const Obstruction& o) { return o.depth_m <= kGrazing; });
    if (result_.clearance_m >= -kGrazing || !result_.obstructions.empty()) return;
    const ProfilePoint& p = result_.critical;
    result_.obstructions.push_back(
        {p.distance_m, p.distance_m, p.distance_m, p.ground_m, -result_.clearance_m, p.theme, p.feature});
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

  /// Where the ground is between two points.
  ProfilePoint between(std::size_t i, double distance) const {
    const ProfilePoint &a = profile_.points[i], &b = profile_.points[i + 1];
    if (distance == a.distance_m) return a;
    if (distance == b.distance_m) return b;
    const double s = (distance - a.distance_m) / (b.distance_m - a.distance_m);
    ProfilePoint p = a.ground_m >= b.ground_m ? a : b;
    p.theme = profile_.theme_between(i);
    p.distance_m = distance;
    p.x = a.x + (b.x - a.x) * s, p.y = a.y + (b.y - a.y) * s;
    p.ground_m = a.ground_m + (b.ground_m - a.ground_m) * s;
    return p;
  }

  void take(const ClearancePiece& piece, std::size_t i) {
    const GroundPoint a = seen(profile_.points[i]), b = seen(profile_.points[i + 1]);
    if (const auto lowest = mirrored_ ? line_.lowest_between(b, a) : line_.lowest_between(a, b)) {
      ProfilePoint p = between(i, mirrored_ ? profile_.length_m - lowest->distance : lowest->distance);
      p.ground_m = lowest->z;
      consider(p, line_.clearance(*lowest));
    }
    if (const auto cut = cut_part(piece)) add(piece, i, cut->first, cut->second);
  }

  void add(const ClearancePiece& piece, std::size_t i, double from, double to) {
    const double turn = piece.least_within(from, to), scale = profile_.length_m, depth = -piece.at(turn);
    const bool goes_on = !result_.obstructions.empty() && from == piece.from && last_ == i && last_open_;
    if (!goes_on) result_.obstructions.push_back({from * scale, to * scale, 0, 0, 0, 0, -1});
    Obstruction& o = result_.obstructions.back();
    o.to_m = to * scale;
    if (depth > o.depth_m) {
      const ProfilePoint p = between(i, turn * scale);
      o.peak_at_m = p.distance_m, o.peak_m = p.ground_m, o.depth_m = depth;
      o.theme = p.theme, o.feature = p.feature;
    }
    last_open_ = to == piece.to;
    last_ = i + 1;
    // A vertical face begins where this piece ends: the next piece is one farther on.
    while (last_ + 1 < profile_.points.size() &&
           profile_.points[last_ + 1].distance_m == profile_.points[last_].distance_m) {
      ++last_;
    }
  }

  const Profile& profile_;
  const Antennas& antennas_;
  double drop_;
  bool mirrored_;
  LineOverGround line_;
  bool found_ = false, last_open_ = false;
  std::size_t last_ = 0;
  LineClearance result_;
};

}  // namespace

std::optional<LineClearance> line_clearance(const Profile& profile, const Antennas& antennas, const Earth& earth) {
  return Walk(profile, antennas, earth).run();
}

}  // namespace itin::profile
