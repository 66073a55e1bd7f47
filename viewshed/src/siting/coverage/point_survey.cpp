#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include <itin/grid_units.hpp>
#include <itin/parallel.hpp>

#include "bounds/surface_heights.hpp"
#include "judge/certified_pass.hpp"
#include "line/sight_line.hpp"
#include "progress/stage.hpp"
#include "siting/coverage/clear_zone.hpp"
#include "siting/coverage/group_survey.hpp"
#include "siting/coverage/point_bins.hpp"

namespace itin::viewshed {

namespace {

/// Between these the ground under a point lies, grid units; NaN where there is none.
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

/// One bit for each active line that is hidden, over a scene of level 0. `starts_under` and `ends_under` say which
/// lines begin or end below the upper surface.
unsigned hidden_exactly(const EnvelopeScene& scene, const SightLines& lines, unsigned starts_under,
                        unsigned ends_under) {
  UpperScene::Stretches stretches;
  scene.upper.find_stretches(lines, starts_under, ends_under, stretches);
  unsigned result = 0;
  for (unsigned active = lines.active; active != 0; active &= active - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(active));
    const bool hidden = std::any_of(stretches[i].begin(), stretches[i].end(), [&](const Stretch& s) {
      return scene.lower.hidden_between(lines, i, s.from, s.to);
    });
    if (hidden) result |= 1U << i;
  }
  return result;
}

/// Judges packets of points as CertifiedPass does those of cells.
class PointPass {
 public:
  PointPass(const EnvelopeScene& scene, const std::optional<ClearZone>& zone, const SiteSurvey& survey,
            const Request& request, const std::vector<GroundBounds>& grounds)
      : scene_(scene), zone_(zone), survey_(survey), request_(request), grounds_(grounds) {}

  /// The bits of `open` that are certainly visible, and those that are certainly hidden, for points `first` and on.
  struct Verdict {
    std::uint64_t visible = 0, hidden = 0;
  };
  Verdict judge(const EnvelopeScene::Look& look, std::size_t first, std::uint64_t open, Occluder& occluder) const {
    Verdict verdict;
    for (unsigned packet = 0; packet < 64; packet += SightLines::kSize)
      judge_packet(look, first, packet, static_cast<unsigned>(open >> packet & 0xffff), occluder, verdict);
    return verdict;
  }

 private:
  struct Packet {
    SightLines low, high;
    unsigned starts_under = 0, ends_under = 0;
  };

  void judge_packet(const EnvelopeScene::Look& look, std::size_t first, unsigned at, unsigned open, Occluder& occluder,
                    Verdict& verdict) const {
    if (open == 0) return;
    Packet packet;
    for (SightLines* const lines : {&packet.low, &packet.high}) lines->start_at(look.eye.units);
    for (; open != 0; open &= open - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(open));
      fill(look, first + at + i, i, std::uint64_t{1} << (at + i), packet, verdict);
    }
    const unsigned all = packet.low.active;
    if (all == 0) return;
    packet.low.active = all & ~(packet.starts_under | packet.ends_under);
    const unsigned visible = packet.low.active & ~scene_.upper.touched(packet.low);
    packet.high.active = all & ~visible;
    const unsigned hidden = packet.high.active == 0 ? 0 : scene_.lower.hidden(packet.high, occluder);
    unsigned seen = visible, unseen = hidden;
    packet.low.active = all & ~visible & ~hidden;
    if (scene_.exact && packet.low.active != 0) {
      const unsigned walked = hidden_exactly(scene_, packet.low, packet.starts_under, packet.ends_under);
      seen |= packet.low.active & ~walked;
      unseen |= walked;
    }
    if (zone_) judge_zones(packet, all, seen, unseen);
    verdict.visible |= std::uint64_t{seen} << at;
    verdict.hidden |= std::uint64_t{unseen} << at;
  }

  /// Keeps of what is seen or may be only what the Fresnel zones leave.
  void judge_zones(const Packet& packet, unsigned all, unsigned& seen, unsigned& unseen) const {
    // One by one: points may lie far apart.
    SightLines low = packet.low, high = packet.high;
    for (unsigned rest = all & ~unseen; rest != 0; rest &= rest - 1) {
      const unsigned bit = rest & -rest;
      low.active = high.active = bit;
      if (zone_->certainly_cut(high) != 0) {
        unseen |= bit;
        seen &= ~bit;
      } else if ((seen & bit) != 0 && !scene_.exact && zone_->certainly_clear(low) == 0) {
        seen &= ~bit;
      }
    }
  }

