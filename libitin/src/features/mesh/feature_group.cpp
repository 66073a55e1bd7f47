#include "features/mesh/feature_group.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "features/mesh/eaves_abreast.hpp"
#include "features/mesh/entangled.hpp"
#include "features/mesh/segment_owners.hpp"
#include "features/mesh/terrain_overlay.hpp"
#include "features/plan/planarity.hpp"

namespace itin {

namespace {

constexpr std::size_t kOften = 1 << 12;  // edges between two looks at cancellation

std::int32_t whole(double z) {
  return static_cast<std::int32_t>(std::llround(z));
}

GridEdge edge_in_plan(const PlacedSegment& s) {
  return {{s.a.x, s.a.y}, {s.b.x, s.b.y}};
}

/// One attempt at a group. A feature that cannot stand is found on the way, and the group is built again without it,
/// for its neighbours' walls and feet depend on it.
class GroupBuilder {
 public:
  GroupBuilder(const std::vector<PreparedFeature>& features, double offset, const TerrainHeights* terrain,
               const Progress& progress)
      : features_(features), offset_(offset), terrain_(terrain), progress_(progress) {}

  /// The features that cannot stand, by their index here, and why; none if the attempt succeeded.
  std::map<std::uint32_t, std::string> run() {
    std::vector<Patch> patches;
    for (std::uint32_t f = 0; f < features_.size(); ++f) {
      for (const Patch& patch : features_[f].patches) {
        patches.push_back(patch);
        feature_of_.push_back(f);
      }
    }
    objections_ = entangled(patches, feature_of_);
    if (!objections_.empty()) return objections_;
    arrangement_ = arrange(patches, offset_, &progress_);
    refuse_what_has_no_top();
    if (!objections_.empty()) return objections_;
    add_feet();
    if (!objections_.empty()) return objections_;
    add_masks();
    add_tops(patches);
    if (!objections_.empty()) return objections_;
    ensure_planar();
    if (terrain_) lay_on_terrain();
    return objections_;
  }

  GroupMesh& mesh() { return mesh_; }

 private:
  const PreparedFeature& feature_of(std::size_t patch) const { return features_[feature_of_[patch]]; }
  void report(std::uint32_t f, std::string text) { mesh_.findings.push_back({features_[f].number, std::move(text)}); }

  void refuse_what_has_no_top() {
    std::vector<bool> has_ground(features_.size(), false), has_top(features_.size(), false);
    for (std::size_t i = 0; i < arrangement_.patches.size(); ++i) {
      if (!arrangement_.patches[i].footprint.empty()) has_ground[feature_of_[i]] = true;
      if (!arrangement_.patches[i].top.empty()) has_top[feature_of_[i]] = true;
    }
    for (std::uint32_t f = 0; f < features_.size(); ++f) {
      if (!has_ground[f]) objections_[f] = "left out: lies wholly under others that are as high or higher";
    }
    // Features without a top are judged only after those without ground have gone.
    if (!objections_.empty()) return;
    for (std::uint32_t f = 0; f < features_.size(); ++f)
      if (!has_top[f]) objections_[f] = "left out: nowhere as wide as twice the wall offset";
    for (std::size_t i = 0; i < arrangement_.patches.size(); ++i) {
      const std::string& failure = arrangement_.patches[i].failure;
      if (!failure.empty()) objections_[feature_of_[i]] = "left out: its walls cannot be placed: " + failure;
    }
  }

  void add_masks() {
    std::vector<double> kept(features_.size(), 0), asked(features_.size(), 0);
    for (std::size_t i = 0; i < arrangement_.patches.size(); ++i) {
      for (GridPolygon& polygon : arrangement_.patches[i].footprint) {
        kept[feature_of_[i]] += area(polygon);
        mesh_.masks.push_back({feature_of(i).number, along_feet(polygon)});
      }
    }
    for (std::size_t i = 0; i < feature_of_.size(); ++i) asked[feature_of_[i]] += area(feature_of(i).patches[0].plan);
    for (std::uint32_t f = 0; f < features_.size(); ++f) {
      // Parts of measured roofs overlap by nature.
      if (!features_[f].measured && kept[f] < 0.99 * asked[f])
        report(f, fmt::format("loses {:.1f} % of its footprint to higher features that overlap it",
                              100 * (1 - kept[f] / asked[f])));
    }
  }

