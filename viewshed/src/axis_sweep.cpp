#include "axis_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itin::viewshed {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHidden = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kNone = 0xffffffff;

}  // namespace

/// One axis and one tile.
class AxisSweep::Task {
 public:
  Task(const AxisSweep& sweep, const Axis& axis, const Eyes& eyes, Heights& heights)
      : tin_(sweep.tin_),
        bins_(sweep.bins_),
        axis_(axis),
        eyes_(eyes),
        heights_(heights),
        drop_(sweep.drop_),
        grazing_(sweep.grazing_),
        axis_column_(bins_.column_at(axis.x)),
        axis_row_(bins_.row_at(axis.y)) {
    for (std::int64_t c = 0; c < eyes.tile.columns; ++c)
      columns_[static_cast<std::size_t>(c)] = bins_.column_at(eyes.centres.x[static_cast<std::size_t>(c)]);
    for (std::int64_t r = 0; r < eyes.tile.rows; ++r)
      rows_[static_cast<std::size_t>(r)] = bins_.row_at(eyes.centres.y[static_cast<std::size_t>(r)]);
    const double bin = bins_.bin_size();
    profile_axis_.top = axis.top;
    profile_axis_.drop = drop_ * bin * bin;
    // A ten-thousandth of a metre, and single precision's rounding of heights and of drops.
    const double greatest = bins_.greatest_magnitude() + std::abs(axis.top) + drop_ * 4 * axis.radius * axis.radius;
    profile_axis_.margin = 100 * grazing_ + greatest * 0x1p-21;
  }

  std::uint64_t run() {
    heights_.fill(kInfinity);
    for (unsigned side = 0; side < 4; ++side) look_from(side);
    return lines_;
  }

 private:
  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

  void look_from(unsigned side) {
    const Quadrant quadrant(bins_, axis_column_, axis_row_, side);
    by_row_ = side < 2;
    majors_ = by_row_ ? eyes_.tile.columns : eyes_.tile.rows;
    minors_ = by_row_ ? eyes_.tile.rows : eyes_.tile.columns;
    for (std::int64_t i = 0; i < majors_; ++i) along_[index(i)] = quadrant.along(columns_[index(i)], rows_[index(i)]);
    for (std::int64_t i = 0; i < minors_; ++i) across_[index(i)] = quadrant.across(columns_[index(i)], rows_[index(i)]);
    const bool grows = along_[index(majors_ - 1)] > along_[0];
    const double farthest = std::max(along_[index(majors_ - 1)], along_[0]);
    if (farthest <= 0) return;
    double from = 1, to = -1;
    for (const double v : {across_[0], across_[index(minors_ - 1)]}) {
      for (const double u : {along_[0], along_[index(majors_ - 1)]}) {
        const double slope = u > 0 ? v / u : v < 0 ? -kInfinity : kInfinity;
        from = std::min(from, slope), to = std::max(to, slope);
      }
    }
    // A hair more, against rounding.
    from = std::max(from, -1.0) - 1e-9, to = std::min(to, 1.0);
    if (from > to) return;
    const double cell = std::abs(across_[index(minors_ - 1)] - across_[0]) / static_cast<double>(std::max<std::int64_t>(1, minors_ - 1));
    const double width = std::max(1.0, cell) / farthest;
    const auto sectors = static_cast<std::size_t>(std::ceil((to - from) / width)) + 1;
    const std::size_t count = std::min(quadrant.slab_at(farthest) + 1, quadrant.slabs());
    silhouettes_.fill(kNone);
    bool surveyed = false;
    for (std::size_t j = 0; j < sectors; ++j) {
      const double low = from + static_cast<double>(j) * width, high = from + static_cast<double>(j + 1) * width;
      surveyed = false;
      last_ = kNone;
      for (std::int64_t n = 0; n < majors_; ++n) {
        const std::int64_t i = grows ? n : majors_ - 1 - n;
        const double u = along_[index(i)];
        if (u <= 0) continue;
        for (std::int64_t k = first_from(low * u, cell); k < first_from(high * u, cell); ++k) {
          const std::size_t place = by_row_ ? index(k * Tile::kSide + i) : index(i * Tile::kSide + k);
          const double v = across_[index(k)];
          if (std::isnan(eyes_.elevation[place])) continue;
          if (by_row_ ? std::abs(v) > u : std::abs(v) >= u) continue;
          const double dx = eyes_.centres.x[by_row_ ? index(i) : index(k)] - axis_.x;
          const double dy = eyes_.centres.y[by_row_ ? index(k) : index(i)] - axis_.y;
          const double squared = dx * dx + dy * dy;
          if (squared > axis_.radius * axis_.radius) continue;
          if (!surveyed) {
            profile_.survey(quadrant, low, high, count, profile_axis_);
            surveyed = true;
          }
          ++lines_;
          look(quadrant, place, index(i), u, v / u, squared, {axis_.x + dx, axis_.y + dy, eyes_.elevation[place]});
        }
      }
    }
  }

