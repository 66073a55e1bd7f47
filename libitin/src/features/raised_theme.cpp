#include "features/raised_theme.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>

#include "base/disjoint_sets.hpp"
#include "base/stoppable.hpp"
#include "features/cell_features.hpp"
#include "features/ground_coverage.hpp"
#include "features/mesh/feature_mesh.hpp"
#include "features/mesh/footprint_arrangement.hpp"
#include "features/mesh/foundation_reaches.hpp"
#include "features/mesh/terrain_heights.hpp"
#include "features/plan/mask_index.hpp"
#include "geometry/cell.hpp"
#include "store/points_of_leaves.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {

namespace {

/// The side, in metres, of the pieces of ground that are triangulated at once.
constexpr double kPiece = 1000;
/// Bytes per point that the ground's triangulation takes while features are raised on it; measured, rounded up.
constexpr std::uint64_t kBytesPerPoint = 400;
/// The most points of ground that are triangulated at once, for several groups of features.
constexpr std::uint64_t kMostPoints = 500'000;

GridBox box_on_grid(const FootprintFeature& feature, const Grid& grid) {
  GridBox box;
  const auto extend = [&](double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y) || !grid.covers({x, y})) return;
    const GridPoint p = grid.quantise({x, y, 0});
    box.extend(p.x, p.y);
  };
  for (const PlanRing& ring : feature.rings)
    for (const Point2& p : ring) extend(p.x, p.y);
  for (const RoofSurface& surface : feature.surfaces)
    for (const auto& ring : surface.rings)
      for (const Point3& p : ring) extend(p.x, p.y);
  return box;
}

/// A wall that a feature shares with a higher one, whose eaves the wall reaches up to.
struct PartyWall {
  std::uint32_t higher = 0, lower = 0;
  std::int32_t height = 0;  ///< how high the eaves are above the ground, grid units
};

std::vector<PartyWall> party_walls(const FeatureMesh& mesh, const MaskIndex& masks, const TerrainHeights& terrain) {
  const auto above_ground = [&](const GridPoint& p) {
    const auto ground = terrain.height_at({p.x, p.y});
    return ground ? static_cast<std::int32_t>(std::ceil(p.z - *ground / terrain.grid().resolution)) : 0;
  };
  std::vector<PartyWall> walls;
  for (const FeatureSegment& s : mesh.segments) {
    stop_if_asked();
    if (s.kind != SegmentClass::eaves) continue;
    const GridPoint &a = mesh.vertices[s.from], &b = mesh.vertices[s.to];
    const double x = double{1} * b.x - a.x, y = double{1} * b.y - a.y, length = std::hypot(x, y);
    // A place one and a half grid steps beside the middle lies within the wall.
    const auto dx = static_cast<std::int32_t>(std::lround(3 * y / length)),
               dy = static_cast<std::int32_t>(std::lround(-3 * x / length));
    for (const int side : {1, -1}) {
      const auto mask = masks.about_middle({a.x + side * dx, a.y + side * dy}, {b.x, b.y});
      if (mask && mesh.masks[*mask].feature != s.feature)
        walls.push_back({s.feature, mesh.masks[*mask].feature, std::max(above_ground(a), above_ground(b))});
    }
  }
  return walls;
}

class ThemeRaiser {
 public:
  /// `is_patch` has an entry for each footprint, or is empty.
  ThemeRaiser(const Store& ground, std::span<const StoredFootprint> footprints, std::vector<bool> is_patch,
              double wall_offset, std::uint64_t memory_bytes)
      : ground_(ground),
        footprints_(footprints),
        is_patch_(std::move(is_patch)),
        memory_bytes_(memory_bytes),
        grid_(ground.metadata().grid),
        stands_(footprints.size(), false) {
    options_.grid = grid_;
    options_.wall_offset = wall_offset;
    for (const LevelInfo& level : ground.metadata().levels)
      lateral_.push_back(level.lateral_tolerance / grid_.resolution);
  }

  /// Fills `left_out` with places among this object's own footprints.
  RaisedFeatureTheme run(Progress& progress) {
    refuse_what_is_off_the_grid();
    const auto pieces = cut_into_pieces();
    std::size_t done = 0;
    for (const auto& [place, groups] : pieces) {
      progress.report("raising features", static_cast<double>(done++) / static_cast<double>(pieces.size()));
      build(groups, progress);
    }
    for (auto& [level, part] : parts_) {
      std::sort(part.vertices.begin(), part.vertices.end(), before_by_code);
      theme_.parts.push_back(std::move(part));
    }
    report_patches();
    for (std::size_t i = 0; i < stands_.size(); ++i)
      if (!stands_[i]) theme_.left_out.push_back(i);
    return std::move(theme_);
  }

