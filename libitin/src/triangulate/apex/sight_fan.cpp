#include "triangulate/apex/sight_fan.hpp"

#include <algorithm>
#include <cmath>

#include "triangulate/apex/apex.hpp"

namespace itin {

namespace {

constexpr std::size_t kSegmentsPerSector = 4;
constexpr std::size_t kMostSectors = 512;
/// The slack of directions: far above their rounding, far below the width of a sector.
constexpr double kSlack = 1e-9;

}  // namespace

SightFan::SightFan(Position a, Position b, Position eye, std::span<const Segment> segments)
    : eye_(eye), segments_(segments) {
  along_x_ = static_cast<double>(b.x) - a.x, along_y_ = static_cast<double>(b.y) - a.y;
  const double length = std::hypot(along_x_, along_y_);
  along_x_ /= length, along_y_ /= length;
  count_ = static_cast<std::uint32_t>(std::clamp<std::size_t>(segments.size() / kSegmentsPerSector, 1, kMostSectors));
  std::vector<Sectors> sectors;
  for (const Segment& s : segments) sectors.push_back(sectors_of(s));
  in_sector_ = {count_, sectors.size(), [&](std::uint32_t i, const auto& add) {
                  for (std::uint32_t k = sectors[i].first; k < sectors[i].last; ++k) add(k);
                }};
}

/// Returns a measure of direction that grows from 0 along ab to 2 against it, over directions to the left.
double SightFan::pseudo_angle(double x, double y) const {
  const double along = x * along_x_ + y * along_y_, aside = std::max(0.0, y * along_x_ - x * along_y_);
  const double sum = std::abs(along) + aside;
  return sum > 0 ? 1 - along / sum : 1;
}

std::uint32_t SightFan::sector(double angle) const {
  return static_cast<std::uint32_t>(std::clamp(angle / 2 * count_, 0.0, count_ - 1.0));
}

/// Returns the sectors of a segment, from `first` up to, not including, `last`; none where the segment begins at the
/// eye and so blocks nothing.
SightFan::Sectors SightFan::sectors_of(const Segment& s) const {
  const double px = static_cast<double>(s.ax) - eye_.x, py = static_cast<double>(s.ay) - eye_.y;
  const double qx = static_cast<double>(s.bx) - eye_.x, qy = static_cast<double>(s.by) - eye_.y;
  if ((px == 0 && py == 0) || (qx == 0 && qy == 0)) return {0, 0};
  const double p_aside = py * along_x_ - px * along_y_, q_aside = qy * along_x_ - qx * along_y_;
  double low = std::min(pseudo_angle(px, py), pseudo_angle(qx, qy)),
         high = std::max(pseudo_angle(px, py), pseudo_angle(qx, qy));
  // A segment from the right of ab is cut off there: the side on which it passes the eye decides which way it extends.
  if (p_aside < 1 || q_aside < 1) {
    const double side = (px * qy - py * qx) * (p_aside < q_aside ? 1 : -1);
    const double doubt = kSlack * (std::abs(px * qy) + std::abs(py * qx));
    if (side > -doubt) low = 0;
    if (side < doubt) high = 2;
  }
  return {sector(low - kSlack), sector(high + kSlack) + 1};
}

bool SightFan::blocked(Position c) const {
  const auto near =
      in_sector_.in(sector(pseudo_angle(static_cast<double>(c.x) - eye_.x, static_cast<double>(c.y) - eye_.y)));
  return std::any_of(near.begin(), near.end(), [&](std::uint32_t i) { return crosses(segments_[i], eye_, c); });
}

}  // namespace itin
