#include "features/mesh/terrain_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include "base/stoppable.hpp"
#include "features/mesh/segment_owners.hpp"
#include "features/plan/mask_index.hpp"
#include "triangulate/apex/apex.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace itin {

namespace {

using TerrainEdge = std::pair<std::uint32_t, std::uint32_t>;

/// A top as a surface of its own.
class TopSurface {
 public:
  TopSurface(const Grid& grid, const std::vector<PlacedSegment>& lines) {
    const std::int32_t z = lines.front().a.z;
    if (std::all_of(lines.begin(), lines.end(), [&](const PlacedSegment& s) { return s.a.z == z && s.b.z == z; }))
      level_ = z;
    else
      triangulate(grid, lines);
  }
  TopSurface(const TopSurface&) = delete;
  TopSurface& operator=(const TopSurface&) = delete;

  /// The height in grid units; nothing beyond the top, unless the top is level.
  std::optional<double> at(Position p) const {
    if (level_) return *level_;
    const auto z = heights_->height_at(p);
    return z ? std::optional(*z / tin_.grid.resolution) : std::nullopt;
  }

 private:
  void triangulate(const Grid& grid, const std::vector<PlacedSegment>& lines) {
    tin_.grid = grid;
    std::map<Position, std::uint32_t> numbers;
    std::vector<Position> positions;
    const auto number = [&](const GridPoint& p) {
      const auto [at, fresh] = numbers.try_emplace({p.x, p.y}, static_cast<std::uint32_t>(positions.size()));
      if (fresh) {
        positions.push_back(at->first);
        tin_.vertices.push_back(p);
      }
      return at->second;
    };
    std::vector<Delaunay::Constraint> constraints;
    for (const PlacedSegment& s : lines) constraints.emplace_back(number(s.a), number(s.b));
    Delaunay delaunay;
    delaunay.insert(positions);
    delaunay.constrain(constraints);
    for (const auto& t : delaunay.mesh().triangles) tin_.triangles.push_back({t[0], t[1], t[2]});
    heights_.emplace(tin_);
  }

  std::optional<std::int32_t> level_;  ///< a flat roof needs no triangles
  Tin tin_;
  std::optional<TerrainHeights> heights_;
};

/// Polygons of several owners, to be found from positions.
class Ownership {
 public:
  void add(const GridPolygons& polygons, std::uint32_t owner) {
    for (const GridPolygon& polygon : polygons) {
      polygons_.push_back(polygon);
      owners_.push_back(owner);
    }
  }
  void finish() { index_.emplace(polygons_); }
  std::optional<std::uint32_t> at_middle(Position a, Position b) const {
    const auto found = index_->about_middle(a, b);
    return found ? std::optional(owners_[*found]) : std::nullopt;
  }
  std::optional<std::uint32_t> at(Position p) const {
    const auto found = index_->at(p);
    return found ? std::optional(owners_[*found]) : std::nullopt;
  }

 private:
  std::vector<GridPolygon> polygons_;
  std::vector<std::uint32_t> owners_;
  std::optional<MaskIndex> index_;
};

class Overlaying {
 public:
  Overlaying(const TerrainHeights& terrain, const std::vector<CoveredGround>& covered, const Progress& progress)
      : terrain_(terrain), covered_(covered), progress_(progress) {
    for (std::uint32_t i = 0; i < covered.size(); ++i) {
      footprints_.add(covered[i].footprint, i);
      tops_.add(covered[i].top, i);
      if (covered[i].above) above_[covered[i].feature] = *covered[i].above;
      if (covered[i].base) bases_[covered[i].feature] = *covered[i].base;
    }
    footprints_.finish();
    tops_.finish();
  }

  OverlaidLines run(std::vector<PlacedSegment> segments) {
    find_pierced(segments);
    const std::set<TerrainEdge> edges = edges_about(segments);
    if (flat(edges)) return raised(std::move(segments));
    segments_ = std::move(segments);
    lines_ = make_planar(owned(edges), &progress_);
    classify();
    raise();
    return collected();
  }

