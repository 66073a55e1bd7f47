#include "least_height.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace itin::viewshed {

/// Lines of a packet whose upper height no ray found hidden.
struct LeastHeights::Search {
  const Tin& tin;
  std::array<SightLine, SightLines::kSize> exact;
  Memory& memory;
  Heights least{};
  std::array<unsigned, SightLines::kSize> open{};  ///< numbers of lines
  std::size_t count = 0;

  template <std::size_t... i>
  Search(const Tin& surface, const SightLines& l, Memory& remembered, double drop, double grazing,
         std::index_sequence<i...>)
      : tin(surface),
        exact{SightLine({l.from_x[i], l.from_y[i], l.from_z[i]}, {l.to_x[i], l.to_y[i], l.to_z[i]}, drop, grazing)...},
        memory(remembered) {}

  void add(unsigned line, double lower) {
    open[count++] = line;
    least[line] = lower;
  }

  /// What hid some line of the last packet may hide any of this one. One line that is left low spoils the pruning for
  /// all, so every line tries them.
  void clear_silhouettes() {
    auto silhouettes = memory.silhouettes;
    std::sort(silhouettes.begin(), silhouettes.end());
    const auto end = std::unique(silhouettes.begin(), silhouettes.end());
    for (auto triangle = silhouettes.begin(); triangle != end && *triangle != kNone; ++triangle)
      for (std::size_t n = 0; n < count; ++n) clear(open[n], *triangle);
  }

  void clear(unsigned line, std::uint32_t triangle) {
    const Triangle& t = tin.triangles[triangle];
    const double end = exact[line].clearing_end(tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]]);
    if (end > least[line]) least[line] = end, memory.silhouettes[line] = triangle;
  }

  double lowest() const {
    double result = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < count; ++n) result = std::min(result, least[open[n]]);
    return result;
  }

  void run(const HeightPyramid& pyramid) {
    clear_silhouettes();
    Sheaf sheaf;
    for (std::size_t n = 0; n < count; ++n) sheaf.add(exact[open[n]]);
    sheaf.end = lowest();
    // A triangle is listed in several bins, and met in them one after the other.
    std::array<std::uint32_t, 64> recent;
    recent.fill(kNone);
    pyramid.search(sheaf, [&](std::uint32_t triangle) {
      if (std::exchange(recent[triangle % recent.size()], triangle) == triangle) return;
      for (std::size_t n = 0; n < count; ++n) clear(open[n], triangle);
      sheaf.end = lowest();
    });
  }
};

LeastHeights::LeastHeights(const Tin& tin, const Earth& earth, const Scene& scene)
    : tin_(tin),
      scene_(scene),
      drop_(earth.drop_coefficient() * tin.grid.resolution),
      grazing_(kGrazing / tin.grid.resolution),
      pyramid_(tin) {}

LeastHeights::Heights LeastHeights::find(const SightLines& lines, const Heights& lower, Memory& memory) const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Heights result;
  result.fill(kNaN);
  const unsigned open = lines.active & ~scene_.hidden(lines, memory.occluder);
  if (open == 0) return result;
  Search search(tin_, lines, memory, drop_, grazing_, std::make_index_sequence<SightLines::kSize>());
  for (unsigned rest = open; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    search.add(i, std::min(lower[i], lines.to_z[i]));
  }
  search.run(pyramid_);
  for (std::size_t n = 0; n < search.count; ++n) {
    const unsigned i = search.open[n];
    result[i] = search.least[i];
    // Rays pass what rises above the line by less than their error bound. And what rises by less than a grazing is only
    // touched, though clearing it takes a hair more than the upper height.
    if (result[i] > lines.to_z[i]) result[i] = scene_.hidden_between(lines, i, 0, 1) ? kNaN : lines.to_z[i];
  }
  return result;
}

}  // namespace itin::viewshed
