#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>

#include <itin/azimuth.hpp>
#include <itin/call_progress.hpp>
#include <itin/cross_section.hpp>
#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/grid_units.hpp>
#include <itin/level_choice.hpp>
#include <itin/parallel.hpp>
#include <itin/silent_progress.hpp>
#include <itin/tin_heights.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/horizon.hpp>
#include <viewshed/surface.hpp>

#include "horizon/panorama.hpp"
#include "modes/lines/first_blocker.hpp"
#include "plan/ground_runs.hpp"
#include "plan/ground_tiles.hpp"
#include "plan/memory.hpp"
#include "progress/stage.hpp"
#include "request/eye.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "run/segments.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

using Heights = std::vector<std::optional<double>>;

/// Finding the highest point in a direction takes about as long as this many lines.
constexpr double kSkyOfLines = 20;

/// Sections over missing ground may keep this part of the memory.
constexpr std::uint64_t kPartForSections = 8;

/// How far to look, metres: the request's radius, or as far as there is data.
double greatest_reach(const Request& request, const Box& data) {
  const Observer& observer = request.observers.front();
  const Point2 p = observer.position;
  if (const auto radius = radius_of(request, observer)) return *radius;
  return std::hypot(std::max(p.x - data.xmin, data.xmax - p.x), std::max(p.y - data.ymin, data.ymax - p.y)) + 1;
}

/// A direction to look in: to the sky, or at a target.
struct Direction {
  double clockwise = 0;  ///< degrees from the first
  std::size_t index = 0;
  bool target = false;
};
using Directions = std::span<const Direction>;

/// A horizon that is being computed, one run of consecutive directions after another.
class Survey {
 public:
  /// `ground` has the heights of what is below the targets, metres. Request and eye must outlive this object.
  Survey(const Request& request, const HorizonOptions& options, const Grid& grid, const Eye& eye, double reach,
         const Heights& ground)
      : request_(request), grid_(grid), eye_(eye), reach_(reach) {
    const auto& azimuths = request.observers.front().azimuth ? request.observers.front().azimuth : request.azimuth;
    start_ = azimuths ? azimuths->from : 0;
    result_.eye_elevation_m = eye.elevation;
    add_points(static_cast<std::size_t>(std::lround(360 / options.step_deg)));
    for (std::size_t i = 0; i < options.targets.size(); ++i) add_target(options.targets[i], ground[i]);
    std::stable_sort(directions_.begin(), directions_.end(),
                     [](const Direction& a, const Direction& b) { return a.clockwise < b.clockwise; });
  }

  /// All directions, clockwise.
  Directions directions() const { return directions_; }
  /// The place where the line in a direction ends.
  Point2 end_of(const Direction& direction) const {
    if (direction.target) return result_.targets[direction.index].target.position;
    const double azimuth = in_radians(result_.points[direction.index].azimuth_deg);
    return {eye_.position.x + reach_ * std::sin(azimuth), eye_.position.y + reach_ * std::cos(azimuth)};
  }

  /// Casts the lines in these directions over the surface under all of them.
  void cast(const Tin& surface, Directions directions, Progress& progress) {
    const auto pyramid = std::make_shared<const HeightPyramid>(surface, progress);
    const Panorama panorama(pyramid, request_.earth, eye_, reach_);
    const FirstBlocker blockers(pyramid, request_.earth);
    for_each_step(directions.size(), "horizon", progress, [&](std::size_t i) {
      const Direction& d = directions[i];
      if (d.target) {
        const Point3 to = units_of(result_.targets[d.index]);
        const bool visible = eye_.stands_at({to.x, to.y}) || !blockers.find(eye_.units, to);
        result_.targets[d.index].verdict = visible ? Verdict::kVisible : Verdict::kHidden;
      } else {
        result_.points[d.index].sky = panorama.sky(result_.points[d.index].azimuth_deg);
      }
    });
  }

  Horizon result() && { return std::move(result_); }

