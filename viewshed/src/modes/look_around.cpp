#include "modes/look_around.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <itin/parallel.hpp>

#include "progress/stage.hpp"

namespace itin::viewshed {

namespace {

struct TileTally {
  CellCounts cells;
  std::uint64_t lines = 0;
};

/// Eyes whose views are in memory at a time: a tile's ground is found anew for each group.
constexpr std::size_t kGroup = 256;

class LookAround {
 public:
  LookAround(const FullSurface& surface, const TriangleStudies* studies, Observations& observations,
             const std::vector<Eye>& eyes, const std::vector<RadialSweep::View>& views, Result& result)
      : surface_(surface),
        studies_(studies),
        observations_(observations),
        eyes_(eyes),
        given_(views),
        result_(result),
        kept_(surface.tiles().cell_count()),
        tallies_(kept_.size()) {}

  void run(Progress& progress) {
    const std::size_t groups = (eyes_.size() + kGroup - 1) / kGroup;
    Stage stage("sight lines", groups * kept_.size(), progress);
    for (first_ = 0; first_ < eyes_.size(); first_ += kGroup) {
      end_ = std::min(eyes_.size(), first_ + kGroup);
      progress.throw_if_cancelled();
      make_views();
      stage.for_each(kept_.size(), [&](std::size_t tile) {
        look_at(tile);
        return std::size_t{1};
      });
    }
    for (const TileTally& tally : tallies_) {
      result_.cells += tally.cells;
      result_.statistics.lines += tally.lines;
    }
  }

 private:
  void make_views() {
    made_ = decltype(made_)(given_.empty() ? end_ - first_ : 0);
    shadows_ = decltype(shadows_)(end_ - first_);
    parallel_for(shadows_.size(), [&](std::size_t i) {
      if (given_.empty()) made_[i].emplace(surface_.view_of_cells(eyes_[first_ + i]));
      shadows_[i] = shadow_of(eyes_[first_ + i], surface_.rim(), result_);
    });
  }
  const RadialSweep::View& view_of(std::size_t eye) const {
    return given_.empty() ? *made_[eye - first_] : given_[eye];
  }

  /// The group looks; after the last one the tile is done.
  void look_at(std::size_t tile) {
    const Tile cells = tile_at(surface_.grid(), surface_.tiles(), tile);
    std::unique_ptr<Observation>& observation = kept_[tile];
    if (!observation) observation = observations_.of_tile();
    if (const std::vector<std::uint32_t> eyes = eyes_near(cells); !eyes.empty())
      tallies_[tile].lines += look(eyes, *surface_.begin(tile), *observation);
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

  std::uint64_t look(const std::vector<std::uint32_t>& eyes, FullSurface::TileWork& work,
                     Observation& observation) const {
    std::uint64_t lines = 0;
    for (const std::uint32_t i : eyes) {
      const auto& shadow = shadows_[i - first_];
      lines += observation.look({surface_, eyes_[i], view_of(i), i, shadow ? &*shadow : nullptr, work, studies_});
    }
    return lines;
  }

  const FullSurface& surface_;
  const TriangleStudies* studies_;
  Observations& observations_;
  const std::vector<Eye>& eyes_;
  const std::vector<RadialSweep::View>& given_;  ///< each eye's, or none
  Result& result_;
  std::vector<std::unique_ptr<Observation>> kept_;  ///< each tile's, from the first group to the last
  std::vector<TileTally> tallies_;
  // The group at hand: its eyes, and what each of them has.
  std::size_t first_ = 0, end_ = 0;
  std::vector<std::optional<RadialSweep::View>> made_;
  std::vector<std::optional<VoidShadow>> shadows_;
};

}  // namespace

void look_around(const FullSurface& surface, const TriangleStudies* studies, Observations& observations,
                 const std::vector<Eye>& eyes, const std::vector<RadialSweep::View>& views, Result& result,
                 Progress& progress) {
  Observation::prepare(result);
  LookAround(surface, studies, observations, eyes, views, result).run(progress);
  observations.finish(result);
}

}  // namespace itin::viewshed
