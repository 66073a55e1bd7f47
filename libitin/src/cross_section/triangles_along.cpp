#include <algorithm>
#include <utility>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/section_line.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

namespace itin {

namespace {

/// Returns strips about the legs that are wide enough for rounding.
Window window_along(const std::vector<Point2>& path, double resolution) {
  std::vector<Window::Polygon> strips;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (path[i] == path[i + 1]) continue;
    const Window strip = Window::corridor(path[i], path[i + 1], 4 * resolution);
    strips.insert(strips.end(), strip.parts().begin(), strip.parts().end());
  }
  if (strips.empty()) return Window::disc(path.front(), 2 * resolution);
  return Window::polygons(std::move(strips));
}

std::vector<SectionLine> lines_of(const std::vector<Point2>& path, const Grid& grid) {
  std::vector<SectionLine> lines;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) lines.emplace_back(grid, path[i], path[i + 1]);
  return lines;
}

bool meets(const SectionLine& line, const std::array<GridPoint, 3>& corners) {
  const auto chord = line.chord(corners);
  return chord && line.clip(chord->from, chord->to);
}

/// Returns a Tin's triangles of these numbers, ascending, with everything that belongs to them.
Tin part_of(const Tin& tin, const std::vector<std::uint32_t>& triangles) {
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> number(tin.vertices.size(), kNone);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : tin.triangles[t]) number[v] = 0;
  Tin part;
  part.grid = tin.grid;
  part.statistics = tin.statistics;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = static_cast<std::uint32_t>(part.vertices.size());
    part.vertices.push_back(tin.vertices[v]);
    part.sources.push_back(tin.sources[v]);
    if (!tin.raised_theme.empty()) part.raised_theme.push_back(tin.raised_theme[v]);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = tin.triangles[t];
    part.triangles.push_back({number[a], number[b], number[c]});
    for (const auto& [from, to] : {std::minmax(a, b), std::minmax(b, c), std::minmax(a, c)})
      edges.emplace_back(from, to);
  }
  std::sort(edges.begin(), edges.end());
  for (const LineEdge& e : tin.lines) {
    if (std::binary_search(edges.begin(), edges.end(), std::pair(e.from, e.to)))
      part.lines.push_back({number[e.from], number[e.to], e.theme});
  }
  return part;
}

}  // namespace

Tin triangles_along(const Store& store, const std::vector<Point2>& path, const Detail& detail,
                    const ThemeChoice& themes, Progress& progress) {
  if (path.size() < 2) throw InputError("path: give at least two places", "path");
  const Grid& grid = store.metadata().grid;
  const std::vector<SectionLine> lines = lines_of(path, grid);
  const Tin about = triangulate(store, window_along(path, grid.resolution), detail, progress, themes);
  std::vector<std::uint32_t> crossed;
  for (std::uint32_t t = 0; t < about.triangles.size(); ++t) {
    const std::array<GridPoint, 3> corners = about.corners(t);
    if (std::any_of(lines.begin(), lines.end(), [&](const SectionLine& line) { return meets(line, corners); }))
      crossed.push_back(t);
  }
  return part_of(about, crossed);
}

}  // namespace itin