 private:
  using Numbers = std::vector<std::uint32_t>;
  /// Features whose boxes hang together.
  struct Group {
    Numbers numbers;
    GridBox box;
    std::uint64_t points = 0;  ///< how many points of the ground its leaves have
  };
  using Groups = std::vector<Group>;

  /// What lies wholly beyond the grid has swapped axes, say, or no place but 0, 0.
  void refuse_what_is_off_the_grid() {
    for (std::uint32_t i = 0; i < footprints_.size(); ++i) {
      if (!box_on_grid(footprints_[i].feature, grid_).empty()) continue;
      report(i, "left out: reaches beyond the ground");
      ++theme_.refused;
    }
  }

  /// The groups by the piece of ground that they stand on.
  std::map<std::pair<std::int64_t, std::int64_t>, Groups> cut_into_pieces() const {
    std::vector<GridBox> boxes;
    for (const StoredFootprint& f : footprints_) {
      const GridBox box = box_on_grid(f.feature, grid_);
      boxes.push_back(box.empty() ? box : expanded(box, 2));
    }
    const double side = kPiece / grid_.resolution;
    std::map<std::pair<std::int64_t, std::int64_t>, Groups> pieces;
    for (auto& numbers : groups_of(boxes)) {
      const GridBox& first = boxes[numbers.front()];
      if (first.empty()) continue;
      Group group{std::move(numbers), {}};
      for (const std::uint32_t i : group.numbers) group.box.extend(boxes[i]);
      group.points = points_of_leaves(ground_.points(), group.box);
      pieces[{static_cast<std::int64_t>(std::floor(first.xmin / side)),
              static_cast<std::int64_t>(std::floor(first.ymin / side))}]
          .push_back(std::move(group));
    }
    return pieces;
  }

  /// Builds the groups, split in halves as long as there is much ground about several of them, or most of it is between
  /// them.
  void build(Groups groups, const Progress& progress) {
    progress.throw_if_cancelled();
    GridBox box;
    std::uint64_t under = 0;
    for (const Group& group : groups) box.extend(group.box), under += group.points;
    const std::uint64_t points = points_of_leaves(ground_.points(), box);
    if (groups.size() == 1 || points <= std::min(kMostPoints, 2 * under)) {
      require_room(groups, points);
      return build(groups, box, progress);
    }
    const bool wide = box.xmax - box.xmin > box.ymax - box.ymin;
    std::sort(groups.begin(), groups.end(), [&](const Group& a, const Group& b) {
      const auto place = [&](const Group& g) { return std::pair(wide ? g.box.xmin : g.box.ymin, g.numbers.front()); };
      return place(a) < place(b);
    });
    const auto middle = groups.begin() + static_cast<std::ptrdiff_t>(groups.size() / 2);
    build(Groups(groups.begin(), middle), progress);
    build(Groups(middle, groups.end()), progress);
  }

  void require_room(const Groups& groups, std::uint64_t points) const {
    if (points * kBytesPerPoint <= memory_bytes_) return;
    throw InputError(fmt::format(
        "{}: the ground under it and its neighbours has some {} points, for which {} MB of memory are too little; give "
        "more than {} MB, or cut it into parts",
        footprints_[groups.front().numbers.front()].feature.name, points, memory_bytes_ >> 20,
        points * kBytesPerPoint >> 20));
  }

  void build(const Groups& groups, const GridBox& box, const Progress& progress) {
    Numbers numbers;
    for (const Group& group : groups) numbers.insert(numbers.end(), group.numbers.begin(), group.numbers.end());
    std::sort(numbers.begin(), numbers.end());
    std::vector<FootprintFeature> features;
    for (const std::uint32_t i : numbers) features.push_back(footprints_[i].feature);
    SilentProgress quiet(progress);
    const Box window = grid_.box(box);
    const Tin tin = triangulate(ground_, Window::box(window), Detail::tolerance(0), quiet, ThemeChoice::none());
    const TerrainHeights terrain(tin);
    const std::vector<Segment> outline = outline_near(ground_, box);
    FeatureMesh mesh = build_feature_mesh(features, options_, &terrain, quiet);
    std::set<std::uint32_t> left_out;
    // After some features are refused, others may reach over the ground that those had covered.
    for (auto beyond = beyond_ground(mesh, outline, terrain); !beyond.empty();
         beyond = beyond_ground(mesh, outline, terrain)) {
      for (const std::uint32_t f : beyond) {
        report(numbers[f], "left out: reaches beyond the ground");
        features[f].rings.clear();
        features[f].surfaces.clear();
      }
      left_out.merge(beyond);
      mesh = build_feature_mesh(features, options_, &terrain, quiet);
    }
    for (const FeatureFinding& f : mesh.findings)
      if (!left_out.contains(f.feature)) report(numbers[f.feature], f.text);
    theme_.built += mesh.built;
    theme_.refused += mesh.refused;
    add(mesh, terrain, numbers, features);
  }

