#include "lines/obstructions.hpp"

#include <optional>
#include <utility>

#include <itin/clearance.hpp>
#include <itin/grazing.hpp>

#include "lines/ground_pieces.hpp"

namespace itin::profile {

namespace {

/// The part of a piece where the clearance is negative, if any: [first, second] within [from, to].
std::optional<std::pair<double, double>> cut_part(const ClearancePiece& p) {
  const bool at_from = p.at(p.from) < 0, at_to = p.at(p.to) < 0;
  if (at_from && at_to) return std::pair{p.from, p.to};  // convex: negative everywhere between
  const double lowest_at = p.least_within(p.from, p.to);
  if (p.at(lowest_at) >= 0) return std::nullopt;
  const auto border = [&](double outside, double inside) {
    for (double middle = (outside + inside) / 2; middle != outside && middle != inside;
         middle = (outside + inside) / 2) {
      (p.at(middle) < 0 ? inside : outside) = middle;
    }
    return inside;
  };
  return std::pair{at_from ? p.from : border(p.from, lowest_at), at_to ? p.to : border(p.to, lowest_at)};
}

/// Gathers the parts of a profile that are cut off.
class Gathering {
 public:
  explicit Gathering(const Profile& profile) : profile_(profile) {}

  void add(const ClearancePiece& piece, std::size_t i, double from, double to) {
    const double lowest_at = piece.least_within(from, to), scale = profile_.length_m, depth = -piece.at(lowest_at);
    const bool goes_on = !found_.empty() && from == piece.from && last_ == i && last_open_;
    if (!goes_on) found_.push_back({from * scale, to * scale, 0, 0, 0, 0, -1});
    Obstruction& o = found_.back();
    o.to_m = to * scale;
    if (depth > o.depth_m) {
      const ProfilePoint p = ground_between(profile_, i, lowest_at * scale);
      o.peak_at_m = p.distance_m, o.peak_m = p.ground_m, o.depth_m = depth;
      o.theme = p.theme, o.feature = p.feature;
    }
    last_open_ = to == piece.to;
    last_ = i + 1;
    // If a vertical face begins where this piece ends, the next piece is one farther on.
    while (last_ + 1 < profile_.points.size() &&
           profile_.points[last_ + 1].distance_m == profile_.points[last_].distance_m) {
      ++last_;
    }
  }

  /// Returns the obstructions. Whether there are any follows from the clearance: an obstruction thinner than its
  /// rounding error is left out or added accordingly.
  std::vector<Obstruction> finish(const LineClearance& least) {
    std::erase_if(found_, [](const Obstruction& o) { return o.depth_m <= kGrazing; });
    if (least.clearance_m < -kGrazing && found_.empty()) {
      const ProfilePoint& p = least.critical;
      found_.push_back({p.distance_m, p.distance_m, p.distance_m, p.ground_m, -least.clearance_m, p.theme, p.feature});
    }
    return std::move(found_);
  }

 private:
  const Profile& profile_;
  bool last_open_ = false;
  std::size_t last_ = 0;
  std::vector<Obstruction> found_;
};

}  // namespace

std::vector<Obstruction> obstructions(const Profile& profile, const Antennas& antennas, const Earth& earth,
                                      const LineClearance& least) {
  if (!profile.has_length()) return {};
  Gathering gathering(profile);
  for_each_piece(profile, antennas, earth.drop_coefficient(), [&](const ClearancePiece& piece, std::size_t i) {
    if (const auto cut = cut_part(piece)) gathering.add(piece, i, cut->first, cut->second);
  });
  return gathering.finish(least);
}

}  // namespace itin::profile
