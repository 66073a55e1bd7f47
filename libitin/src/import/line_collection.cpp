#include "import/line_collection.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "store/store_format.hpp"

namespace itin {

void LineCollection::take_themes(const StoreMetadata& metadata) {
  themes_ = metadata.themes;
  first_source_.assign(themes_.size(), 0);
  for (std::size_t s = metadata.sources.size(); s-- > 0;) {
    from_line_.insert(from_line_.begin(), !metadata.sources[s].theme.empty());
    for (std::size_t t = 0; t < themes_.size(); ++t) {
      if (themes_[t].name == metadata.sources[s].theme) first_source_[t] = static_cast<std::uint16_t>(s);
    }
  }
}

bool LineCollection::take_vertex(const GridPoint& p, std::uint16_t source) {
  if (!from_line_[source]) return false;
  vertices_.try_emplace(morton(p.x, p.y), Vertex{p.z, source});
  return true;
}

void LineCollection::take_segments(const PointIndex& index) {
  std::vector<Segment> stored;
  index.segments(index.bounds(), stored);
  std::sort(stored.begin(), stored.end());
  stored.erase(std::unique(stored.begin(), stored.end()), stored.end());
  const auto vertex = [&](std::int32_t x, std::int32_t y) {
    // A vertex of the terrain has its height from a line, one of another line gets it anew.
    const auto found = vertices_.find(morton(x, y));
    return GridPoint{x, y, found == vertices_.end() ? 0 : found->second.z};
  };
  for (const Segment& s : stored) {
    if (s.theme == kCoverage || s.finest > 0) continue;
    segments_.push_back({vertex(s.ax, s.ay), vertex(s.bx, s.by), static_cast<std::uint32_t>(s.theme - 1)});
  }
}

std::uint32_t LineCollection::theme(const std::string& name, ThemeKind kind) {
  const auto found = std::find_if(themes_.begin(), themes_.end(), [&](const ThemeInfo& t) { return t.name == name; });
  if (found == themes_.end()) {
    if (themes_.size() == format::kMaxThemes)
      throw InputError(fmt::format("a store holds at most {} themes", format::kMaxThemes));
    themes_.push_back({name, kind, 0, 0, 0});
    first_source_.push_back(0);
    return static_cast<std::uint32_t>(themes_.size() - 1);
  }
  if (found->kind != kind)
    throw InputError(fmt::format("theme '{}': holds {} already, not {}; choose another name with --theme", name,
                                 name_of(found->kind), name_of(kind)));
  return static_cast<std::uint32_t>(found - themes_.begin());
}

void LineCollection::add(std::uint32_t theme, std::uint16_t source, std::span<const GridPoint> line) {
  if (themes_[theme].features == 0 && first_source_[theme] == 0) first_source_[theme] = source;
  for (const GridPoint& p : line) {
    // Of several sources the first one counts, whatever their order in memory.
    const auto [at, fresh] = vertices_.try_emplace(morton(p.x, p.y), Vertex{p.z, source});
    if (!fresh) at->second.source = std::min(at->second.source, source);
  }
  for (std::size_t i = 1; i < line.size(); ++i) segments_.push_back({line[i - 1], line[i], theme});
}

std::uint16_t LineCollection::source_of(const GridPoint& p, std::uint32_t owner) const {
  const auto found = vertices_.find(morton(p.x, p.y));
  return found != vertices_.end() ? found->second.source : first_source_[owner];
}

ThemeLines LineCollection::finish() {
  std::vector<std::uint32_t> order(themes_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(!is_terrain(themes_[a].kind), themes_[a].name) <
           std::pair(!is_terrain(themes_[b].kind), themes_[b].name);
  });
  std::vector<std::uint32_t> number(order.size());
  std::vector<ThemeInfo> themes;
  std::vector<std::uint16_t> first_source;
  ThemeLines result;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    number[order[i]] = i;
    themes.push_back(themes_[order[i]]);
    first_source.push_back(first_source_[order[i]]);
    result.terrain.push_back(is_terrain(themes.back().kind));
    result.kinds.push_back(themes.back().kind);
  }
  themes_ = std::move(themes);
  first_source_ = std::move(first_source);
  for (OwnedSegment& s : segments_) s.owner = number[s.owner];
  result.lines = make_planar(std::move(segments_));
  std::vector<std::uint32_t> owner(result.lines.vertices.size(), static_cast<std::uint32_t>(themes_.size()));
  for (const PlanarEdge& e : result.lines.edges) {
    for (const std::uint32_t v : {e.from, e.to}) owner[v] = std::min(owner[v], e.owner);
  }
  for (std::size_t v = 0; v < owner.size(); ++v)
    result.sources.push_back(source_of(result.lines.vertices[v], owner[v]));
  return result;
}

}  // namespace itin
