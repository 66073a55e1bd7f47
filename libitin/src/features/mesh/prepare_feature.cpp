#include "features/mesh/prepare_feature.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <itin/degrees.hpp>

#include "features/plan/plan_on_grid.hpp"

namespace itin {

namespace {

/// A roof surface that leaves its plane by more is worth a line.
constexpr double kPlaneTolerance = 0.1;

class Preparing {
 public:
  Preparing(const FootprintFeature& source, std::uint32_t number, const FeatureOptions& options,
            const TerrainHeights* terrain)
      : source_(source), options_(options), terrain_(terrain) {
    out_.feature.number = number;
    out_.feature.kind = source.kind;
    out_.feature.roof = source.roof;
    out_.feature.flat_foundation = source.kind == FeatureKind::building && source.flat_foundation;
    out_.feature.measured = source.kind == FeatureKind::building && !source.surfaces.empty();
  }

  Preparation run() {
    try {
      out_.raised = place() && (out_.feature.drapes() ? raise_from_terrain() : found()) && add_surfaces();
    } catch (const OverlayError& error) {
      out_.raised = refuse(error.what());
    }
    return std::move(out_);
  }

 private:
  double units(double metres) const { return metres / options_.grid.resolution; }
  double square_metres(double units) const { return units * options_.grid.resolution * options_.grid.resolution; }
  bool refuse(std::string why) {
    out_.findings.push_back("left out: " + std::move(why));
    return false;
  }

  /// Finds the plan. A measured roof without an outline of its own has the plan of its surfaces.
  bool place() {
    auto plan = plan_on_grid(source_.rings, options_.grid);
    if (!plan) return refuse("has coordinates beyond the grid");
    if (plan->polygons.empty() && !out_.feature.measured) return refuse("has no area");
    if (plan->repaired)
      out_.findings.push_back(fmt::format("crosses or touches itself; taken by the even-odd rule, {:.1f} m²",
                                          square_metres(area(plan->polygons))));
    plan_ = std::move(plan->polygons);
    return true;
  }

  bool raise_from_terrain() {
    const std::optional<double> height = source_.height ? source_.height : source_.eaves;
    if (!height) return refuse("has no height");
    if (!(*height > 0)) return refuse(fmt::format("has a height of {} m", *height));
    if (!terrain_) return refuse("follows the terrain, of which none was given");
    const auto ground = terrain_->base_height(plan_, BaseRule::mean);
    if (!ground) return refuse("lies outside the terrain");
    out_.feature.above_terrain = units(*height);
    add_patch(plan_, {0, 0, units(*ground + *height)});
    return true;
  }

  bool found() {
    if (!out_.feature.measured && !check_heights()) return false;
    std::optional<double> base = source_.base;
    if (!base && !terrain_) return refuse("has no base height, and there is no terrain to take it from");
    if (!base)
      base = terrain_->base_height(plan_.empty() ? plan_of(source_.surfaces, options_.grid) : plan_, source_.base_rule);
    if (!base) return refuse("has no base height and lies outside the terrain");
    RoofHeights& heights = out_.feature.heights;
    heights.base = units(*base);
    heights.slope = std::tan(in_radians(options_.pitch_degrees));
    if (out_.feature.measured) return true;
    if (source_.eaves) heights.eaves = units(*base + *source_.eaves);
    if (source_.height) heights.ridge = units(*base + *source_.height);
    add_patch(plan_, {0, 0, heights.ridge ? *heights.ridge : *heights.eaves});
    return true;
  }

  bool check_heights() {
    const std::optional<double>&height = source_.height, &eaves = source_.eaves;
    if (!height && !eaves) return refuse("has no height");
    for (const auto& h : {height, eaves})
      if (h && !(*h > 0 && *h < 1e4)) return refuse(fmt::format("has a height of {} m", *h));
    if (height && eaves && *eaves > *height)
      return refuse(fmt::format("its eaves at {} m are above its top at {} m", *eaves, *height));
    return true;
  }

  /// The rank is rounded, so that it is the same whatever else of the ground is triangulated: sums may differ in their
  /// last digits.
  void add_patch(GridPolygons plan, const Plane& top) {
    Patch patch{std::move(plan), top, 0};
    const GridBox box = bounds_of(patch.plan);
    const double middle = top.at({(1.0 * box.xmin + box.xmax) / 2, (1.0 * box.ymin + box.ymax) / 2});
    patch.rank = std::round(middle * 1024) / 1024;
    out_.feature.patches.push_back(std::move(patch));
  }

  /// The plane of a ring by Newell's normal; nothing if it is (nearly) upright.
  static std::optional<Plane> plane_of(const std::vector<GridPoint>& ring) {
    double nx = 0, ny = 0, nz = 0, cx = 0, cy = 0, cz = 0;
    const GridPoint& o = ring.front();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const GridPoint &p = ring[i], &q = ring[(i + 1) % ring.size()];
      const double px = 1.0 * p.x - o.x, py = 1.0 * p.y - o.y, pz = 1.0 * p.z - o.z;
      const double qx = 1.0 * q.x - o.x, qy = 1.0 * q.y - o.y, qz = 1.0 * q.z - o.z;
      nx += py * qz - pz * qy, ny += pz * qx - px * qz, nz += px * qy - py * qx;
      cx += px, cy += py, cz += pz;
    }
    if (std::hypot(nx, ny) > kSteepestRoof * std::abs(nz)) return std::nullopt;
    const double n = static_cast<double>(ring.size()), sx = -nx / nz, sy = -ny / nz;
    return Plane{sx, sy, o.z + cz / n - sx * (o.x + cx / n) - sy * (o.y + cy / n)};
  }

  bool add_surfaces() {
    if (!out_.feature.measured) return true;
    int upright = 0;
    double worst = 0;
    for (const RoofSurface& surface : source_.surfaces) {
      const auto plan = plan_on_grid(surface.rings, options_.grid);
      if (!plan) return refuse("has coordinates beyond the grid");
      std::vector<GridPoint> ring;
      for (const Point3& p : surface.rings.front()) ring.push_back(options_.grid.quantise(p));
      const auto plane = ring.size() < 3 ? std::nullopt : plane_of(ring);
      if (!plane || plan->polygons.empty()) {
        ++upright;
        continue;
      }
      for (const GridPoint& p : ring) worst = std::max(worst, std::abs(plane->at({1.0 * p.x, 1.0 * p.y}) - p.z));
      add_patch(plan->polygons, *plane);
    }
    if (out_.feature.patches.empty()) return refuse("none of its roof surfaces has an area in plan");
    if (upright > 0)
      out_.findings.push_back(fmt::format("{} of its roof surfaces stand upright and were passed over", upright));
    if (worst * options_.grid.resolution > kPlaneTolerance)
      out_.findings.push_back(
          fmt::format("a roof surface is not plane: {:.2f} m off", worst * options_.grid.resolution));
    return true;
  }

  const FootprintFeature& source_;
  const FeatureOptions& options_;
  const TerrainHeights* terrain_;
  GridPolygons plan_;
  Preparation out_;
};

}  // namespace

Preparation prepare(const FootprintFeature& feature, std::uint32_t number, const FeatureOptions& options,
                    const TerrainHeights* terrain) {
  return Preparing(feature, number, options, terrain).run();
}

}  // namespace itin