  /// Returns the polygon with the vertices that feet have where they cross the terrain's edges: rounded, these lie off
  /// the straight line.
  GridPolygon along_feet(const GridPolygon& polygon) const {
    const auto with_feet = [&](const GridRing& ring) {
      GridRing way;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        way.push_back(ring[i]);
        const auto foot = between_.find({ring[i], ring[(i + 1) % ring.size()]});
        if (foot != between_.end()) way.insert(way.end(), foot->second.begin(), foot->second.end());
      }
      return way;
    };
    GridPolygon result{with_feet(polygon.outline), {}};
    for (const GridRing& hole : polygon.holes) result.holes.push_back(with_feet(hole));
    return result;
  }

  std::optional<double> foot_height(const PreparedFeature& feature, Position p) const {
    if (!terrain_ || feature.flat_foundation) return feature.heights.base;
    const auto z = terrain_->height_at(p);
    return z ? std::optional(*z / terrain_->grid().resolution) : std::nullopt;
  }

  bool ground_is_level() const {
    if (!terrain_) return false;
    GridBox box;
    for (const ArrangedPatch& patch : arrangement_.patches) box.extend(bounds_of(patch.footprint));
    return terrain_->level_about(box);
  }

  void add_feet() {
    std::map<Position, std::int32_t> heights;
    std::vector<std::pair<GridEdge, std::uint32_t>> pieces;
    const bool level = ground_is_level();
    std::size_t done = 0;
    for (const auto& [edge, patch] : arrangement_.feet) {
      if (++done % kOften == 0) progress_.throw_if_cancelled();
      const std::uint32_t f = feature_of_[patch];
      std::vector<Position> way{edge.first};
      if (terrain_ && !level) {
        const std::vector<Position>& between = between_[edge] = terrain_->crossings(edge.first, edge.second);
        way.insert(way.end(), between.begin(), between.end());
      }
      way.push_back(edge.second);
      for (const Position& p : way) {
        const auto z = foot_height(features_[f], p);
        if (!z) {
          objections_[f] = "left out: reaches beyond the terrain";
          return;
        }
        // Where features touch, the wall reaches down to the lower base.
        const auto [at, first] = heights.emplace(p, whole(*z));
        if (!first) at->second = std::min(at->second, whole(*z));
      }
      for (std::size_t i = 1; i < way.size(); ++i) pieces.push_back({{way[i - 1], way[i]}, f});
    }
    for (const auto& [edge, f] : pieces) {
      const auto& [a, b] = edge;
      mesh_.segments.push_back(
          {{a.x, a.y, heights.at(a)}, {b.x, b.y, heights.at(b)}, features_[f].number, SegmentClass::foot});
    }
  }

  void add_tops(const std::vector<Patch>& patches) {
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const std::uint32_t f = feature_of_[i];
      std::vector<RoofLine> lines;
      for (const GridPolygon& plan : arrangement_.patches[i].top) {
        if (features_[f].drapes()) {
          if (!drape(plan, features_[f].above_terrain, *terrain_, lines, mesh_.loose, progress_))
            objections_[f] = "left out: reaches beyond the terrain";
        } else if (features_[f].measured) {
          add(plane_roof(plan, patches[i].top), lines);
        } else {
          add(roof(f, plan), lines);
        }
      }
      split_abreast(lines, std::move(arrangement_.patches[i].leaps), offset_);
      across_.push_back(ways_across(lines, std::move(arrangement_.patches[i].joints), offset_));
      for (const RoofLine& line : lines) {
        mesh_.segments.push_back(
            {line.a, line.b, features_[f].number, line.eaves ? SegmentClass::eaves : SegmentClass::roof});
      }
    }
  }

  static void add(const std::vector<RoofLine>& some, std::vector<RoofLine>& lines) {
    lines.insert(lines.end(), some.begin(), some.end());
  }

  static std::vector<RoofLine> plane_roof(const GridPolygon& plan, const Plane& plane) {
    std::vector<RoofLine> lines;
    const auto point = [&](Position p) { return GridPoint{p.x, p.y, whole(plane.at({1.0 * p.x, 1.0 * p.y}))}; };
    for_each_edge(plan, [&](Position a, Position b) { lines.push_back({point(a), point(b), true}); });
    return lines;
  }

  std::vector<RoofLine> roof(std::uint32_t f, const GridPolygon& plan) {
    RoofLines made = make_roof(features_[f].roof, plan, features_[f].heights);
    if (!made.fallback.empty() && flat_.insert(f).second) {
      ++mesh_.flat_instead;
      report(f, "has a flat roof instead: " + made.fallback);
    }
    return std::move(made.lines);
  }

