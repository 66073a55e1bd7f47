#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <itin/grid_units.hpp>
#include <itin/parallel.hpp>

#include "bounds/surface_heights.hpp"
#include "judge/clear_zone.hpp"
#include "judge/envelope_scene.hpp"
#include "line/set_bits.hpp"
#include "line/sight_line.hpp"
#include "progress/stage.hpp"
#include "siting/coverage/group_survey.hpp"
#include "siting/coverage/point_bins.hpp"
#include "siting/coverage/point_blocks.hpp"

namespace itin::viewshed {

namespace {

/// Bounds of the ground's height under a point, grid units; NaN where there is no ground.
struct GroundBounds {
  double low = kNoSurface;
  double high = kNoSurface;
};

GroundBounds ground_at(const EnvelopeScene& scene, const RasterGrid& tiles, Point2 p) {
  GroundBounds ground;
  const auto bin = tiles.cell_at(p);
  if (!bin) return ground;
  const std::size_t index = tiles.index(*bin);
  if (scene.ground_bins) {
    const auto low = surface_height(*scene.envelope.bare_ground, scene.ground_bins->triangles(index), p);
    if (low) ground.low = *low;
  }
  for (const std::uint32_t t : scene.bins.triangles(index)) {
    if (const auto low = surface_height(scene.envelope.lower, {&t, 1}, p); low && std::isnan(ground.low))
      ground.low = *low;
    if (const auto high = surface_height(scene.envelope.upper, {&t, 1}, p); high && !(ground.high >= *high))
      ground.high = *high;
  }
  return ground;
}

/// Judges points, sixteen at a time.
class PointPass {
 public:
  PointPass(const EnvelopeScene& scene, const std::optional<ClearZone>& zone, const SiteSurvey& survey,
            const std::vector<GroundBounds>& grounds)
      : scene_(scene), zone_(zone), survey_(survey), grounds_(grounds) {}

  /// Judges the `open` points among points `first` and on.
  ServedPoints judge(const EnvelopeScene::View& view, std::size_t first, std::uint64_t open) const {
    ServedPoints served;
    for (unsigned at = 0; at < 64; at += SightLines::kSize) {
      const Decided decided = judge_packet(view, first + at, static_cast<unsigned>(open >> at & 0xffff));
      served.certain |= std::uint64_t{decided.visible} << at;
      served.never |= std::uint64_t{decided.hidden} << at;
    }
    return served;
  }

 private:
  using Decided = EnvelopeScene::Decided;

  Decided judge_packet(const EnvelopeScene::View& view, std::size_t first, unsigned open) const {
    Decided decided;
    if (open == 0) return decided;
    EnvelopePacket packet(view.eye);
    for_each_bit(open, [&](unsigned i) {
      const Verdict verdict = aim(view, first + i, i, packet);
      if (verdict == Verdict::kVisible) decided.visible |= 1U << i;
      if (verdict == Verdict::kHidden) decided.hidden |= 1U << i;
    });
    const unsigned lines = packet.low.active;
    if (lines == 0) return decided;
    Decided of_lines = scene_.decide(packet);
    if (zone_) judge_zones(packet, lines, of_lines);
    decided.visible |= of_lines.visible;
    decided.hidden |= of_lines.hidden;
    return decided;
  }

  /// Keeps the points seen, or possibly seen, only if their Fresnel zones are clear, or possibly clear.
  void judge_zones(const EnvelopePacket& packet, unsigned lines, Decided& decided) const {
    // Points are judged one by one, since they may lie far apart.
    SightLines low = packet.low, high = packet.high;
    for_each_bit(lines & ~decided.hidden, [&](unsigned i) {
      const unsigned bit = 1U << i;
      low.active = high.active = bit;
      if (zone_->certainly_cut(high) != 0) {
        decided.hidden |= bit;
        decided.visible &= ~bit;
      } else if ((decided.visible & bit) != 0 && !scene_.exact && zone_->certainly_clear(low) == 0) {
        decided.visible &= ~bit;
      }
    });
  }