 private:
  void add_points(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double degrees = 360.0 * static_cast<double>(i) / static_cast<double>(count);
      const double azimuth = std::fmod(start_ + degrees + 360, 360);
      if (!eye_.view.faces(azimuth)) continue;
      directions_.push_back({degrees, result_.points.size(), false});
      result_.points.push_back({azimuth, std::nullopt});
    }
  }

  [[noreturn]] static void refuse(const HorizonTarget& target, const std::string& reason) {
    throw InputError(fmt::format("{}{}target {} at {:.10g},{:.10g}: {}", target.source,
                                 target.source.empty() ? "" : ": ", target.name, target.position.x, target.position.y,
                                 reason));
  }

  void add_target(const HorizonTarget& target, std::optional<double> ground) {
    const Point2& p = target.position;
    const double distance = std::hypot(p.x - eye_.position.x, p.y - eye_.position.y);
    if (distance > reach_)
      refuse(target,
             fmt::format("it is {:.1f} m away, beyond the `radius` of {:.10g} m: give a greater one, or leave it out",
                         distance, reach_));
    if (!ground) refuse(target, "there is no ground data; move it onto the data, or leave it out");
    SightedTarget& sighted = result_.targets.emplace_back(SightedTarget{target});
    sighted.elevation_m = target.absolute ? target.height : *ground + target.height;
    const Point3 to = units_of(sighted);
    const auto [dx, dy] = eye_.offset_to(p, {to.x, to.y});
    sighted.distance_m = std::hypot(dx, dy);
    sighted.azimuth_deg = within_turn(in_degrees(std::atan2(dx, dy)));
    sighted.elevation_deg = eye_.view.elevation(dx, dy, sighted.elevation_m - eye_.elevation);
    directions_.push_back({within_turn(sighted.azimuth_deg - start_), result_.targets.size() - 1, true});
  }

  Point3 units_of(const SightedTarget& target) const {
    const Point2 place = place_in_units(grid_, target.target.position);
    return {place.x, place.y, target.elevation_m / grid_.resolution};
  }

  const Request& request_;
  Grid grid_;
  const Eye& eye_;
  double reach_;      ///< metres
  double start_ = 0;  ///< azimuth of the first direction, degrees
  Horizon result_;
  std::vector<Direction> directions_;
};

void require_valid(const Request& request, const HorizonOptions& options) {
  validate(request);
  require_whole_turn(options.step_deg);
  if (request.observers.size() != 1) throw InputError("a horizon is of one observer: give one", "observers");
}

std::vector<Point2> positions_of(const std::vector<HorizonTarget>& targets) {
  std::vector<Point2> positions;
  for (const HorizonTarget& target : targets) positions.push_back(target.position);
  return positions;
}

/// How many points of a surface the memory holds, with what finds the highest triangles and what hides targets.
std::uint64_t points_within(std::uint64_t memory, const Store& store, const Request& request) {
  constexpr std::uint64_t kPyramids = 80;
  return memory_beside_rasters(memory, store, request) / (kBytesPerSurfacePoint + kPyramids);
}

/// Corrects the horizon for ground that is missing along the lines from the eye.
void heed_missing_ground(const Store& store, const Request& request, const ComputeOptions& options, Horizon& horizon) {
  if (request.nodata == NoData::kClear) return;
  const SectionSurface surface(store, request.detail, request.themes, {options.memory_bytes / kPartForSections});
  const Point2 eye = request.observers.front().position;
  parallel_for(horizon.points.size(), [&](std::size_t i) {
    HorizonPoint& p = horizon.points[i];
    if (!p.sky) return;
    const CrossSection section = surface.between(eye, {p.sky->position.x, p.sky->position.y});
    // A gap that goes on to the end is what rounding leaves of a point on the data's edge.
    p.over_missing = std::any_of(section.gaps.begin(), section.gaps.end(),
                                 [&](const SectionGap& gap) { return gap.to < section.length; });
  });
  for (SightedTarget& t : horizon.targets) {
    if (t.verdict == Verdict::kVisible && !surface.between(eye, t.target.position).gaps.empty())
      t.verdict = request.nodata == NoData::kBlock ? Verdict::kHidden : Verdict::kUndecided;
  }
}

}  // namespace

