#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include <itin/parallel.hpp>
#include <viewshed/zone_files.hpp>

#include "turbines/value_bands.hpp"

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

/// Each cell has the ring about its nearest turbine; kNoRing where the cell has no value.
constexpr std::uint8_t kNoRing = 255;
std::vector<std::uint8_t> rings_of_cells(const Zone& zone, const std::vector<double>& limits) {
  std::vector<std::uint8_t> rings(zone.grid.cell_count(), kNoRing);
  const std::vector<std::uint16_t>& counts = zone.bare.tip_count;
  parallel_for(static_cast<std::size_t>(zone.grid.rows()), [&](std::size_t row) {
    for (std::int64_t column = 0; column < zone.grid.columns(); ++column) {
      const auto r = static_cast<std::int64_t>(row);
      const std::size_t i = zone.grid.index({column, r});
      if (counts[i] == kCountOutside) continue;
      const Point2 p = zone.grid.centre(column, r);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Turbine& t : zone.request.turbines) {
        const double dx = t.position.x - p.x, dy = t.position.y - p.y;
        nearest = std::min(nearest, dx * dx + dy * dy);
      }
      const double km = std::sqrt(nearest) / 1000;
      const auto ring = std::lower_bound(limits.begin(), limits.end(), km);
      rings[i] = static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(ring - limits.begin(), std::ssize(limits) - 1));
    }
  });
  return rings;
}

class AreaTable {
 public:
  explicit AreaTable(const Zone& zone)
      : zone_(zone), limits_(ring_limits(zone)), rings_(rings_of_cells(zone, limits_)) {
    text_ = "surface,seen,band,ring_from_km,ring_to_km,area_km2,share_of_ring_percent\n";
  }

  void add(const char* surface, const char* seen, const std::vector<std::uint16_t>& counts) {
    const auto bands = count_bands(zone_.request.turbines.size(), zone_.request.count_bands);
    std::vector<std::vector<std::uint64_t>> cells(limits_.size(), std::vector<std::uint64_t>(bands.size()));
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (rings_[i] != kNoRing && counts[i] != kCountOutside) ++cells[rings_[i]][band_of(bands, counts[i])];
    for (std::size_t r = 0; r < limits_.size(); ++r) {
      std::uint64_t all = 0;
      for (const std::uint64_t n : cells[r]) all += n;
      if (all == 0) continue;
      for (std::size_t b = 0; b < bands.size(); ++b)
        fmt::format_to(std::back_inserter(text_), "{},{},{},{:g},{:g},{:.6f},{:.3f}\n", surface, seen, bands[b].label,
                       r == 0 ? 0 : limits_[r - 1], limits_[r],
                       static_cast<double>(cells[r][b]) * zone_.grid.cell_area() / 1e6,
                       100.0 * static_cast<double>(cells[r][b]) / static_cast<double>(all));
    }
  }
  std::string text() && { return std::move(text_); }

 private:
  const Zone& zone_;
  std::vector<double> limits_;
  std::vector<std::uint8_t> rings_;
  std::string text_;
};

}  // namespace

std::string area_table(const Zone& zone) {
  AreaTable table(zone);
  const auto add = [&](const char* surface, const Visibility& v) {
    table.add(surface, "hub", v.hub_count);
    table.add(surface, "tip", v.tip_count);
  };
  add("bare", zone.bare);
  if (zone.screened) add("screened", *zone.screened);
  return std::move(table).text();
}

}  // namespace itin::viewshed