 private:
  /// Finds the tops that the terrain may pierce.
  void find_pierced(const std::vector<PlacedSegment>& segments) {
    std::vector<std::vector<PlacedSegment>> of_top(covered_.size());
    for (const PlacedSegment& s : segments) {
      stop_if_asked();
      if (s.kind == SegmentClass::foot) continue;
      const auto top = top_of(s);
      if (top && !covered_[*top].above && !covered_[*top].base) of_top[*top].push_back(s);
    }
    for (std::uint32_t i = 0; i < covered_.size(); ++i) {
      if (of_top[i].empty()) continue;
      std::int32_t low = of_top[i].front().a.z;
      for (const PlacedSegment& s : of_top[i]) low = std::min({low, s.a.z, s.b.z});
      const auto high = terrain_.base_height(covered_[i].top, BaseRule::maximum);
      if (high && *high / terrain_.grid().resolution > low)
        surfaces_[i] = std::make_unique<TopSurface>(terrain_.grid(), of_top[i]);
    }
  }

  /// The top that the segment borders or lies in.
  std::optional<std::uint32_t> top_of(const PlacedSegment& s) const {
    if (const auto inside = tops_.at_middle({s.a.x, s.a.y}, {s.b.x, s.b.y})) return inside;
    for (const Position p : {Position{s.a.x, s.a.y}, Position{s.b.x, s.b.y}}) {
      const auto top = tops_.at(p);
      if (top && covered_[*top].feature == s.feature) return top;
    }
    return std::nullopt;
  }

  std::set<TerrainEdge> edges_about(const std::vector<PlacedSegment>& segments) {
    std::set<std::uint32_t> triangles;
    for (const PlacedSegment& s : segments) {
      stop_if_asked();
      if (s.kind != SegmentClass::foot && s.kind != SegmentClass::eaves) continue;
      const auto along = terrain_.triangles_along({s.a.x, s.a.y}, {s.b.x, s.b.y});
      triangles.insert(along.begin(), along.end());
    }
    for (const auto& [i, surface] : surfaces_) {
      const auto under = terrain_.triangles_near(bounds_of(covered_[i].top));
      triangles.insert(under.begin(), under.end());
    }
    std::set<TerrainEdge> edges, directed;
    for (const std::uint32_t t : triangles) {
      const Triangle& v = terrain_.triangle(t);
      for (int i = 0; i < 3; ++i) {
        edges.insert(std::minmax(v[i], v[(i + 1) % 3]));
        directed.emplace(v[i], v[(i + 1) % 3]);
      }
    }
    for (const TerrainEdge& e : directed) {
      if (!directed.contains({e.second, e.first}))
        border_.push_back(ends_of(e));
      else if (e.first < e.second)
        inner_.emplace_back(std::minmax(ends_of(e).first, ends_of(e).second));
    }
    return edges;
  }

  GridEdge ends_of(const TerrainEdge& edge) const {
    const GridPoint &a = terrain_.vertex(edge.first), &b = terrain_.vertex(edge.second);
    return {{a.x, a.y}, {b.x, b.y}};
  }

  bool flat(const std::set<TerrainEdge>& edges) const {
    const auto z = [&](std::uint32_t v) { return terrain_.vertex(v).z; };
    return std::all_of(edges.begin(), edges.end(), [&](const TerrainEdge& e) {
      return z(e.first) == z(edges.begin()->first) && z(e.second) == z(edges.begin()->first);
    });
  }

  std::optional<std::int32_t> ground_at(const GridPoint& p, double above = 0) const {
    const auto metres = terrain_.height_at({p.x, p.y});
    if (!metres) return std::nullopt;
    return static_cast<std::int32_t>(std::llround(*metres / terrain_.grid().resolution + above));
  }

  /// Lifts p to the ground. A feature on a flat foundation stays where it is, though the ground was higher.
  void lift(GridPoint& p, std::int32_t ground, std::uint32_t feature) {
    if (p.z >= ground || bases_.contains(feature)) return;
    std::int32_t& depth = pierced_[feature];
    depth = std::max(depth, ground - p.z);
    p.z = ground;
  }

