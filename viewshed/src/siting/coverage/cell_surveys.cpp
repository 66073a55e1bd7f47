// Cells judged over the full surface, or over bounds of it.
#include "judge/envelope_judge.hpp"
#include "judge/exact_judge.hpp"
#include "siting/coverage/judge_tiles.hpp"

namespace itin::viewshed {

namespace {

class EnvelopeCells final : public GroupSurvey {
 public:
  EnvelopeCells(const SiteSurvey& survey, const Request& request, Envelope envelope, bool zones)
      : survey_(survey),
        tiles_(grid_of_tiles(*survey.targets.grid)),
        scene_(std::move(envelope), request, tiles_, survey.nodata) {
    if (zones)
      zone_.emplace(std::make_shared<const HeightPyramid>(scene_.envelope.lower),
                    std::make_shared<const HeightPyramid>(scene_.envelope.upper), survey.earth, *survey.fresnel);
  }

  std::vector<CoverageBounds> judge(const SitesToJudge& sites, Progress& progress,
                                    Statistics& statistics) const override {
    const EnvelopeJudge judge(scene_, *survey_.targets.grid, tiles_,
                              eyes_of(scene_.envelope.lower.grid, survey_, sites));
    return judge_tiles(judge, zone_, survey_, sites, progress, statistics);
  }

 private:
  const SiteSurvey& survey_;
  RasterGrid tiles_;
  EnvelopeScene scene_;
  std::optional<ClearZone> zone_;
};

class ExactCells final : public GroupSurvey {
 public:
  ExactCells(const SiteSurvey& survey, RetrievedSurface surface, std::optional<Tin> bare_ground, bool rays)
      : survey_(survey),
        tiles_(grid_of_tiles(*survey.targets.grid)),
        surface_(std::move(surface), std::move(bare_ground), survey.earth, *survey.targets.grid, tiles_, rays) {
    if (survey.fresnel)
      zone_.emplace(std::make_shared<const HeightPyramid>(surface_.surface.tin), nullptr, survey.earth,
                    *survey.fresnel);
  }

  std::vector<CoverageBounds> judge(const SitesToJudge& sites, Progress& progress,
                                    Statistics& statistics) const override {
    const ExactScene& surface = surface_.full;
    const std::vector<Eye> eyes = eyes_of(surface.units(), survey_, sites);
    const ExactJudge judge(surface, make_views(eyes.size(), [&](std::size_t i) {
                             EyeView view{eyes[i], surface.view_from(eyes[i])};
                             if (survey_.nodata == NoData::kBlock)
                               view.shadow = std::make_shared<const VoidShadow>(surface.rim(), eyes[i].units);
                             return view;
                           }));
    auto result = judge_tiles(judge, zone_, survey_, sites, progress, statistics);
    for (CoverageBounds& bounds : result) bounds.exact = true;
    return result;
  }

 private:
  const SiteSurvey& survey_;
  RasterGrid tiles_;
  OwnedScene surface_;
  std::optional<ClearZone> zone_;
};

}  // namespace

std::unique_ptr<GroupSurvey> survey_cells(const SiteSurvey& survey, const Request& request, Envelope envelope,
                                          bool zones) {
  return std::make_unique<EnvelopeCells>(survey, request, std::move(envelope), zones);
}

std::unique_ptr<GroupSurvey> survey_cells_exactly(const SiteSurvey& survey, RetrievedSurface surface,
                                                  std::optional<Tin> bare_ground, bool rays) {
  return std::make_unique<ExactCells>(survey, std::move(surface), std::move(bare_ground), rays);
}

}  // namespace itin::viewshed
