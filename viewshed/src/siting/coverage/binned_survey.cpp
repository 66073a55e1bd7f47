// Cells or points judged by how low and how high the full surface is within bins.
#include <atomic>
#include <utility>

#include <itin/grid_units.hpp>

#include "judge/bin_judge.hpp"
#include "line/set_bits.hpp"
#include "progress/stage.hpp"
#include "siting/coverage/group_survey.hpp"
#include "siting/coverage/judge_tiles.hpp"
#include "siting/coverage/point_blocks.hpp"
#include "siting/coverage/survey_bins.hpp"

namespace itin::viewshed {

namespace {

class BinnedSurvey final : public GroupSurvey {
 public:
  BinnedSurvey(const SiteSurvey& survey, SurveyBins surface)
      : survey_(survey),
        surface_(std::move(surface)),
        walk_(surface_.bins, survey.earth.drop_coefficient() * units().resolution) {}

  std::vector<CoverageBounds> judge(const SitesToJudge& sites, Progress& progress,
                                    Statistics& statistics) const override {
    std::vector<CoverageBounds> result =
        survey_.targets.grid ? judge_cells(sites, progress, statistics) : judge_points(sites, progress, statistics);
    // Targets in sight may lie behind missing ground, or have their Fresnel zone cut.
    if (survey_.nodata == NoData::kBlock || survey_.fresnel)
      for (std::size_t i = 0; i < result.size(); ++i) result[i].certain = sites.bounds[i]->certain;
    return result;
  }

 private:
  const Grid& units() const { return surface_.bins.units(); }

  std::vector<CoverageBounds> judge_cells(const SitesToJudge& sites, Progress& progress, Statistics& statistics) const {
    const RasterGrid &grid = *survey_.targets.grid, tiles = grid_of_tiles(grid);
    const BinJudge judge(walk_, units(), grid, tiles, surface_.ground, eyes_of(units(), survey_, sites));
    return judge_tiles(judge, std::nullopt, survey_, sites, progress, statistics);
  }

  std::vector<CoverageBounds> judge_points(const SitesToJudge& sites, Progress& progress,
                                           Statistics& statistics) const {
    std::vector<CoverageBounds> result(sites.options.size());
    std::atomic<std::uint64_t> lines = 0;
    for_each_step(result.size(), "sight lines of candidates", progress, [&](std::size_t i) {
      const Eye eye = eye_at(units(), sites.request, survey_.positions[sites.options[i]]);
      lines += viewshed::judge_points(*sites.bounds[i], result[i],
                                      [&](std::size_t first, std::uint64_t open) { return served(eye, first, open); });
    });
    statistics.lines += lines;
    return result;
  }

  ServedPoints served(Eye eye, std::size_t first, std::uint64_t open) const {
    ServedPoints served;
    const double usual = eye.target_height;
    for_each_bit(open, [&](unsigned bit) {
      const Point2 p = survey_.targets.points[first + bit];
      eye.target_height = usual + survey_.targets.height_of(first + bit) - survey_.targets.height;
      const Verdict verdict =
          verdict_by_bins(walk_, eye, units().resolution, p, place_in_units(units(), p), surface_.ground[first + bit]);
      if (verdict == Verdict::kVisible) served.certain |= std::uint64_t{1} << bit;
      if (verdict == Verdict::kHidden || verdict == Verdict::kOutside) served.never |= std::uint64_t{1} << bit;
    });
    return served;
  }

  const SiteSurvey& survey_;
  SurveyBins surface_;
  BinWalk walk_;
};

}  // namespace

std::unique_ptr<GroupSurvey> survey_by_bins(const Store& store, const SiteSurvey& survey, std::uint64_t bytes,
                                            Statistics& statistics, Progress& progress) {
  return std::make_unique<BinnedSurvey>(survey, bin_surface(store, survey, bytes, statistics, progress));
}

}  // namespace itin::viewshed