  /// The first of the tile's cells across that lies at `v` or beyond.
  std::int64_t first_from(double v, double cell) const {
    const double at = cell > 0 ? (v - across_[0]) / cell : (v > across_[0] ? 1 : 0);
    return static_cast<std::int64_t>(std::clamp(std::ceil(at), 0.0, static_cast<double>(minors_)));
  }

  void look(const Quadrant& quadrant, std::size_t place, std::size_t major, double u, double slope, double squared,
            const Point3& eye) {
    const double lowered = eye.z - drop_ * squared;
    const std::size_t slab = quadrant.slab_at(u);
    heights_[place] = kHidden;
    if (profile_.hides((lowered - axis_.top) / u, slab)) return;
    const SightLine line(eye, {axis_.x, axis_.y, axis_.top}, drop_, grazing_);
    double least = std::min(axis_.base, axis_.top), per_bin = (lowered - least) / u;
    std::uint32_t silhouette = kNone;
    const auto clear = [&](std::uint32_t number) {
      const Triangle& t = tin_.triangles[number];
      const GridPoint &a = tin_.vertices[t[0]], &b = tin_.vertices[t[1]], &c = tin_.vertices[t[2]];
      const double end = line.clearing_end(a, b, c);
      if (end <= least) return true;
      silhouette = number;
      if (end > axis_.top && line.hidden_by(a, b, c)) return false;
      // What rises by less than a grazing is only touched, though clearing it takes a hair more than the top.
      least = std::min(end, axis_.top), per_bin = (lowered - least) / u;
      return true;
    };
    const auto remember = [&] { last_ = silhouettes_[major] = silhouette; };
    const std::uint32_t beside = silhouettes_[major];
    if (last_ != kNone && !clear(last_)) return remember();
    if (beside != kNone && beside != last_ && !clear(beside)) return remember();
    bool seen = true;
    profile_.search(slab, [&] { return least; }, [&] { return per_bin; }, [&](std::size_t k) {
      const double begin = slope * quadrant.begin(k), end = slope * quadrant.end(k);
      const double low = quadrant.minor() + std::min(begin, end), high = quadrant.minor() + std::max(begin, end);
      const auto first = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(low - BinnedHeights::kSlack)));
      const auto last = std::min(quadrant.lines() - 1, static_cast<std::int64_t>(std::floor(high + BinnedHeights::kSlack)));
      for (std::int64_t bin = first; bin <= last; ++bin)
        for (const std::uint32_t t : quadrant.triangles(k, bin))
          if (!clear(t)) return seen = false;
      return true;
    });
    if (silhouette != kNone) remember();
    if (!seen) return;
    heights_[place] = least;
  }

  const Tin& tin_;
  const BinnedHeights& bins_;
  const Axis& axis_;
  const Eyes& eyes_;
  Heights& heights_;
  double drop_, grazing_, axis_column_, axis_row_;
  SectorProfile::Axis profile_axis_;
  std::array<double, Tile::kSide> columns_{}, rows_{}, along_{}, across_{};
  bool by_row_ = true;
  std::int64_t majors_ = 0, minors_ = 0;
  SectorProfile profile_;
  std::array<std::uint32_t, Tile::kSide> silhouettes_{};
  std::uint32_t last_ = kNone;
  std::uint64_t lines_ = 0;
};

AxisSweep::AxisSweep(const Tin& tin, const Earth& earth, const BinnedHeights& bins)
    : tin_(tin),
      bins_(bins),
      drop_(earth.drop_coefficient() * tin.grid.resolution),
      grazing_(kGrazing / tin.grid.resolution) {}

std::uint64_t AxisSweep::run(const Axis& axis, const Eyes& eyes, Heights& heights) const {
  return Task(*this, axis, eyes, heights).run();
}

}  // namespace itin::viewshed