  void report(std::uint32_t footprint, const std::string& finding) {
    const auto& [feature, source] = footprints_[footprint];
    if (is_patch_.empty() || !is_patch_[footprint]) {
      theme_.reports.push_back({source, fmt::format("{}: {}", feature.name, finding)});
      return;
    }
    const auto [at, fresh] = of_patches_.try_emplace({source, finding}, 0, feature.name);
    ++at->second.first;
  }

  /// Reports each finding of several patches once, for a raster has thousands of patches.
  void report_patches() {
    for (const auto& [found, of] : of_patches_) {
      const auto& [source, finding] = found;
      const auto& [count, first] = of;
      theme_.reports.push_back({source, count == 1
                                            ? fmt::format("{}: {}", first, finding)
                                            : fmt::format("{} and {} other patches: {}", first, count - 1, finding)});
    }
  }

  static std::set<std::uint32_t> beyond_ground(const FeatureMesh& mesh, const std::vector<Segment>& outline,
                                               const TerrainHeights& terrain) {
    std::set<std::uint32_t> beyond;
    for (const FeatureMask& mask : mesh.masks) {
      if (!lies_on_ground(mask.polygon, outline, terrain)) beyond.insert(mask.feature);
    }
    return beyond;
  }

  void add(const FeatureMesh& mesh, const TerrainHeights& terrain, const Numbers& numbers,
           const std::vector<FootprintFeature>& features) {
    theme_.ground.append(mesh.ground);
    std::vector<GridPolygon> masks;
    for (const FeatureMask& mask : mesh.masks) masks.push_back(mask.polygon), stands_[numbers[mask.feature]] = true;
    const MaskIndex index(masks);
    const std::vector<PartyWall> walls = party_walls(mesh, index, terrain);
    const std::vector<Kept> kept = kept_of(mesh, walls, numbers.size());
    std::vector<std::int32_t> top(numbers.size(), std::numeric_limits<std::int32_t>::min());
    std::vector<int> level_of_vertex(mesh.vertices.size(), -1);
    for (const FeatureSegment& s : mesh.segments) {
      stop_if_asked();
      const GridPoint &a = mesh.vertices[s.from], &b = mesh.vertices[s.to];
      top[s.feature] = std::max({top[s.feature], a.z, b.z});
      const auto [level, cluster] = kept[s.feature];
      RaisedPart& part = part_of(level, footprints_[numbers[s.feature]].source);
      part.segments.push_back({a, b, s.kind == SegmentClass::foot, cluster});
      level_of_vertex[s.from] = level_of_vertex[s.to] = level;
    }
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      stop_if_asked();
      const GridPoint& p = mesh.vertices[v];
      if (level_of_vertex[v] < 0) {
        // The vertex has no segments: its feature is the one on whose ground it stands.
        const auto mask = index.at({p.x, p.y});
        if (!mask) continue;
        const std::uint32_t feature = mesh.masks[*mask].feature;
        top[feature] = std::max(top[feature], p.z);
        level_of_vertex[v] = kept[feature].level;
      }
      parts_.at(level_of_vertex[v]).vertices.push_back(p);
    }
    std::vector<std::int32_t> beside(numbers.size(), 0);
    for (const PartyWall& wall : walls) beside[wall.lower] = std::max(beside[wall.lower], wall.height);
    std::vector<std::int32_t> heights(mesh.masks.size());
    parallel_for(mesh.masks.size(), [&](std::size_t m) {
      const auto low = terrain.base_height({mesh.masks[m].polygon}, BaseRule::minimum);
      const std::int32_t ground = low ? static_cast<std::int32_t>(std::floor(*low / grid_.resolution)) : 0;
      heights[m] = std::max(beside[mesh.masks[m].feature], top[mesh.masks[m].feature] - ground);
    });
    const FoundationReaches foundations(mesh, terrain, features);
    for (std::size_t m = 0; m < mesh.masks.size(); ++m) {
      const auto [level, cluster] = kept[mesh.masks[m].feature];
      const auto found = parts_.find(level);
      if (found == parts_.end()) continue;
      const FeatureReach cut = foundations.of(m);
      found->second.reaches.push_back({cut.box, std::max(heights[m], cut.height), cut.depth});
      found->second.masks.push_back(mesh.masks[m].polygon);
      found->second.mask_clusters.push_back(cluster);
    }
  }

  RaisedPart& part_of(int level, std::uint16_t source) {
    const auto [at, fresh] = parts_.try_emplace(level);
    if (fresh) at->second.coarsest = level, at->second.source = source;
    at->second.source = std::min(at->second.source, source);
    return at->second;
  }

  /// The coarsest level of a feature, and its cluster there.
  struct Kept {
    int level = 0;
    std::uint32_t cluster = kNoCluster;
  };

  std::vector<Kept> kept_of(const FeatureMesh& mesh, const std::vector<PartyWall>& walls, std::size_t count) {
    DisjointSets clusters(count);
    for (const PartyWall& wall : walls) clusters.join(wall.higher, wall.lower);
    std::vector<std::uint32_t> first(mesh.vertices.size(), static_cast<std::uint32_t>(count));
    for (const FeatureSegment& s : mesh.segments) {
      for (const std::uint32_t v : {s.from, s.to}) {
        if (first[v] == count) first[v] = s.feature;
        clusters.join(first[v], s.feature);
      }
    }
    std::vector<GridBox> boxes(count);
    for (const FeatureSegment& s : mesh.segments) {
      GridBox& box = boxes[clusters.least(s.feature)];
      for (const std::uint32_t v : {s.from, s.to}) box.extend(mesh.vertices[v].x, mesh.vertices[v].y);
    }
    std::vector<Kept> kept(count);
    for (std::uint32_t f = 0; f < count; ++f) {
      const std::uint32_t own = clusters.least(f);  // the number of its first feature
      kept[f] = own == f ? kept_about(boxes[own]) : kept[own];
    }
    return kept;
  }

  Kept kept_about(const GridBox& box) {
    Kept kept;
    const std::int32_t side = box.empty() ? -1 : std::max(box.xmax - box.xmin, box.ymax - box.ymin);
    const int levels = static_cast<int>(lateral_.size());
    for (int k = 0; k < levels && lateral_[static_cast<std::size_t>(k)] <= side; ++k) kept.level = k;
    if (kept.level + 1 < levels) kept.cluster = clusters_[kept.level]++;
    return kept;
  }

  const Store& ground_;
  std::span<const StoredFootprint> footprints_;
  std::vector<bool> is_patch_;
  /// Findings of patches by source and text, each with the number of patches that it is about and the first one's name.
  std::map<std::pair<std::uint16_t, std::string>, std::pair<std::uint64_t, std::string>> of_patches_;
  std::uint64_t memory_bytes_;
  Grid grid_;
  FeatureOptions options_;
  std::vector<double> lateral_;
  std::map<int, RaisedPart> parts_;
  std::map<int, std::uint32_t> clusters_;  ///< how many there are so far, by level
  std::vector<bool> stands_;               ///< by footprint
  RaisedFeatureTheme theme_;
};

