#include "features/mesh/feature_mesh.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>

#include "base/stoppable.hpp"
#include "features/mesh/feature_group.hpp"
#include "features/mesh/prepare_feature.hpp"
#include "features/mesh/united_parts.hpp"
#include "geometry/cell.hpp"

namespace itin {

namespace {

void check(const FeatureOptions& options, const TerrainHeights* terrain) {
  require_wall_offset(options.wall_offset, options.grid);
  if (!(options.pitch_degrees > 0 && options.pitch_degrees < 80))
    throw InputError(
        fmt::format("a roof pitch of {} degrees: above 0 and below 80 is possible", options.pitch_degrees));
  if (terrain && terrain->grid() != options.grid) throw InputError("features and terrain are on different grids");
}

/// Puts the meshes of all groups together.
class Assembly {
 public:
  explicit Assembly(const Grid& grid) { mesh_.grid = grid; }

  void add(const GroupMesh& group) {
    // Feet come first in every group: where lines were joined their heights count.
    for (const PlacedSegment& s : group.segments) segments_.push_back(s);
    for (const PlacedSegment& s : group.segments) points_.insert(points_.end(), {s.a, s.b});
    points_.insert(points_.end(), group.loose.begin(), group.loose.end());
    mesh_.masks.insert(mesh_.masks.end(), group.masks.begin(), group.masks.end());
    mesh_.ground.append(group.ground);
    mesh_.flat_instead += group.flat_instead;
  }

  FeatureMesh finish() && {
    std::stable_sort(points_.begin(), points_.end(), before_by_code);
    points_.erase(std::unique(points_.begin(), points_.end(),
                              [](const GridPoint& a, const GridPoint& b) { return same_position(a, b); }),
                  points_.end());
    const auto number = [&](const GridPoint& p) {
      return static_cast<std::uint32_t>(find_by_code(points_, code_of(p)) - points_.begin());
    };
    for (const PlacedSegment& s : segments_) {
      stop_if_asked();
      mesh_.segments.push_back({number(s.a), number(s.b), s.feature, s.kind});
    }
    mesh_.vertices = std::move(points_);
    return std::move(mesh_);
  }

 private:
  FeatureMesh mesh_;
  std::vector<PlacedSegment> segments_;
  std::vector<GridPoint> points_;
};

GridBox box_of_prepared(const PreparedFeature& feature) {
  GridBox box;
  for (const Patch& patch : feature.patches) box.extend(bounds_of(patch.plan));
  return box;
}

}  // namespace

void require_wall_offset(double metres, const Grid& grid) {
  constexpr double kGreatest = 10;
  const double least = 2 * grid.resolution;
  if (metres >= least && metres <= kGreatest) return;
  throw InputError(fmt::format("`wall_offset`: {} m; from {} m (two steps of the grid) to {} m is possible", metres,
                               least, kGreatest),
                   "wall_offset");
}

FeatureMesh build_feature_mesh(std::span<const FootprintFeature> features, const FeatureOptions& options,
                               const TerrainHeights* terrain, Progress& progress) {
  check(options, terrain);
  const Stoppable stoppable(progress);
  std::vector<Preparation> prepared(features.size());
  parallel_for(features.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    prepared[i] = prepare(features[i], static_cast<std::uint32_t>(i), options, terrain);
  });
  std::vector<GridBox> boxes;
  for (const Preparation& p : prepared) boxes.push_back(p.raised ? box_of_prepared(p.feature) : GridBox{});
  const auto groups = groups_of(boxes);
  std::vector<GroupMesh> meshes(groups.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(groups.size(), [&](std::size_t g) {
    progress.throw_if_cancelled();
    std::vector<PreparedFeature> members;
    for (const std::uint32_t i : groups[g])
      if (prepared[i].raised) members.push_back(std::move(prepared[i].feature));
    if (!members.empty())
      meshes[g] = build_group(std::move(members), options.wall_offset / options.grid.resolution, terrain, progress);
    progress.report("features", static_cast<double>(++done) / static_cast<double>(groups.size()));
  });
  Assembly assembly(options.grid);
  std::vector<FeatureFinding> findings;
  std::uint64_t refused = 0;
  for (std::uint32_t i = 0; i < features.size(); ++i) {
    for (std::string& text : prepared[i].findings) findings.push_back({i, std::move(text)});
    refused += prepared[i].raised ? 0 : 1;
  }
  for (const GroupMesh& mesh : meshes) {
    assembly.add(mesh);
    refused += mesh.refused.size();
    findings.insert(findings.end(), mesh.findings.begin(), mesh.findings.end());
  }
  FeatureMesh mesh = std::move(assembly).finish();
  std::stable_sort(findings.begin(), findings.end(),
                   [](const FeatureFinding& a, const FeatureFinding& b) { return a.feature < b.feature; });
  mesh.findings = std::move(findings);
  mesh.refused = refused;
  mesh.built = features.size() - refused;
  return mesh;
}

std::vector<PlanRing> band_about(const PlanRing& line, double thickness, const Grid& grid) {
  std::vector<Position> positions;
  for (const Point2& p : line) {
    if (!grid.covers(p)) throw InputError(fmt::format("a line leaves the grid at {}, {}", p.x, p.y));
    const GridPoint q = grid.quantise({p.x, p.y, 0});
    positions.push_back({q.x, q.y});
  }
  return rings_in_metres(thickened(positions, thickness / grid.resolution), grid);
}

}  // namespace itin