  /// Raises segments over level ground, where only heights are kept, and edges to what lies beyond.
  OverlaidLines raised(std::vector<PlacedSegment> segments) {
    for (PlacedSegment& s : segments) {
      stop_if_asked();
      if (s.kind == SegmentClass::foot) continue;
      for (GridPoint* p : {&s.a, &s.b})
        if (const auto ground = ground_at(*p)) lift(*p, *ground, s.feature);
    }
    return {std::move(segments), changed(), std::move(pierced_)};
  }

  /// The lines of all owners; the terrain is the last owner.
  std::vector<OwnedSegment> owned(const std::set<TerrainEdge>& edges) {
    owners_ = SegmentOwners(segments_);
    std::vector<OwnedSegment> result = owners_.owned(segments_);
    for (const CoveredGround& ground : covered_)
      for (const auto& [a, b] : ground.across)
        if (meets_terrain_edge(a, {b.x, b.y})) result.push_back({{a.x, a.y, b.z}, b, owner_of_ways()});
    for (const auto& [v, w] : edges) result.push_back({terrain_.vertex(v), terrain_.vertex(w), owner_of_ways() + 1});
    return result;
  }

  bool meets_terrain_edge(Position a, Position b) const {
    const Segment way{a.x, a.y, b.x, b.y};
    for (const std::uint32_t t : terrain_.triangles_along(a, b)) {
      const Triangle& v = terrain_.triangle(t);
      for (int i = 0; i < 3; ++i) {
        const auto [p, q] = ends_of({v[i], v[(i + 1) % 3]});
        if (crosses(way, p, q)) return true;
      }
    }
    return false;
  }

  /// The owner number of the ways across walls. The terrain has the next number.
  std::uint32_t owner_of_ways() const { return owners_.count(); }

  Position position(std::uint32_t v) const { return {lines_.vertices[v].x, lines_.vertices[v].y}; }

  void classify() {
    is_foot_.resize(lines_.vertices.size());
    base_.resize(lines_.vertices.size());
    on_line_.resize(lines_.vertices.size());
    on_way_.resize(lines_.vertices.size());
    top_.resize(lines_.vertices.size());
    for (std::size_t i = 0; i < lines_.edges.size(); ++i) {
      stop_if_asked();
      if (of_later_owner(lines_.edges, i)) continue;
      const PlanarEdge& e = lines_.edges[i];
      if (e.owner == owner_of_ways()) on_way_[e.from] = on_way_[e.to] = true;
      if (e.owner < owner_of_ways()) {
        const auto& [kind, feature] = owners_[e.owner];
        kept_.push_back({e, kind, feature});
        for (const std::uint32_t v : {e.from, e.to}) {
          on_line_[v] = feature;
          if (kind == SegmentClass::foot) add_foot(v, feature);
        }
        continue;
      }
      if (const auto under = tops_.at_middle(position(e.from), position(e.to))) {
        if (!surfaces_.contains(*under)) continue;
        top_[e.from] = top_[e.to] = under;
        kept_.push_back({e, SegmentClass::roof, covered_[*under].feature});
      } else if (const auto over = footprints_.at_middle(position(e.from), position(e.to))) {
        // The ground under a flat foundation is cut away, or buried.
        if (!covered_[*over].base) kept_.push_back({e, SegmentClass::wall, covered_[*over].feature});
      } else {
        ground_.push_back(e);
      }
    }
  }

  void add_foot(std::uint32_t v, std::uint32_t feature) {
    is_foot_[v] = true;
    const auto base = bases_.find(feature);
    if (base == bases_.end()) return;
    std::optional<std::int32_t>& least = base_[v];
    least = least ? std::min(*least, base->second) : base->second;
  }

