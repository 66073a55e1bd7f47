#include "foliage/foliage_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <itin/grid_units.hpp>
#include <itin/same_place.hpp>

#include "foliage/foliage_about.hpp"
#include "plan/azimuth_order.hpp"
#include "progress/stage.hpp"

namespace itin::viewshed {

namespace {

using Stretches = std::vector<profile::FoliageStretch>;

/// Transmittances that differ by less may be those of other roundings.
constexpr double kRoundedLight = 1e-9;
/// How many lines are a step.
constexpr std::size_t kChunk = 256;

double slant_of(const Point3& from, const Point3& to, double length) {
  return std::hypot(1, (to.z - from.z) / length);
}

/// Joins the pieces of a line to stretches, each within one feature.
Stretches joined(std::vector<FoliageAbout::Piece>& pieces, double length, double slant) {
  constexpr double kGap = 1e-9;
  std::sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
  Stretches stretches;
  for (const FoliageAbout::Piece& piece : pieces) {
    const bool goes_on = !stretches.empty() && piece.goes_on && stretches.back().theme == piece.theme &&
                         piece.from * length - stretches.back().to_m <= kGap * length;
    if (!goes_on) stretches.push_back({piece.from * length, 0, 0, piece.theme});
    profile::FoliageStretch& last = stretches.back();
    last.to_m = piece.to * length;
    last.length_m = (last.to_m - last.from_m) * slant;
  }
  return stretches;
}

}  // namespace

/// The lines from one eye.
class FoliageLines::Walk {
 public:
  Walk(const FoliageLines& lines, const Tin& tin, const Point3& eye)
      : lines_(lines),
        grid_(tin.grid),
        eye_(eye),
        about_(tin, lines.leaves_.vegetation(), in_units(eye), lines.surface_.earth) {}

  /// Returns the stretches of a line; where leaf areas are all the same, one may stand for all of them.
  Stretches along(const Point3& to) const {
    if (same_place(grid_, {eye_.x, eye_.y}, {to.x, to.y})) return {};
    std::vector<FoliageAbout::Piece> pieces;
    if (!about_.along(in_units(to), pieces)) {
      const SectionLine exact(grid_, {eye_.x, eye_.y}, {to.x, to.y});
      if (!about_.along(in_units(to), exact, pieces)) return by_section(to);
    }
    const double length = std::hypot(to.x - eye_.x, to.y - eye_.y), slant = slant_of(eye_, to, length);
    if (lines_.leaves_.vary()) return joined(pieces, length, slant);
    double within = 0;
    for (const FoliageAbout::Piece& piece : pieces) within += piece.to - piece.from;
    if (within == 0) return {};
    Stretches all{{0, length, within * length * slant, pieces.front().theme}};
    return is_close(all) ? by_section(to) : all;
  }

 private:
  Point3 in_units(const Point3& p) const {
    return {easting_in_units(grid_, p.x), northing_in_units(grid_, p.y), p.z / grid_.resolution};
  }
  /// Walks the line as `itin los` does.
  Stretches by_section(const Point3& to) const {
    const profile::Profile surface = profile::from_section(lines_.sections_.between({eye_.x, eye_.y}, {to.x, to.y}));
    return profile::foliage_along(surface, {eye_.z, to.z}, lines_.surface_.earth, lines_.leaves_.vegetation());
  }
  /// Whether rounding could decide the verdict.
  bool is_close(const Stretches& stretches) const {
    const std::vector<double> areas = lines_.leaves_.at(stretches, {});
    return std::abs(lines_.leaves_.transmittance(stretches, areas) - lines_.least_) < kRoundedLight;
  }

  const FoliageLines& lines_;
  Grid grid_;
  Point3 eye_;
  FoliageAbout about_;
};

FoliageLines::FoliageLines(const Store& store, Surface surface, const profile::Foliage& foliage)
    : surface_(std::move(surface)),
      leaves_(store, surface_.themes, foliage),
      least_(foliage.least_transmittance),
      sections_(store, surface_.detail, surface_.themes) {}

std::vector<LightThrough> FoliageLines::between(const Tin& tin, const Point3& eye, std::span<const Point3> targets,
                                                Progress& progress) const {
  return from(tin, eye).to(targets, progress);
}

FoliageLines::FromEye FoliageLines::from(const Tin& tin, const Point3& eye) const {
  return {*this, tin, eye};
}

FoliageLines::FromEye::FromEye(const FoliageLines& lines, const Tin& tin, const Point3& eye)
    : lines_(lines), eye_(eye), walk_(std::make_unique<const Walk>(lines, tin, eye)) {}
FoliageLines::FromEye::~FromEye() = default;

std::vector<LightThrough> FoliageLines::FromEye::to(std::span<const Point3> targets, Progress& progress) const {
  return lines_.walked(*walk_, eye_, targets, progress);
}

std::vector<LightThrough> FoliageLines::walked(const Walk& walk, const Point3& eye, std::span<const Point3> targets,
                                               Progress& progress) const {
  std::vector<LightThrough> light(targets.size());
  std::vector<Stretches> stretches(targets.size());
  std::vector<std::size_t> order(targets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  sort_by_azimuth(
      {eye.x, eye.y},
      [&](std::size_t i) {
        return Point2{targets[i].x, targets[i].y};
      },
      order);
  for_each_step((order.size() + kChunk - 1) / kChunk, "looking through foliage", progress, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(order.size(), (chunk + 1) * kChunk); ++i)
      stretches[order[i]] = walk.along(targets[order[i]]);
  });
  Stretches all;
  std::vector<Point2> middles;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double length = std::hypot(targets[i].x - eye.x, targets[i].y - eye.y);
    for (const profile::FoliageStretch& s : stretches[i]) {
      const double t = (s.from_m + s.to_m) / 2 / length;
      all.push_back(s);
      middles.push_back({eye.x + (targets[i].x - eye.x) * t, eye.y + (targets[i].y - eye.y) * t});
    }
  }
  const std::vector<double> areas = leaves_.at(all, middles);
  std::span<const double> left = areas;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (const profile::FoliageStretch& s : stretches[i]) light[i].length_m += s.length_m;
    light[i].transmittance = leaves_.transmittance(stretches[i], left.first(stretches[i].size()));
    left = left.subspan(stretches[i].size());
  }
  return light;
}

}  // namespace itin::viewshed
