#include "pyramid/line_writer.hpp"

#include <algorithm>
#include <utility>

#include <itin/sort_unique.hpp>

#include "pyramid/part_masks.hpp"

namespace itin {

void LineWriter::run(std::vector<Segment> segments, std::span<const SegmentFeature> features, Progress& progress) {
  const std::vector<GridPoint> draped = write_draped(progress);
  count();
  for (const std::vector<Segment>* const more : {&placed_.features, &placed_.raised, &placed_.ground})
    segments.insert(segments.end(), more->begin(), more->end());
  const WrittenParts parts = write_parts(lines_, ground_, draped, segments, writer_, progress);
  for (std::size_t p = 0; p < lines_.parts.size(); ++p) {
    report_.line_vertices[lines_.themes() + p] = lines_.parts[p].vertices.size();
    report_.vertices_of_source[lines_.parts[p].source] += lines_.parts[p].vertices.size();
  }
  segments.insert(segments.end(), parts.masked.begin(), parts.masked.end());
  writer_.add_segments(segments, features, parts.clusters);
}

/// Writes the vertices of lines on the ground, and returns them.
std::vector<GridPoint> LineWriter::write_draped(Progress& progress) {
  const std::vector<ThemeVertex> crossings = crossings_of_ground(lines_);
  if (placed_.features.empty() && crossings.empty()) return {};
  std::vector<std::uint64_t> ends = placed_.ends;
  for (const ThemeVertex& v : crossings) ends.push_back(v.code);
  sort_unique(ends);
  std::vector<GridPoint> draped = drape(ends, ground_, progress);
  write_vertices(crossings, draped);
  return draped;
}

/// Writes the vertices that each theme has besides those of the full surface, with the themes they belong to.
/// `crossings`: the vertices at which lines that keep the ground cross other lines.
void LineWriter::write_vertices(const std::vector<ThemeVertex>& crossings, const std::vector<GridPoint>& draped) {
  std::vector<std::pair<std::uint16_t, std::uint64_t>> ends;  // theme, code
  for (const Segment& s : placed_.features) {
    ends.emplace_back(s.theme, code_of(s.a()));
    ends.emplace_back(s.theme, code_of(s.b()));
  }
  for (const auto& [theme, code] : crossings) ends.emplace_back(theme + 1, code);
  sort_unique(ends);
  for (auto at = ends.begin(); at != ends.end();) {
    const std::uint16_t theme = at->first;
    std::vector<GridPoint> points;
    std::vector<std::uint16_t> sources;
    for (; at != ends.end() && at->first == theme; ++at) {
      const auto point = find_by_code(draped, at->second);
      if (point == draped.end()) continue;
      const auto vertex = find_by_code(lines_.lines.vertices, at->second);
      points.push_back(*point);
      sources.push_back(lines_.sources[static_cast<std::size_t>(vertex - lines_.lines.vertices.begin())]);
      report_.vertices_of_source[sources.back()] += 1;
    }
    writer_.add_theme_vertices(theme, points, sources);
  }
}

void LineWriter::count() {
  const std::size_t themes = lines_.themes() + lines_.parts.size();
  std::vector<std::vector<std::uint64_t>> ends(themes);
  report_.segments.assign(themes, 0);
  report_.left_out = placed_.left_out;
  for (const std::vector<Segment>* segments : {&placed_.terrain, &placed_.features, &placed_.raised}) {
    for (const Segment& s : *segments) {
      report_.segments[s.theme - std::size_t{1}] += 1;
      ends[s.theme - std::size_t{1}].push_back(code_of(s.a()));
      ends[s.theme - std::size_t{1}].push_back(code_of(s.b()));
    }
  }
  for (std::vector<std::uint64_t>& codes : ends) {
    sort_unique(codes);
    report_.line_vertices.push_back(codes.size());
  }
}

}  // namespace itin
