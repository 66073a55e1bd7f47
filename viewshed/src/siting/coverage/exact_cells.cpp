// Cells judged over the full surface itself.
#include <itin/parallel.hpp>
#include <viewshed/certified.hpp>

#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"
#include "siting/coverage/clear_zone.hpp"
#include "siting/coverage/tile_judge.hpp"
#include "siting/coverage/zone_cut.hpp"

namespace itin::viewshed {

namespace {

struct FullGround {
  FullGround(const SiteSurvey& s, Surface of, std::optional<Tin> bare_ground, const std::vector<Point2>& eyes_of_rays)
      : survey(s),
        tiles(grid_of_tiles(*survey.targets.grid)),
        surface(std::move(of), std::move(bare_ground), survey.earth, *survey.targets.grid, tiles, eyes_of_rays) {
    if (survey.fresnel) zone.emplace(surface.surface.tin, nullptr, survey.earth, *survey.fresnel);
  }

  const SiteSurvey& survey;
  RasterGrid tiles;
  OwnedSurface surface;
  std::optional<ClearZone> zone;
};

struct ExactLook {
  Eye eye;
  RadialSweep::View view;
  std::optional<VoidShadow> shadow;  ///< where ground without data hides
};

class ExactTile final : public TileJudge::Work {
 public:
  ExactTile(const FullGround& ground, const std::vector<std::optional<ExactLook>>& looks, std::size_t tile)
      : ground_(ground), looks_(looks), work_(ground.surface.full.begin(tile)) {}

  std::uint64_t judge(std::size_t i, TileValues<Verdict>& values) override {
    const auto& [eye, view, shadow] = *looks_[i];
    const std::uint64_t lines = ground_.surface.full.judge(eye, view, values, *work_);
    if (shadow) shadow->apply_to(work_->centres, values);
    if (ground_.zone) cut_zones(*ground_.zone, eye, {work_->centres, work_->targets, work_->targets}, values);
    return lines;
  }

 private:
  const FullGround& ground_;
  const std::vector<std::optional<ExactLook>>& looks_;
  std::unique_ptr<FullSurface::TileWork> work_;
};

class ExactJudge final : public TileJudge {
 public:
  ExactJudge(const FullGround& ground, const SiteLooks& looks) : ground_(ground), looks_(looks.options.size()) {
    const FullSurface& surface = ground.surface.full;
    parallel_for(looks_.size(), [&](std::size_t i) {
      const Eye eye = eye_at(surface.units(), looks.request, ground.survey.stands[looks.options[i]]);
      looks_[i].emplace(ExactLook{eye, surface.view_from(eye), std::nullopt});
      if (ground.survey.nodata == NoData::kBlock) looks_[i]->shadow.emplace(surface.rim(), eye.units);
    });
  }

  std::unique_ptr<Work> begin(std::size_t tile) const override {
    return std::make_unique<ExactTile>(ground_, looks_, tile);
  }

 private:
  const FullGround& ground_;
  std::vector<std::optional<ExactLook>> looks_;
};

class ExactCells final : public GroupSurvey {
 public:
  ExactCells(const SiteSurvey& survey, Surface surface, std::optional<Tin> bare_ground,
             const std::vector<Point2>& eyes_of_rays)
      : ground_(survey, std::move(surface), std::move(bare_ground), eyes_of_rays) {}

  std::vector<CoverageBounds> judge(const SiteLooks& looks, Progress& progress, Statistics& statistics) const override {
    auto result = judge_tiles(ExactJudge(ground_, looks), ground_.survey, looks, progress, statistics);
    for (CoverageBounds& bounds : result) bounds.exact = true;
    return result;
  }

 private:
  FullGround ground_;
};

}  // namespace

std::unique_ptr<GroupSurvey> survey_cells_exactly(const SiteSurvey& survey, Surface surface,
                                                  std::optional<Tin> bare_ground,
                                                  const std::vector<Point2>& eyes_of_rays) {
  return std::make_unique<ExactCells>(survey, std::move(surface), std::move(bare_ground), eyes_of_rays);
}

}  // namespace itin::viewshed