  /// Keeps the promise of planarity, which construction keeps in all but the narrowest places.
  void ensure_planar() {
    std::vector<GridEdge> edges;
    for (const PlacedSegment& s : mesh_.segments) edges.push_back(edge_in_plan(s));
    const auto found = conflicts(edges);
    if (found.empty()) return;
    std::set<std::uint32_t> involved;
    for (const auto& [s, t] : found) involved.insert({mesh_.segments[s].feature, mesh_.segments[t].feature});
    for (const std::uint32_t number : involved)
      mesh_.findings.push_back({number, "lines closer than the grid can tell apart were joined"});
    snap();
  }

  void snap() {
    const SegmentOwners owners(mesh_.segments);
    const PlanarLines planar = make_planar(owners.owned(mesh_.segments), &progress_);
    mesh_.segments.clear();
    for (std::size_t i = 0; i < planar.edges.size(); ++i) {
      if (of_later_owner(planar.edges, i)) continue;
      const PlanarEdge& e = planar.edges[i];
      const auto& [kind, feature] = owners[e.owner];
      mesh_.segments.push_back({planar.vertices[e.from], planar.vertices[e.to], feature, kind});
    }
  }

  void lay_on_terrain() {
    std::vector<CoveredGround> covered;
    std::map<std::uint32_t, std::uint32_t> by_number;
    for (std::uint32_t f = 0; f < features_.size(); ++f) by_number[features_[f].number] = f;
    for (std::size_t i = 0; i < arrangement_.patches.size(); ++i) {
      ArrangedPatch& patch = arrangement_.patches[i];
      const PreparedFeature& f = feature_of(i);
      covered.push_back({f.number, f.drapes() ? std::optional(f.above_terrain) : std::nullopt,
                         f.flat_foundation ? std::optional(whole(f.heights.base)) : std::nullopt,
                         std::move(patch.footprint), std::move(patch.top), std::move(across_[i])});
    }
    OverlaidLines laid = lay_over(*terrain_, std::move(mesh_.segments), covered, progress_);
    mesh_.segments = std::move(laid.segments);
    mesh_.ground = std::move(laid.ground);
    for (const auto& [number, depth] : laid.pierced) {
      // Less is rounding.
      if (depth > 2)
        report(by_number.at(number), fmt::format("lies up to {:.2f} m below the terrain, which it follows there",
                                                 depth * terrain_->grid().resolution));
    }
  }

  const std::vector<PreparedFeature>& features_;
  const double offset_;
  const TerrainHeights* terrain_;
  const Progress& progress_;
  std::vector<std::uint32_t> feature_of_;  ///< by patch
  Arrangement arrangement_;
  std::map<GridEdge, std::vector<Position>> between_;  ///< where feet cross the terrain's edges, by foot
  std::vector<std::vector<WayAcross>> across_;         ///< by patch
  std::map<std::uint32_t, std::string> objections_;
  std::set<std::uint32_t> flat_;
  GroupMesh mesh_;
};

/// Runs the builder; where GEOS cannot handle the group as a whole, all its features object.
std::map<std::uint32_t, std::string> attempt(GroupBuilder& builder, std::size_t count) {
  try {
    return builder.run();
  } catch (const OverlayError& error) {
    std::map<std::uint32_t, std::string> objections;
    for (std::uint32_t f = 0; f < count; ++f)
      objections[f] = std::string("left out with its neighbours: ") + error.what();
    return objections;
  }
}

}  // namespace

GroupMesh build_group(std::vector<PreparedFeature> features, double offset, const TerrainHeights* terrain,
                      const Progress& progress) {
  std::vector<FeatureFinding> refusals;
  std::vector<std::uint32_t> refused;
  for (;;) {
    progress.throw_if_cancelled();
    GroupBuilder builder(features, offset, terrain, progress);
    const std::map<std::uint32_t, std::string> objections = attempt(builder, features.size());
    if (objections.empty()) {
      GroupMesh mesh = std::move(builder.mesh());
      mesh.findings.insert(mesh.findings.end(), refusals.begin(), refusals.end());
      mesh.refused = std::move(refused);
      return mesh;
    }
    std::vector<PreparedFeature> kept;
    for (std::uint32_t f = 0; f < features.size(); ++f) {
      const auto objection = objections.find(f);
      if (objection == objections.end()) {
        kept.push_back(std::move(features[f]));
      } else {
        refusals.push_back({features[f].number, objection->second});
        refused.push_back(features[f].number);
      }
    }
    features = std::move(kept);
  }
}

}  // namespace itin