/// Returns which of `footprints` the places among `made.footprints` are, without those of patches.
std::vector<std::size_t> places_among(std::span<const StoredFootprint> footprints, const CellFeatures& made,
                                      const std::vector<std::size_t>& places) {
  std::vector<std::size_t> given;
  for (std::size_t i = 0; i < footprints.size(); ++i)
    if (!footprints[i].feature.cells) given.push_back(i);
  std::vector<std::size_t> found;
  std::size_t at = 0, vectors = 0;  // among all that were made, and those of these that are no patches
  for (const std::size_t place : places) {
    for (; at < place; ++at) vectors += made.is_patch[at] ? 0 : 1;
    if (!made.is_patch[place]) found.push_back(given[vectors]);
  }
  return found;
}

}  // namespace

double default_wall_offset(const Grid& grid) {
  return std::max(0.05, 2 * grid.resolution);
}

RaisedFeatureTheme raise_theme(const Store& ground, std::span<const StoredFootprint> footprints, double wall_offset,
                               std::uint64_t memory_bytes, Progress& progress) {
  CellFeatures made = with_patches(ground, footprints, memory_bytes, progress);
  RaisedFeatureTheme theme =
      ThemeRaiser(ground, made.any ? std::span<const StoredFootprint>(made.footprints) : footprints, made.is_patch,
                  wall_offset, memory_bytes)
          .run(progress);
  if (made.any) theme.left_out = places_among(footprints, made, theme.left_out);
  theme.reports.insert(theme.reports.begin(), made.reports.begin(), made.reports.end());
  return theme;
}

}  // namespace itin
