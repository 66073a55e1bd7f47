#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <itin/clearance.hpp>
#include <itin/fresnel_zone.hpp>
#include <itin/grazing.hpp>
#include <itin/section_line.hpp>
#include <profile/line_of_sight.hpp>

#include "lines/triangle_buckets.hpp"

namespace itin::profile {

bool SightLine::visible() const {
  return !clearance || *clearance >= -kGrazing;
}

class SightLines::Impl {
 public:
  Impl(const Tin& tin, const Earth& earth, std::optional<double> wavelength)
      : tin_(&tin), buckets_(tin), drop_(earth.drop_coefficient()), wavelength_(wavelength) {}

  SightLine between(Point3 a, Point3 b) const {
    const SectionLine line(tin_->grid, {a.x, a.y}, {b.x, b.y});
    // Whichever end was given first, all arithmetic is the same.
    if (line.is_mirrored() || (line.is_point() && b.z < a.z)) std::swap(a, b);
    const double length = line.length();
    const LineOverGround over_metres(a.z, b.z, length, drop_);
    const LineOverGround over_fractions(a.z, b.z, 1, drop_ * length * length);
    LeastClearance least;
    LeastFraction tightest(std::sqrt(wavelength_.value_or(0) * length));
    for (const std::uint32_t t : buckets_.near(line.start(), line.end())) {
      const std::optional<SectionPiece> chord = line.chord(tin_->corners(t));
      if (!chord) continue;
      const std::optional<SectionPiece> piece = line.clip(chord->from, chord->to);
      if (!piece) continue;
      if (line.is_one_place()) {
        consider_ends(over_metres, *piece, least);
        continue;
      }
      least.consider(over_metres, {piece->from.distance, piece->from.position.z},
                     {piece->to.distance, piece->to.position.z});
      if (wavelength_) consider(over_fractions, length, *piece, tightest);
    }
    SightLine result;
    result.length = length;
    result.clearance = least.clearance;
    if (tightest.least()) result.fresnel_fraction = tightest.least()->fraction;
    if (least.clearance) result.critical = position(line, least.place);
    return result;
  }

 private:
  /// Considers ends at one place, which have no ground between them: only the ground at the ends counts.
  static void consider_ends(const LineOverGround& line, const SectionPiece& piece, LeastClearance& least) {
    for (const SectionCrossing* c : {&piece.from, &piece.to})
      if (c->t == 0 || c->t == 1) least.consider(line, GroundPoint{c->distance, c->position.z});
  }

  static void consider(const LineOverGround& line, double length, const SectionPiece& piece, LeastFraction& tightest) {
    const GroundPoint from{piece.from.distance / length, piece.from.position.z};
    const GroundPoint to{piece.to.distance / length, piece.to.position.z};
    tightest.consider(from.distance, line.clearance(from));
    tightest.consider(to.distance, line.clearance(to));
    if (from.distance < to.distance) tightest.consider_inside(line.piece(from, to));
  }

  static Point3 position(const SectionLine& line, const GroundPoint& p) {
    const double t = line.length() > 0 ? p.distance / line.length() : 0;
    const Point2 a = line.start(), b = line.end();
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), p.z};
  }

  const Tin* tin_;
  TriangleBuckets buckets_;
  double drop_;  ///< metres per square metre of distance
  std::optional<double> wavelength_;
};

SightLines::SightLines(const Tin& tin, const Earth& earth, std::optional<double> wavelength)
    : impl_(std::make_unique<Impl>(tin, earth, wavelength)) {}
SightLines::SightLines(SightLines&&) noexcept = default;
SightLines& SightLines::operator=(SightLines&&) noexcept = default;
SightLines::~SightLines() = default;

SightLine SightLines::between(Point3 a, Point3 b) const {
  return impl_->between(a, b);
}

}  // namespace itin::profile
