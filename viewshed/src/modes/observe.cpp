#include "modes/observe.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

namespace itin::viewshed {

namespace {

struct TileTally {
  CellCounts cells;
  std::uint64_t lines = 0;
};

/// Tells whether nothing of a tile is seen, where no more is asked of hidden cells.
bool is_hidden(const ExactJudge& judge, std::size_t eye, std::size_t tile, const Observation& observation) {
  return !observation.asks_of_the_hidden() && judge.hides(eye, tile);
}

/// Eyes whose views are in memory at a time: a tile's ground is found anew for each group.
constexpr std::size_t kGroup = 256;

class AllEyes {
 public:
  AllEyes(const FullSurface& surface, const TriangleStudies* studies, const std::vector<Eye>& eyes,
          std::vector<RadialSweep::View> views, Result& result)
      : surface_(surface),
        studies_(studies),
        observations_(result.request),
        eyes_(eyes),
        given_(std::move(views)),
        result_(result),
        kept_(surface.tiles().cell_count()),
        tallies_(kept_.size()) {}

  void run(Progress& progress) {
    Observation::prepare(result_);
    const std::size_t groups = (eyes_.size() + kGroup - 1) / kGroup;
    Stage stage("sight lines", groups * kept_.size(), progress);
    for (first_ = 0; first_ < eyes_.size(); first_ += kGroup) {
      end_ = std::min(eyes_.size(), first_ + kGroup);
      progress.throw_if_cancelled();
      const ExactJudge judge(surface_, make_views(end_ - first_, [&](std::size_t i) { return view_of(first_ + i); }));
      stage.for_each(kept_.size(), [&](std::size_t tile) {
        observe(judge, tile);
        return std::size_t{1};
      });
    }
    for (const TileTally& tally : tallies_) {
      result_.cells += tally.cells;
      result_.statistics.lines += tally.lines;
    }
    observations_.finish(result_);
  }

 private:
  EyeView view_of(std::size_t i) {
    const Eye& eye = eyes_[i];
    return {eye, given_.empty() ? surface_.view_of_cells(eye) : std::move(given_[i]),
            shadow_of(eye, surface_.rim(), result_)};
  }

  /// Observes a tile from the group's eyes; after the last group the tile is done.
  void observe(const ExactJudge& judge, std::size_t tile) {
    const Tile cells = tile_at(surface_.grid(), surface_.tiles(), tile);
    std::unique_ptr<Observation>& observation = kept_[tile];
    if (!observation) observation = observations_.of_tile();
    if (const std::vector<std::uint32_t> eyes = eyes_near(cells); !eyes.empty()) {
      std::unique_ptr<ExactJudge::ExactWork> work;
      for (const std::uint32_t i : eyes) {
        if (is_hidden(judge, i - first_, tile, *observation)) {
          tallies_[tile].lines += observation->hide(cells, {&cells, 1});
          continue;
        }
        if (!work) work = judge.begin_exactly(tile);
        tallies_[tile].lines += observation->observe({*work, i - first_, i, studies_});
      }
    }
    if (end_ < eyes_.size()) return;
    observation->store(cells, result_, tallies_[tile].cells);
    observation.reset();
  }

  /// The group's eyes that reach the tile, the nearest first: they most often settle what is asked of the others.
  std::vector<std::uint32_t> eyes_near(const Tile& tile) const {
    const Box centres = box_of_centres(surface_.grid(), tile);
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::size_t i = first_; i < end_; ++i) {
      const double squared = squared_distance(eyes_[i].position, centres);
      if (eyes_[i].view.reaches(squared)) order.emplace_back(squared, static_cast<std::uint32_t>(i));
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> observers;
    for (const auto& [squared, observer] : order) observers.push_back(observer);
    return observers;
  }

  const FullSurface& surface_;
  const TriangleStudies* studies_;
  Observations observations_;
  const std::vector<Eye>& eyes_;
  std::vector<RadialSweep::View> given_;  ///< each eye's, or none
  Result& result_;
  std::vector<std::unique_ptr<Observation>> kept_;  ///< each tile's, from the first group to the last
  std::vector<TileTally> tallies_;
  std::size_t first_ = 0, end_ = 0;  ///< the eyes of the group at hand
};

}  // namespace

void observe_all(const FullSurface& surface, const TriangleStudies* studies, const std::vector<Eye>& eyes,
                 std::vector<RadialSweep::View> views, Result& result, Progress& progress) {
  AllEyes(surface, studies, eyes, std::move(views), result).run(progress);
}

std::uint64_t observe(const ExactJudge& judge, std::uint32_t observer, std::span<const PartsOfTile> cells,
                      const std::vector<std::unique_ptr<Observation>>& observations, const TriangleStudies* studies,
                      Stage& stage) {
  std::atomic<std::uint64_t> lines = 0;
  stage.for_each(cells.size(), [&](std::size_t i) {
    const auto& [tile, parts] = cells[i];
    Observation& observation = *observations[tile];
    if (is_hidden(judge, 0, tile, observation)) {
      lines += observation.hide(tile_at(judge.surface().grid(), judge.surface().tiles(), tile), parts);
    } else {
      const auto work = judge.begin_exactly(tile, parts);
      lines += observation.observe({*work, 0, observer, studies});
    }
    return cell_count(parts);
  });
  return lines;
}

}  // namespace itin::viewshed