  /// Aims a line at the point's target and returns kUndecided, or returns the verdict where none is needed.
  Verdict aim(const EnvelopeScene::View& view, std::size_t point, unsigned i, EnvelopePacket& packet) const {
    const Grid& grid = scene_.envelope.lower.grid;
    const GroundBounds& ground = grounds_[point];
    const Point2 p = survey_.targets.points[point];
    const double dx = p.x - view.eye.position.x, dy = p.y - view.eye.position.y, squared = dx * dx + dy * dy;
    if (std::isnan(ground.low) || squared > survey_.radius * survey_.radius) return Verdict::kHidden;
    const Point2 place{easting_in_units(grid, p.x), northing_in_units(grid, p.y)};
    if (view.eye.stands_at(place)) return Verdict::kVisible;
    if (view.shadow && view.shadow->holds(place.x, place.y)) return Verdict::kHidden;
    const double higher = survey_.targets.height_of(point) - survey_.targets.height;
    const auto target = [&](double units) {
      return (view.eye.target(units * grid.resolution) + higher) * (1 / grid.resolution);
    };
    const double low = target(ground.low), high = target(scene_.exact ? ground.low : ground.high);
    packet.aim(i, {place, low, high});
    return Verdict::kUndecided;
  }

  const EnvelopeScene& scene_;
  const std::optional<ClearZone>& zone_;
  const SiteSurvey& survey_;
  const std::vector<GroundBounds>& grounds_;
};

class PointSurvey final : public GroupSurvey {
 public:
  PointSurvey(const SiteSurvey& survey, const Request& request, Envelope envelope, bool zones)
      : survey_(survey),
        bins_(bins_of_points(survey.targets.points)),
        scene_(std::move(envelope), request, bins_, survey.nodata),
        grounds_(survey.targets.points.size()) {
    if (zones) {
      zone_.emplace(std::make_shared<const HeightPyramid>(scene_.envelope.lower),
                    scene_.exact ? nullptr : std::make_shared<const HeightPyramid>(scene_.envelope.upper), survey.earth,
                    *survey.fresnel);
    }
    constexpr std::size_t kChunk = 256;
    parallel_for((grounds_.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
      for (std::size_t i = chunk * kChunk; i < std::min(grounds_.size(), (chunk + 1) * kChunk); ++i)
        grounds_[i] = ground_at(scene_, bins_, survey.targets.points[i]);
    });
  }

  std::vector<CoverageBounds> judge(const SitesToJudge& sites, Progress& progress,
                                    Statistics& statistics) const override {
    const PointPass pass(scene_, zone_, survey_, grounds_);
    std::vector<CoverageBounds> result(sites.options.size());
    std::atomic<std::uint64_t> rays = 0;
    for_each_step(result.size(), "sight lines of candidates", progress, [&](std::size_t i) {
      const EnvelopeScene::View view =
          scene_.view_from(eye_at(scene_.envelope.lower.grid, sites.request, survey_.positions[sites.options[i]]));
      rays += judge_points(*sites.bounds[i], result[i],
                           [&](std::size_t first, std::uint64_t open) { return pass.judge(view, first, open); });
      result[i].exact = scene_.exact;
    });
    statistics.lines += rays;
    return result;
  }

 private:
  const SiteSurvey& survey_;
  RasterGrid bins_;
  EnvelopeScene scene_;
  std::vector<GroundBounds> grounds_;
  std::optional<ClearZone> zone_;
};

}  // namespace

std::unique_ptr<GroupSurvey> survey_points(const SiteSurvey& survey, const Request& request, Envelope envelope,
                                           bool zones) {
  return std::make_unique<PointSurvey>(survey, request, std::move(envelope), zones);
}

}  // namespace itin::viewshed