void require_whole_turn(double step) {
  if (!(step >= 0.001 && step <= 90) || std::abs(std::round(360 / step) * step - 360) > 1e-6)
    throw InputError(fmt::format(
        "a step of {:g} degrees: give one from 0.001 to 90 that divides 360, for instance 0.1 or 15", step));
}

Horizon horizon(const Tin& surface, const Tin& ground, const Request& request, const HorizonOptions& options,
                Progress& progress) {
  require_valid(request, options);
  const Observer& observer = request.observers.front();
  const Eye eye = eye_of(surface.grid, request, observer,
                         height_on(request.observers_on_surface ? surface : ground, observer.position));
  Heights below;
  for (const Point2& target : positions_of(options.targets))
    below.push_back(height_on(request.targets_on_surface ? surface : ground, target));
  Survey survey(request, options, surface.grid, eye, greatest_reach(request, surface.bounds()), below);
  survey.cast(surface, survey.directions(), progress);
  return std::move(survey).result();
}

Horizon horizon(const Store& store, const Request& request, const HorizonOptions& options,
                const ComputeOptions& compute_options, Progress& progress) {
  require_valid(request, options);
  SilentProgress quiet(progress);
  std::vector<double> heights;
  const Eye eye = eyes_on_surface(store, request, request.detail, heights, quiet).front();
  const Heights below = heights_at(store, positions_of(options.targets), request.detail,
                                   request.targets_on_surface ? request.themes : ThemeChoice::none(), quiet);
  Survey survey(request, options, store.metadata().grid, eye, greatest_reach(request, extent_of(store)), below);
  const std::uint64_t most = points_within(compute_options.memory_bytes, store, request);
  const GroundTiles ground(store, level_within(store.metadata(), request.detail.finest()),
                           box_of_window(store, request));
  std::vector<std::size_t> all(survey.directions().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto needed = [&](std::size_t direction) {
    TileSet tiles(ground.count());
    ground.add_line(eye.position, survey.end_of(survey.directions()[direction]), tiles);
    return tiles;
  };
  const auto runs =
      ground_runs(all, ground.count(), needed, [&](const TileSet& tiles) { return ground.points(tiles) <= most; });
  const auto effort = [&](const GroundRun& run) {
    return Effort{effort_of_triangles(ground.points(run.ground)),
                  kSkyOfLines * effort_of_lines(static_cast<double>(run.pieces.size()))};
  };
  for_each_segment(runs, effort, progress, [&](const GroundRun& run, SegmentProgress& of_run) {
    const Tin surface = triangulate(store, ground.window(run.ground), request.detail, of_run.reading(), request.themes);
    survey.cast(surface, survey.directions().subspan(run.pieces.front(), run.pieces.size()), of_run.judging());
  });
  Horizon result = std::move(survey).result();
  heed_missing_ground(store, request, compute_options, result);
  return result;
}

Horizon horizon(const Store& store, ViewshedWithSurface& computed, const Request& request,
                const HorizonOptions& options, const ComputeOptions& compute_options, Progress& progress) {
  const bool held = computed.whole &&
                    (!computed.surface->lattice || points_about(store, request.detail, box_of_window(store, request)) <=
                                                       points_within(compute_options.memory_bytes, store, request));
  if (!held) return horizon(store, request, options, compute_options, progress);
  CallProgress call(progress);
  const Tin& surface = computed.surface->listed(call.step(0.5));
  Horizon result = horizon(surface, computed.ground ? *computed.ground : surface, request, options, call.step(1));
  heed_missing_ground(store, request, compute_options, result);
  return result;
}

}  // namespace itin::viewshed
