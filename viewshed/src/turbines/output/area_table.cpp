#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include <itin/parallel.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/zone_files.hpp>

#include "line/infinity.hpp"
#include "request/cells_in_view.hpp"
#include "turbines/output/count_classes.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

namespace {

/// Outer limits of the rings, km; the last holds the farthest radius.
std::vector<double> ring_limits(const Zone& zone) {
  double farthest = 0;
  for (const Turbine& t : zone.request.turbines) farthest = std::max(farthest, t.radius / 1000);
  std::vector<double> limits;
  for (const double limit : {1.0, 2.0, 5.0})
    if (limit < farthest) limits.push_back(limit);
  for (double limit = 10; limit < farthest; limit += 5) limits.push_back(limit);
  limits.push_back(farthest);
  return limits;
}

/// The rings about the turbines: each place is in that of its nearest one.
class Rings {
 public:
  explicit Rings(const Zone& zone) : turbines_(zone.request.turbines), limits_(ring_limits(zone)) {}

  std::size_t size() const { return limits_.size(); }
  double from(std::size_t ring) const { return ring == 0 ? 0 : limits_[ring - 1]; }
  double to(std::size_t ring) const { return limits_[ring]; }
  std::size_t of(Point2 p) const {
    double nearest = kInfinity;
    for (const Turbine& t : turbines_) {
      const double dx = t.position.x - p.x, dy = t.position.y - p.y;
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
    const auto ring = std::lower_bound(limits_.begin(), limits_.end(), std::sqrt(nearest) / 1000);
    return static_cast<std::size_t>(std::min<std::ptrdiff_t>(ring - limits_.begin(), std::ssize(limits_) - 1));
  }

 private:
  const std::vector<Turbine>& turbines_;
  std::vector<double> limits_;
};

/// The ring of each cell that `asked` holds for; kNoRing for others.
constexpr std::uint8_t kNoRing = 255;
std::vector<std::uint8_t> rings_of_cells(const Rings& rings, const RasterGrid& grid,
                                         const std::function<bool(std::size_t)>& asked) {
  std::vector<std::uint8_t> found(grid.cell_count(), kNoRing);
  parallel_for(static_cast<std::size_t>(grid.rows()), [&](std::size_t row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      const auto r = static_cast<std::int64_t>(row);
      const std::size_t i = grid.index({column, r});
      if (asked(i)) found[i] = static_cast<std::uint8_t>(rings.of(grid.centre(column, r)));
    }
  });
  return found;
}

/// Counts the cells of each ring that have no ground, on the raster and beyond it.
std::vector<double> cells_without_ground(const Zone& zone, const Rings& rings) {
  std::vector<double> counts(rings.size());
  const auto add = [&](const RasterGrid& grid, const std::vector<std::uint8_t>& cells, double each) {
    for (const std::uint8_t ring : rings_of_cells(rings, grid, [&](std::size_t i) { return cells[i] == 1; }))
      if (ring != kNoRing) counts[ring] += each;
  };
  add(zone.grid, cells_without_ground(zone), 1);
  const CellsBeyond beyond = cells_beyond(view_of(zone.request), zone.grid);
  if (!beyond.cells.empty()) add(beyond.grid, beyond.cells, beyond.each);
  return counts;
}

class AreaTable {
 public:
  explicit AreaTable(const Zone& zone)
      : zone_(zone),
        rings_(zone),
        ring_of_(
            rings_of_cells(rings_, zone.grid, [&](std::size_t i) { return zone.bare.tip_count[i] != kCountOutside; })),
        without_ground_(cells_without_ground(zone, rings_)) {
    text_ =
        "surface,seen,band,ring_from_km,ring_to_km,area_km2,share_of_ring_with_data_percent,"
        "ring_with_data_percent,undecided_km2\n";
  }

  void add(const char* surface, const char* seen, const CountClasses& classes) {
    struct Cells {
      std::uint64_t all = 0, open = 0;
    };
    std::vector<std::vector<Cells>> cells(rings_.size(), std::vector<Cells>(classes.classes().size()));
    for (std::size_t i = 0; i < ring_of_.size(); ++i) {
      const auto of_cell = classes.of(i);
      if (ring_of_[i] == kNoRing || !of_cell) continue;
      Cells& found = cells[ring_of_[i]][*of_cell];
      ++found.all;
      if (classes.is_open(i)) ++found.open;
    }
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      std::uint64_t all = 0;
      for (const Cells& of_class : cells[r]) all += of_class.all;
      if (all == 0) continue;
      const auto with_data = static_cast<double>(all);
      for (std::size_t c = 0; c < cells[r].size(); ++c)
        fmt::format_to(std::back_inserter(text_), "{},{},{},{:g},{:g},{:.6f},{:.3f},{:.3f},{:.6f}\n", surface, seen,
                       classes.classes()[c].label, rings_.from(r), rings_.to(r), zone_.km2(cells[r][c].all),
                       100.0 * static_cast<double>(cells[r][c].all) / with_data,
                       100.0 * with_data / (with_data + without_ground_[r]), zone_.km2(cells[r][c].open));
    }
  }
  std::string text() && { return std::move(text_); }

 private:
  const Zone& zone_;
  Rings rings_;
  std::vector<std::uint8_t> ring_of_;   ///< the ring of each cell with ground
  std::vector<double> without_ground_;  ///< how many cells without ground each ring has
  std::string text_;
};

}  // namespace

std::string area_table(const Zone& zone) {
  AreaTable table(zone);
  const auto add = [&](const char* surface, const auto& seen) {
    if (known_hubs(zone) > 0) table.add(surface, "hub", {zone, seen, TurbinePart::kHub});
    table.add(surface, "tip", {zone, seen, TurbinePart::kTip});
  };
  add("bare", zone.bare);
  if (zone.screened) add("screened", *zone.screened);
  if (zone.seasons) add("summer", zone.seasons->summer), add("winter", zone.seasons->winter);
  return std::move(table).text();
}

}  // namespace itin::viewshed