  void fill(const EnvelopeScene::Look& look, std::size_t point, unsigned i, std::uint64_t bit, Packet& packet,
            Verdict& verdict) const {
    const Grid& grid = scene_.envelope.lower.grid;
    const GroundBounds& ground = grounds_[point];
    const Point2 p = survey_.targets.points[point];
    const double dx = p.x - look.eye.position.x, dy = p.y - look.eye.position.y;
    if (std::isnan(ground.low) || dx * dx + dy * dy > survey_.radius * survey_.radius) {
      verdict.hidden |= bit;
      return;
    }
    const double x = easting_in_units(grid, p.x), y = northing_in_units(grid, p.y);
    if (look.eye.stands_at({x, y})) {
      verdict.visible |= bit;
      return;
    }
    if (look.shadow && look.shadow->holds(x, y)) {
      verdict.hidden |= bit;
      return;
    }
    const double metre = 1 / grid.resolution;
    const auto target = [&](double units) { return (units * grid.resolution + request_.target_height) * metre; };
    const double low = target(ground.low), high = target(scene_.exact ? ground.low : ground.high);
    packet.low.to_x[i] = packet.high.to_x[i] = x;
    packet.low.to_y[i] = packet.high.to_y[i] = y;
    packet.low.to_z[i] = low;
    packet.high.to_z[i] = high;
    packet.low.active |= 1U << i;
    const double dz = low - look.eye.units.z;
    const double clear = 2 * scene_.upper.error_bound(std::sqrt((dx * dx + dy * dy) * metre * metre + dz * dz));
    if (look.eye.units.z < look.upper + clear) packet.starts_under |= 1U << i;
    if (low < ground.high + clear) packet.ends_under |= 1U << i;
  }

  const EnvelopeScene& scene_;
  const std::optional<ClearZone>& zone_;
  const SiteSurvey& survey_;
  const Request& request_;
  const std::vector<GroundBounds>& grounds_;
};

std::uint64_t certain_of(const DemandSet& set, std::uint32_t number,
                         std::vector<DemandSet::Block>::const_iterator& at) {
  while (at != set.blocks().end() && at->number < number) ++at;
  return at != set.blocks().end() && at->number == number ? at->members : 0;
}

class PointSurvey final : public GroupSurvey {
 public:
  PointSurvey(const SiteSurvey& survey, const Request& request, Envelope envelope, bool zones)
      : survey_(survey),
        bins_(bins_of_points(survey.targets.points)),
        scene_(std::move(envelope), request, bins_, voids_without_doubt(survey.nodata)),
        grounds_(survey.targets.points.size()) {
    if (zones) {
      zone_.emplace(scene_.envelope.lower, scene_.exact ? nullptr : &scene_.envelope.upper, survey.earth,
                    *survey.fresnel);
    }
    constexpr std::size_t kChunk = 256;
    parallel_for((grounds_.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
      for (std::size_t i = chunk * kChunk; i < std::min(grounds_.size(), (chunk + 1) * kChunk); ++i)
        grounds_[i] = ground_at(scene_, bins_, survey.targets.points[i]);
    });
  }

  std::vector<CoverageBounds> judge(const SiteLooks& looks, Progress& progress, Statistics& statistics) const override {
    const PointPass pass(scene_, zone_, survey_, looks.request, grounds_);
    std::vector<CoverageBounds> result(looks.options.size());
    std::atomic<std::uint64_t> rays = 0;
    for_each_step(result.size(), "sight lines of candidates", progress, [&](std::size_t i) {
      const EnvelopeScene::Look look =
          scene_.look_from(eye_at(scene_.envelope.lower.grid, looks.request, survey_.stands[looks.options[i]]));
      rays += judge(pass, look, *looks.bounds[i], result[i]);
    });
    statistics.lines += rays;
    return result;
  }

 private:
  /// Returns how many sight lines that took.
  std::uint64_t judge(const PointPass& pass, const EnvelopeScene::Look& look, const CoverageBounds& before,
                      CoverageBounds& after) const {
    Occluder occluder;
    std::uint64_t rays = 0;
    auto certain = before.certain.blocks().begin();
    for (const DemandSet::Block& block : before.possible.blocks()) {
      const std::uint64_t known = certain_of(before.certain, block.number, certain);
      const std::uint64_t open = block.members & ~known;
      const PointPass::Verdict verdict = pass.judge(look, std::size_t{64} * block.number, open, occluder);
      after.certain.add(block.number, known | verdict.visible);
      after.possible.add(block.number, block.members & ~verdict.hidden);
      rays += static_cast<std::uint64_t>(std::popcount(open));
    }
    after.exact = scene_.exact;
    return rays;
  }

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
