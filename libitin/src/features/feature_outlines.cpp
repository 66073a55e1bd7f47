#include "features/feature_outlines.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/sort_unique.hpp>
#include <itin/triangulate.hpp>

#include "features/plan/plan_on_grid.hpp"
#include "store/segments/footprint_codec.hpp"
#include "triangulate/region/grid_window.hpp"

namespace itin {

namespace {

/// The numbers of a theme's features that have triangles of the surface, ascending.
std::vector<std::int64_t> features_in(const Tin& tin, std::uint16_t theme, const Store& store,
                                      const Progress& progress) {
  std::vector<Point2> middles;
  for (const Triangle& t : tin.triangles) {
    if (tin.theme(t) != theme) continue;
    const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
    middles.push_back({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
  }
  std::vector<std::int64_t> numbers;
  for (const std::optional<FeatureAt>& feature : features_at(store, theme, middles, progress))
    if (feature) numbers.push_back(feature->number);
  sort_unique(numbers);
  return numbers;
}

/// A ring's corners on the grid, each once; the first does not come again at the end.
std::vector<GridPoint> ring_on_grid(const PlanRing& ring, const Grid& grid) {
  std::vector<GridPoint> corners;
  for (const Point2& p : ring) {
    const GridPoint corner = grid.quantise({p.x, p.y, 0});
    if (corners.empty() || corners.back() != corner) corners.push_back(corner);
  }
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

/// A measured roof without a footprint has the outline of its surfaces.
std::vector<std::vector<GridPoint>> rings_of(const FootprintFeature& feature, const Grid& grid) {
  std::vector<std::vector<GridPoint>> rings;
  for (const PlanRing& ring : feature.rings) rings.push_back(ring_on_grid(ring, grid));
  if (!rings.empty()) return rings;
  try {
    for (const GridPolygon& polygon : plan_of(feature.surfaces, grid))
      for_each_ring(polygon, [&](const GridRing& ring) {
        std::vector<GridPoint>& corners = rings.emplace_back();
        for (const Position& p : ring) corners.push_back({p.x, p.y, 0});
      });
  } catch (const OverlayError& error) {
    throw InputError(fmt::format("the roof of '{}' has no outline: {}", feature.name, error.what()));
  }
  return rings;
}

/// The runs of consecutive sides that are present. Each run lists the numbers of its corners; a whole ring ends with
/// its first corner again.
std::vector<std::vector<std::size_t>> runs_of(const std::vector<bool>& sides) {
  const std::size_t count = sides.size();
  const auto gap = static_cast<std::size_t>(std::find(sides.begin(), sides.end(), false) - sides.begin());
  std::vector<std::vector<std::size_t>> runs;
  const std::size_t start = gap == count ? 0 : gap + 1;
  bool goes_on = false;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t side = (start + i) % count;
    if (sides[side] && !goes_on) runs.push_back({side});
    if (sides[side]) runs.back().push_back((side + 1) % count);
    goes_on = sides[side];
  }
  return runs;
}

/// Rings of the features, with the heights of the terrain under their corners.
class Outlines {
 public:
  Outlines(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers)
      : grid_(store.metadata().grid), theme_(theme) {
    for_each_footprint(store, theme, [&](std::int64_t number, const StoredFootprint& f) {
      if (f.feature.cells || !std::binary_search(numbers.begin(), numbers.end(), number)) return;
      for (std::vector<GridPoint>& corners : rings_of(f.feature, grid_))
        rings_.push_back({static_cast<std::uint32_t>(number), std::move(corners)});
    });
  }

  std::vector<FeatureLine> lines(const Store& store, const WindowLines& window_lines, Progress& progress) const {
    std::vector<Point2> places;
    for (const Ring& ring : rings_)
      for (const GridPoint& p : ring.corners) places.push_back(grid_.position(p.x, p.y));
    const auto heights = heights_at(store, places, window_lines.detail, ThemeChoice::none(), progress);
    const GridWindow window(window_lines.window, grid_, store.metadata().bounds);
    std::vector<FeatureLine> lines;
    std::size_t first = 0;
    for (const Ring& ring : rings_) {
      const std::size_t count = ring.corners.size();
      std::vector<bool> sides;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const GridPoint &a = ring.corners[i], &b = ring.corners[next];
        sides.push_back(count > 1 && heights[first + i] && heights[first + next] && window.meets(a, b, b));
      }
      for (const std::vector<std::size_t>& run : runs_of(sides)) {
        FeatureLine& line = lines.emplace_back(FeatureLine{theme_, ring.feature, {}});
        for (const std::size_t i : run)
          line.points.push_back({places[first + i].x, places[first + i].y, *heights[first + i]});
      }
      first += count;
    }
    return lines;
  }

 private:
  struct Ring {
    std::uint32_t feature;
    std::vector<GridPoint> corners;
  };
  Grid grid_;
  std::uint16_t theme_;
  std::vector<Ring> rings_;
};

}  // namespace

std::vector<FeatureLine> feature_outlines(const Store& store, const WindowLines& window_lines, std::uint16_t theme,
                                          Progress& progress) {
  const Outlines outlines(store, theme, features_in(window_lines.tin, theme, store, progress));
  return outlines.lines(store, window_lines, progress);
}

}  // namespace itin
