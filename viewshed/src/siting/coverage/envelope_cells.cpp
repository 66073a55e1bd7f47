// Cells judged over bounds of the surface.
#include <itin/parallel.hpp>

#include "certify/certified_pass.hpp"
#include "siting/coverage/clear_zone.hpp"
#include "siting/coverage/tile_judge.hpp"
#include "siting/coverage/zone_cut.hpp"

namespace itin::viewshed {

namespace {

struct EnvelopeGround {
  EnvelopeGround(const SiteSurvey& s, const Request& request, Envelope envelope, bool zones)
      : survey(s),
        tiles(grid_of_tiles(*survey.targets.grid)),
        scene(std::move(envelope), request, tiles, voids_without_doubt(survey.nodata)),
        pass(scene, *survey.targets.grid, tiles) {
    if (zones) zone.emplace(scene.envelope.lower, &scene.envelope.upper, survey.earth, *survey.fresnel);
  }

  const SiteSurvey& survey;
  RasterGrid tiles;
  EnvelopeScene scene;
  CertifiedPass pass;
  std::optional<ClearZone> zone;
};

class EnvelopeTile final : public TileJudge::Work {
 public:
  EnvelopeTile(const EnvelopeGround& ground, const std::vector<std::optional<EnvelopeScene::Look>>& looks,
               std::size_t tile)
      : ground_(ground), looks_(looks), work_(ground.pass.begin(tile)) {}

  std::uint64_t judge(std::size_t i, TileValues<Verdict>& values) override {
    const std::uint64_t before = work_->rays;
    ground_.pass.judge(*looks_[i], values, *work_, nullptr);
    if (ground_.zone) judge_zones(looks_[i]->eye, values);
    return work_->rays - before;
  }

 private:
  void judge_zones(const Eye& eye, TileValues<Verdict>& values) {
    const double resolution = ground_.scene.envelope.lower.grid.resolution;
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
      low_[cell] = eye.target(work_->low[cell] * resolution) / resolution;
      high_[cell] = eye.target(work_->high[cell] * resolution) / resolution;
    }
    cut_zones(*ground_.zone, eye, {work_->centres, low_, high_}, values);
  }

  const EnvelopeGround& ground_;
  const std::vector<std::optional<EnvelopeScene::Look>>& looks_;
  std::unique_ptr<CertifiedPass::TileWork> work_;
  TileValues<double> low_, high_;  ///< targets, grid units
};

class EnvelopeJudge final : public TileJudge {
 public:
  EnvelopeJudge(const EnvelopeGround& ground, const SiteLooks& looks) : ground_(ground), looks_(looks.options.size()) {
    const EnvelopeScene& scene = ground.scene;
    parallel_for(looks_.size(), [&](std::size_t i) {
      const Eye eye = eye_at(scene.envelope.lower.grid, looks.request, ground.survey.stands[looks.options[i]]);
      const auto tile = ground.tiles.cell_at(eye.position);
      looks_[i] = tile ? scene.look_from(eye, scene.bins.triangles(ground.tiles.index(*tile))) : scene.look_from(eye);
    });
  }

  std::unique_ptr<Work> begin(std::size_t tile) const override {
    return std::make_unique<EnvelopeTile>(ground_, looks_, tile);
  }

 private:
  const EnvelopeGround& ground_;
  std::vector<std::optional<EnvelopeScene::Look>> looks_;
};

class EnvelopeCells final : public GroupSurvey {
 public:
  EnvelopeCells(const SiteSurvey& survey, const Request& request, Envelope envelope, bool zones)
      : ground_(survey, request, std::move(envelope), zones) {}

  std::vector<CoverageBounds> judge(const SiteLooks& looks, Progress& progress, Statistics& statistics) const override {
    return judge_tiles(EnvelopeJudge(ground_, looks), ground_.survey, looks, progress, statistics);
  }

 private:
  EnvelopeGround ground_;
};

}  // namespace

std::unique_ptr<GroupSurvey> survey_cells(const SiteSurvey& survey, const Request& request, Envelope envelope,
                                          bool zones) {
  return std::make_unique<EnvelopeCells>(survey, request, std::move(envelope), zones);
}

}  // namespace itin::viewshed
