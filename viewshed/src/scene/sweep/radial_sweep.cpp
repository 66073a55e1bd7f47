#include "scene/sweep/radial_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <itin/same_place.hpp>

#include "line/infinity.hpp"
#include "scene/sweep/sweep_sights.hpp"

namespace itin::viewshed {

namespace {

constexpr double kHidden = std::numeric_limits<double>::quiet_NaN();

std::size_t number(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

/// Judges one axis and one tile, seen from the axis towards one side at a time.
class RadialSweep::Task {
 public:
  /// `lowest` is for Kind::kHeight, and null for others.
  Task(const RadialSweep& sweep, const View& view, Kind kind, const Ends& ends, const Lowest* lowest, Scratch& scratch,
       Heights& heights, const Progress& progress)
      : sweep_(sweep),
        bins_(sweep.bins_),
        view_(view),
        axis_(view.axis_),
        kind_(kind),
        ends_(ends),
        lowest_(lowest),
        profile_(scratch),
        heights_(heights),
        progress_(progress) {
    radius_squared_ = axis_.radius * axis_.radius;
  }

  void run() {
    heights_.fill(kInfinity);
    highest_ = -kInfinity;
    for (const double elevation : ends_.elevation)
      if (elevation > highest_) highest_ = elevation;
    for (std::size_t i = 0; i < view_.quadrants_.size(); ++i) decide_quadrant(view_.quadrants_[i], view_.fans_[i]);
    leave_out_own_place();
  }

 private:
  void leave_out_own_place() {
    for (std::size_t r = 0; r < number(ends_.tile.rows); ++r) {
      const double south = axis_.y - ends_.centres.y[r];
      if (!same_place(0, south)) continue;
      for (std::size_t c = 0; c < number(ends_.tile.columns); ++c)
        if (same_place(ends_.centres.x[c] - axis_.x, south)) heights_[r * Tile::kSide + c] = kInfinity;
    }
  }

  void decide_quadrant(const Quadrant& quadrant, const HorizonHierarchy& fan) {
    place_cells(quadrant);
    if (farthest_ <= 0 || quadrant.slabs() == 0) return;
    auto [from, to] = slopes();
    if (from > to) return;
    // The slopes are a hair wider, against rounding.
    from -= 1e-9, to += 1e-9;
    // Ground before the tile may hide even the highest of its ends.
    if (view_.hides(fan.known(from, to, quadrant.slab_at(nearest_)).hidden,
                    {from, to, nearest_, farthest_, least_drop()}, highest_)) {
      for_each_cell(quadrant, -kInfinity, kInfinity, [&](const Cell& cell) { heights_[cell.index] = kHidden; });
      return;
    }
    // Sectors are one cell wide at the tile's far end.
    const double width = std::max(1.0, 1 / cells_per_bin_) / farthest_;
    silhouettes_.fill(kNoSilhouette);
    for (std::size_t i = 0; from + static_cast<double>(i) * width <= to; ++i) {
      progress_.throw_if_cancelled();
      const Slopes sector{from + static_cast<double>(i) * width, from + static_cast<double>(i + 1) * width};
      // The outermost sectors take all cells that are left: near the axis a cell's slope may err by more than a hair.
      sweep(quadrant, fan, sector, {i == 0 ? -kInfinity : sector.from, sector.to > to ? kInfinity : sector.to});
    }
  }

  void place_cells(const Quadrant& quadrant) {
    const bool columns = quadrant.along_columns();
    majors_ = columns ? ends_.tile.columns : ends_.tile.rows;
    minors_ = columns ? ends_.tile.rows : ends_.tile.columns;
    const auto &x = ends_.centres.x, &y = ends_.centres.y;
    const auto squared = [](double d) { return d * d; };
    for (std::size_t i = 0; i < number(majors_); ++i) {
      along_[i] = columns ? quadrant.along(bins_.column_at(x[i]), 0) : quadrant.along(0, bins_.row_at(y[i]));
      along_squared_[i] = squared(columns ? x[i] - axis_.x : y[i] - axis_.y);
    }
    for (std::size_t i = 0; i < number(minors_); ++i) {
      across_[i] = columns ? quadrant.across(0, bins_.row_at(y[i])) : quadrant.across(bins_.column_at(x[i]), 0);
      across_squared_[i] = squared(columns ? y[i] - axis_.y : x[i] - axis_.x);
    }
    farthest_ = std::max(along_[0], along_[number(majors_ - 1)]);
    nearest_ = std::max(0.0, std::min(along_[0], along_[number(majors_ - 1)]));
    const double extent = across_[number(minors_ - 1)] - across_[0];
    cells_per_bin_ = minors_ > 1 ? static_cast<double>(minors_ - 1) / extent : 1;
  }

  /// The range of slopes of the cells within the quadrant; empty where none is.
  std::pair<double, double> slopes() const {
    double from = kInfinity, to = -kInfinity;
    for (const double v : {across_[0], across_[number(minors_ - 1)]}) {
      for (const double u : {along_[0], along_[number(majors_ - 1)]}) {
        const double slope = u > 0 ? v / u : std::copysign(kInfinity, v);
        from = std::min(from, slope), to = std::max(to, slope);
      }
    }
    return {std::max(from, -1.0), std::min(to, 1.0)};
  }

  /// The least drop of the tile's ends.
  double least_drop() const {
    const auto ends = [](const auto& of, std::int64_t count) {
      return std::minmax_element(of.begin(), of.begin() + count);
    };
    const double drop = sweep_.drop_;
    const auto [near_along, far_along] = ends(along_squared_, majors_);
    const auto [near_across, far_across] = ends(across_squared_, minors_);
    // Cells amid a row or a column may lie nearer than those at its ends, but not farther.
    return drop > 0 ? drop * (*near_along + *near_across) : drop * (*far_along + *far_across);
  }

  /// Calls visit(cell) for the cells with slopes in [from, to) whose ends are looked at, nearest first.
  template <class Visit>
  void for_each_cell(const Quadrant& quadrant, double from, double to, const Visit& visit) const {
    const bool columns = quadrant.along_columns(), grows = along_[0] < along_[number(majors_ - 1)];
    const std::size_t minor_step = columns ? Tile::kSide : 1, major_step = columns ? 1 : Tile::kSide;
    for (std::int64_t n = 0; n < majors_; ++n) {
      const std::size_t i = number(grows ? n : majors_ - 1 - n);
      const double u = along_[i];
      if (u <= 0) continue;
      const std::size_t end = first_across(to * u);
      for (std::size_t k = first_across(from * u); k < end; ++k) {
        Cell cell{i * major_step + k * minor_step, i, u, across_[k], along_squared_[i] + across_squared_[k]};
        // Each cell on a diagonal belongs to one quadrant.
        if (columns ? std::abs(cell.across) > u : std::abs(cell.across) >= u) continue;
        if (cell.squared <= radius_squared_ && !std::isnan(ends_.elevation[cell.index])) visit(cell);
      }
    }
  }

  struct Slopes {
    double from = 0, to = 0;
  };

  void sweep(const Quadrant& quadrant, const HorizonHierarchy& fan, const Slopes& sector, const Slopes& cells) {
    bool computed = false;
    last_ = kNoSilhouette;
    double along = -1, hidden_below = 0;  // how far away the last end was, and below what such ends are hidden
    for_each_cell(quadrant, cells.from, cells.to, [&](Cell cell) {
      if (!std::exchange(computed, true)) survey(quadrant, fan, sector.from, sector.to);
      if (cell.along != along) {
        along = cell.along;
        hidden_below = axis_.top + along * profile_.hidden_below(quadrant.slab_at(along));
      }
      heights_[cell.index] = kHidden;
      cell.hidden_below = hidden_below + sweep_.drop_ * cell.squared;
      if (ends_.elevation[cell.index] >= cell.hidden_below) judge(quadrant, cell);
    });
  }

  void survey(const Quadrant& quadrant, const HorizonHierarchy& fan, double from, double to) {
    const std::size_t nearest = quadrant.slab_at(nearest_);
    profile_.survey(Sector(quadrant, from, to, view_.sector_axis_), fan.known(from, to, nearest), nearest,
                    quadrant.slab_at(farthest_) + 1);
  }

  struct Cell {
    std::size_t index = 0;  ///< in the tile
    std::size_t major = 0;
    double along = 0, across = 0;
    double squared = 0;       ///< distance from the axis, grid units
    double hidden_below = 0;  ///< elevation
  };

  /// The first of the cells across that lies at `v` or beyond.
  std::size_t first_across(double v) const {
    const double at = (v - across_[0]) * cells_per_bin_;
    return at <= 0                                 ? 0
           : at > static_cast<double>(minors_ - 1) ? number(minors_)
                                                   : static_cast<std::size_t>(std::ceil(at));
  }

  void judge(const Quadrant& quadrant, const Cell& cell) {
    const Point3 top{axis_.x, axis_.y, axis_.top};
    const double elevation = ends_.elevation[cell.index];
    const SweptEnd end{cell.along, sweep_.drop_ * cell.squared};
    switch (kind_) {
      case Kind::kAxis: {
        const SightLine line = line_between(other_end(cell, elevation), top);
        return judge(quadrant, cell, AxisSight(line, axis_.base, end, view_.sector_axis_.margin));
      }
      case Kind::kPoint: {
        const SightLine line = line_between(top, other_end(cell, elevation));
        return judge(quadrant, cell, PointSight(line, end));
      }
      case Kind::kHeight: {
        const HeightSight::Range range{lowest_->end[cell.index], elevation, cell.hidden_below};
        const SightLine line = line_between(top, other_end(cell, range.lowest));
        judge(quadrant, cell, HeightSight(line, range, end, view_.sector_axis_.margin));
      }
    }
  }

  Point3 other_end(const Cell& cell, double elevation) const {
    const Point2 p = ends_.centres.at(cell.index);
    return {p.x, p.y, elevation};
  }
  SightLine line_between(const Point3& from, const Point3& to) const {
    return {from, to, sweep_.drop_, sweep_.grazing_};
  }

  template <class Sight>
  void judge(const Quadrant& quadrant, const Cell& cell, Sight sight) {
    if (decide(quadrant, cell, sight)) heights_[cell.index] = least(quadrant, cell, sight);
    last_ = silhouettes_[cell.major] = sight.silhouette();
  }

  template <class Sight>
  double least(const Quadrant&, const Cell&, const Sight& sight) {
    return sight.least();
  }
  /// A triangle that rises above a line by less than a grazing is only touched, though clearing it may take metres,
  /// near the eye.
  double least(const Quadrant& quadrant, const Cell& cell, const HeightSight& sight) {
    const double lowest = lowest_->end[cell.index];
    double least = sight.least();
    for (const double end : {lowest_->wanted[cell.index], lowest}) {
      if (!(end >= lowest && end < least) || sight.silhouette() == kNoSilhouette ||
          sight.hides(bins_.corners(sight.silhouette()), end))
        continue;
      const SightLine line = line_between({axis_.x, axis_.y, axis_.top}, other_end(cell, end));
      PointSight lower(line, {cell.along, sweep_.drop_ * cell.squared});
      if (decide(quadrant, cell, lower)) least = end;
    }
    return least;
  }

  /// Whether the top is seen.
  template <class Sight>
  bool decide(const Quadrant& quadrant, const Cell& cell, Sight& sight) {
    const std::uint32_t beside = silhouettes_[cell.major];
    if (last_ != kNoSilhouette && !clears(last_, sight)) return false;
    if (beside != kNoSilhouette && beside != last_ && !clears(beside, sight)) return false;
    bool seen = true;
    profile_.search(quadrant.slab_at(cell.along), sight,
                    [&](std::size_t slab) { return seen = clears(quadrant, slab, cell, sight); });
    return seen;
  }

  /// Looks at the triangles that lie in a slab under the line.
  template <class Sight>
  bool clears(const Quadrant& quadrant, std::size_t slab, const Cell& cell, Sight& sight) const {
    const double slope = cell.across / cell.along, minor = quadrant.minor();
    const double drop = view_.sector_axis_.drop * (1 + slope * slope);
    // The height of the line, less what curvature bends within a bin; it rises where the sight is raised.
    const auto height = [&](double along) {
      return sight.at_axis() + sight.slope() * along + drop * along * along - std::max(drop, 0.0) -
             view_.sector_axis_.margin;
    };
    for (std::size_t i = 0; i < Quadrant::kRun; ++i) {
      const double begin = std::max(0.0, quadrant.begin(slab) + static_cast<double>(i));
      const double end = std::min(quadrant.begin(slab) + static_cast<double>(i + 1), cell.along);
      if (begin - end > BinnedHeights::kSlack) continue;
      const double low = minor + slope * (slope < 0 ? end : begin), high = minor + slope * (slope < 0 ? begin : end);
      const auto first = static_cast<std::int64_t>(std::max(0.0, low - BinnedHeights::kSlack));
      const auto last = std::min(quadrant.lines() - 1, static_cast<std::int64_t>(high + BinnedHeights::kSlack));
      const double lowest = std::min(height(begin), height(end));
      for (std::int64_t line = first; line <= last; ++line) {
        const RasterGrid::Cell bin = quadrant.bin(slab, i, line);
        if (!bins_.holds(bin) || bins_.lies_below(bin, lowest)) continue;
        Stretch within{begin, end, slope};
        if (line > first) within.limit((static_cast<double>(line) - minor) / slope, slope > 0);
        if (line < last) within.limit((static_cast<double>(line + 1) - minor) / slope, slope < 0);
        if (!clears(quadrant, bin, within, height, sight)) return false;
      }
    }
    return true;
  }

  /// A stretch of a line outward, in bins along.
  struct Stretch {
    double begin = 0, end = 0;
    double slope = 0;  ///< across / along
    void limit(double at, bool from_below) {
      if (from_below) {
        begin = std::max(begin, at);
      } else {
        end = std::min(end, at);
      }
    }
  };

  template <class Height, class Sight>
  bool clears(const Quadrant& quadrant, const RasterGrid::Cell& bin, const Stretch& stretch, const Height& height,
              Sight& sight) const {
    const double near = height(stretch.begin), far = height(stretch.end);
    const BinnedHeights::UpperPlane upper_plane = bins_.upper_plane(bin);
    const auto plane_at = [&](double along) {
      const Point2 p = quadrant.position(along, stretch.slope * along);
      return upper_plane.at(p.x - static_cast<double>(bin.column) - 0.5, p.y - static_cast<double>(bin.row) - 0.5);
    };
    if (plane_at(stretch.begin) <= near && plane_at(stretch.end) <= far) return true;
    return bins_.for_each_triangle(bin, std::min(near, far), [&](std::uint32_t t) { return clears(t, sight); });
  }

  template <class Sight>
  bool clears(std::uint32_t triangle, Sight& sight) const {
    return sight.clears(triangle, bins_.corners(triangle));
  }

  const RadialSweep& sweep_;
  const BinnedHeights& bins_;
  const View& view_;
  const Axis& axis_;
  Kind kind_;
  const Ends& ends_;
  const Lowest* lowest_;
  SectorProfile& profile_;
  Heights& heights_;
  const Progress& progress_;
  double radius_squared_;
  // The tile's cells as the quadrant has them, in bins.
  std::array<double, Tile::kSide> along_{}, across_{}, along_squared_{}, across_squared_{};
  std::int64_t majors_ = 0, minors_ = 0;
  double highest_ = 0;  ///< the highest of the tile's ends
  double farthest_ = 0, nearest_ = 0, cells_per_bin_ = 1;
  // The triangle that hid the last eye of this sector, and the triangles that hid the last eye at each distance.
  std::uint32_t last_ = kNoSilhouette;
  std::array<std::uint32_t, Tile::kSide> silhouettes_{};
};

RadialSweep::RadialSweep(const Earth& earth, const BinnedHeights& surface)
    : bins_(surface),
      drop_(earth.drop_coefficient() * surface.units().resolution),
      grazing_(kGrazing / surface.units().resolution) {}

RadialSweep::View RadialSweep::beginning(const Axis& axis) const {
  return {bins_, axis, drop_, grazing_};
}

RadialSweep::View RadialSweep::view_of(const Axis& axis) const {
  View view = beginning(axis);
  view.advance(kInfinity);
  return view;
}

RadialSweep::Axis RadialSweep::axis_at(const Point3& eye, double radius) const {
  return View::axis_at(bins_, eye, radius);
}

void RadialSweep::run(const View& axis, const Ends& eyes, Scratch& scratch, Heights& heights) const {
  Task(*this, axis, Kind::kAxis, eyes, nullptr, scratch, heights, NoProgress()).run();
}

void RadialSweep::decide(const View& eye, const Ends& targets, Scratch& scratch, Heights& seen) const {
  Task(*this, eye, Kind::kPoint, targets, nullptr, scratch, seen, NoProgress()).run();
}

void RadialSweep::raise_from(const View& eye, const Ends& highest, const Lowest& lowest, Scratch& scratch,
                             Heights& least, const Progress& progress) const {
  Task(*this, eye, Kind::kHeight, highest, &lowest, scratch, least, progress).run();
}

}  // namespace itin::viewshed
