#include "exact/coarse_pass.hpp"

#include <utility>

#include <itin/grid_units.hpp>
#include <itin/level_choice.hpp>
#include <itin/parallel.hpp>

#include "judge/block_judge.hpp"
#include "judge/envelope_judge.hpp"
#include "line/set_bits.hpp"
#include "line/verdicts.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

namespace {

/// The ground under the lines to each tile's undecided cells: all of it, or only what is in the set `of` or under a
/// cell.
std::vector<TileSet> under_lines(const CoarsePass::Over& over, const Eye& eye, const EyeVerdicts& verdicts,
                                 const TileSet* of = nullptr) {
  const RasterGrid& grid = over.result.grid;
  std::vector<TileSet> needed(verdicts.tile_count());
  parallel_for(needed.size(), [&](std::size_t i) {
    Box targets;
    for_each_cell(tile_at(grid, over.tiles, i), [&](std::size_t cell, RasterGrid::Cell place) {
      if (verdicts.of_tile(i)[cell] == Verdict::kUndecided) targets.extend(grid.centre(place.column, place.row));
    });
    if (targets.empty()) return;
    needed[i] = TileSet(over.ground.count());
    over.ground.add_lines(eye.position, targets, needed[i]);
    if (of == nullptr) return;
    needed[i] &= *of;
    over.ground.add_lines({targets.xmin, targets.ymin}, targets, needed[i]);
  });
  return needed;
}

class Nothing final : public CoarsePass {
 public:
  explicit Nothing(const Over& over) : over_(over) {}

  Left decide(const Eye& eye, EyeVerdicts& verdicts) override {
    return {under_lines(over_, eye, verdicts), shadow_of(eye, over_.rim, over_.result)};
  }

 private:
  Over over_;
};

/// Leaves out hidden ground: it hides nothing beyond it that is not hidden anyway, and need not be read.
class Blocks final : public CoarsePass {
 public:
  Blocks(Envelope envelope, const Over& over) : over_(over), bounded_(std::move(envelope), over.tiles, no_rises_) {}

  Left decide(const Eye& eye, EyeVerdicts& verdicts) override {
    bounded_.bound_for(eye);
    const BlockJudge judge(bounded_, over_.request, over_.result.grid, over_.tiles, eye, nullptr);
    verdicts.judge(judge);
    const TileSet seen = over_.ground.those([&](const Box& ground) { return judge.may_see(ground); });
    return {under_lines(over_, eye, verdicts, &seen), shadow_of(eye, over_.rim, over_.result)};
  }

 private:
  Over over_;
  TargetRises no_rises_;
  BoundedEnvelope bounded_;
};

class Rays final : public CoarsePass {
 public:
  Rays(Envelope envelope, const Over& over)
      : over_(over), scene_(std::move(envelope), over.request, over.tiles, over.request.nodata) {}

  Left decide(const Eye& eye, EyeVerdicts& verdicts) override {
    std::vector<TileSet> needed(verdicts.tile_count());
    const EnvelopeJudge judge(scene_, over_.result.grid, over_.tiles, {eye},
                              [&](std::size_t tile, const EnvelopePacket& packet) {
                                if (needed[tile].empty()) needed[tile] = TileSet(over_.ground.count());
                                add_ground(packet, needed[tile]);
                              });
    verdicts.judge(judge);
    return {std::move(needed), judge.view(0).shadow};
  }

 private:
  /// Adds the ground under the targets, and where it may rise into lines.
  void add_ground(const EnvelopePacket& packet, TileSet& tiles) const {
    Scene::Stretches stretches;
    scene_.upper().find_hidden(packet.low, stretches);
    for_each_bit(packet.low.active, [&](unsigned i) {
      const Point2 target = along(packet.low, i, 1);
      over_.ground.add_line(target, target, tiles);
      for (const Stretch& s : stretches[i])
        over_.ground.add_line(along(packet.low, i, s.from), along(packet.low, i, s.to), tiles);
    });
  }
  Point2 along(const SightLines& lines, unsigned i, double s) const {
    return place_in_metres(scene_.envelope.lower.grid, {lines.from_x[i] + s * (lines.to_x[i] - lines.from_x[i]),
                                                        lines.from_y[i] + s * (lines.to_y[i] - lines.from_y[i])});
  }

  Over over_;
  EnvelopeScene scene_;
};

}  // namespace

CoarseWay coarse_way(const Store& store, const Request& request) {
  // Cells that a coarse level decides have no exact height of ground.
  if (needs_triangles(request) || request.mode == Mode::kHeight || request.mode == Mode::kAngle)
    return CoarseWay::kNothing;
  if (level_within(store.metadata(), request.detail.coarsest()) == 0) return CoarseWay::kRays;
  // Certificates are those of a level, and know nothing of features that a level simplifies.
  const bool one_level = request.detail.rings().size() == 1;
  return one_level && !has_raised_features(store, request) ? CoarseWay::kBlocks : CoarseWay::kNothing;
}

std::unique_ptr<CoarsePass> make_coarse_pass(CoarseWay way, Envelope envelope, const CoarsePass::Over& over) {
  if (way == CoarseWay::kRays) return std::make_unique<Rays>(std::move(envelope), over);
  if (way == CoarseWay::kBlocks) return std::make_unique<Blocks>(std::move(envelope), over);
  return std::make_unique<Nothing>(over);
}

}  // namespace itin::viewshed