  /// Gives every vertex its height.
  void raise() {
    for (std::uint32_t v = 0; v < lines_.vertices.size(); ++v) {
      stop_if_asked();
      GridPoint& p = lines_.vertices[v];
      const auto ground = ground_at(p);
      if (!ground) continue;
      if (is_foot_[v] && base_[v]) {
        p.z = *base_[v];
      } else if (on_way_[v] && !is_foot_[v] && !on_line_[v]) {
        p.z = std::max(p.z, *ground);
      } else if (is_foot_[v] || (!on_line_[v] && !top_[v])) {
        p.z = *ground;
      } else if (const auto drapes = on_line_[v] ? above_.find(*on_line_[v]) : above_.end(); drapes != above_.end()) {
        p.z = *ground_at(p, drapes->second);
      } else if (on_line_[v]) {
        lift(p, *ground, *on_line_[v]);
      } else {
        const auto roof = surfaces_.at(*top_[v])->at({p.x, p.y});
        p.z = roof ? static_cast<std::int32_t>(std::llround(*roof)) : *ground;
        lift(p, *ground, covered_[*top_[v]].feature);
      }
    }
  }

  ChangedGround changed() {
    ChangedGround ground;
    ground.inner = std::move(inner_);
    // Under a roof no edge is to be kept, whoever else changes the ground beyond.
    for (const GridEdge& e : border_) {
      stop_if_asked();
      if (carries_terrain(e))
        ground.border.push_back(e);
      else
        ground.inner.emplace_back(std::minmax(e.first, e.second));
    }
    return ground;
  }

  OverlaidLines collected() {
    OverlaidLines result;
    for (const Kept& k : kept_)
      result.segments.push_back({lines_.vertices[k.edge.from], lines_.vertices[k.edge.to], k.feature, k.kind});
    std::stable_sort(result.segments.begin(), result.segments.end(),
                     [](const PlacedSegment& a, const PlacedSegment& b) { return a.kind < b.kind; });
    result.ground = changed();
    std::set<GridEdge> whole;
    for (const GridEdge& e : border_) whole.insert(std::minmax(e.first, e.second));
    for (const PlanarEdge& e : ground_) {
      const GridEdge edge = std::minmax(position(e.from), position(e.to));
      if (!whole.contains(edge)) result.ground.pieces.push_back(edge);
    }
    result.pierced = std::move(pierced_);
    return result;
  }

  /// Whether the surface has the terrain's triangles on both sides of an edge: on the ground, or raised.
  bool carries_terrain(const GridEdge& e) const {
    if (const auto top = tops_.at_middle(e.first, e.second)) return covered_[*top].above.has_value();
    return !footprints_.at_middle(e.first, e.second);
  }

  struct Kept {
    PlanarEdge edge;
    SegmentClass kind;
    std::uint32_t feature;
  };

  const TerrainHeights& terrain_;
  const std::vector<CoveredGround>& covered_;
  const Progress& progress_;
  Ownership footprints_, tops_;
  std::map<std::uint32_t, double> above_;                          ///< height of what drapes, grid units, by feature
  std::map<std::uint32_t, std::int32_t> bases_;                    ///< height of flat foundations, by feature
  std::map<std::uint32_t, std::unique_ptr<TopSurface>> surfaces_;  ///< by top, where the terrain may pierce it
  std::vector<PlacedSegment> segments_;
  SegmentOwners owners_;
  PlanarLines lines_;
  std::vector<Kept> kept_;
  std::vector<PlanarEdge> ground_;
  std::vector<GridEdge> border_, inner_;               ///< as in ChangedGround
  std::vector<bool> is_foot_;                          ///< by vertex
  std::vector<std::optional<std::int32_t>> base_;      ///< by vertex on a foot: the least of those of flat foundations
  std::vector<std::optional<std::uint32_t>> on_line_;  ///< by vertex: the feature
  std::vector<bool> on_way_;                           ///< by vertex: whether a way across a wall leads there
  std::vector<std::optional<std::uint32_t>> top_;      ///< by vertex of the terrain alone: a pierced top over it
  std::map<std::uint32_t, std::int32_t> pierced_;
};

}  // namespace

OverlaidLines lay_over(const TerrainHeights& terrain, std::vector<PlacedSegment> segments,
                       const std::vector<CoveredGround>& covered, const Progress& progress) {
  return Overlaying(terrain, covered, progress).run(std::move(segments));
}

}  // namespace itin
