#include "look_around.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <itin/parallel.hpp>

#include "stage.hpp"

namespace itin::viewshed {

namespace {

struct Tally {
  CellCounts cells;
  std::uint64_t lines = 0;
};

class LookAround {
 public:
  LookAround(const FullSurface& surface, const Observations& observations, const std::vector<Eye>& eyes,
             const std::vector<AxisSweep::View>& views, Result& result)
      : surface_(surface),
        eyes_(eyes),
        views_(views),
        result_(result),
        observations_(observations),
        shadows_(eyes.size()) {
    parallel_for(eyes.size(), [&](std::size_t i) { shadows_[i] = shadow_of(eyes[i], surface, result); });
  }

  Tally decide(std::size_t tile) const {
    const Tile cells = tile_at(surface_.grid(), surface_.tiles(), tile);
    const auto observation = observations_.of_tile();
    Tally tally;
    if (const std::vector<std::uint32_t> eyes = eyes_near(cells); !eyes.empty())
      tally.lines = look(eyes, *surface_.begin(tile), *observation);
    observation->store(cells, result_, tally.cells);
    return tally;
  }

 private:
  /// The eyes that reach the tile, the nearest first: they most often settle what is asked of the others.
  std::vector<std::uint32_t> eyes_near(const Tile& tile) const {
    const Box centres = box_of_centres(surface_.grid(), tile);
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < eyes_.size(); ++i) {
      const double squared = squared_distance(eyes_[i].position, centres);
      if (eyes_[i].view.reaches(squared)) order.emplace_back(squared, i);
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
      const VoidShadow* const shadow = shadows_[i] ? &*shadows_[i] : nullptr;
      lines += observation.look({surface_, eyes_[i], views_[i], i, shadow, work});
    }
    return lines;
  }

  const FullSurface& surface_;
  const std::vector<Eye>& eyes_;
  const std::vector<AxisSweep::View>& views_;  ///< each eye's
  Result& result_;
  const Observations& observations_;
  std::vector<std::optional<VoidShadow>> shadows_;  ///< each eye's
};

}  // namespace

void look_around(const FullSurface& surface, const Observations& observations, const std::vector<Eye>& eyes,
                 const std::vector<AxisSweep::View>& views, Result& result, Progress& progress) {
  Observation::prepare(result);
  const LookAround looks(surface, observations, eyes, views, result);
  std::vector<Tally> tallies(surface.tiles().cell_count());
  for_each_step(tallies.size(), "sight lines", progress, [&](std::size_t i) { tallies[i] = looks.decide(i); });
  for (const Tally& tally : tallies) {
    result.cells += tally.cells;
    result.statistics.rays += tally.lines;
  }
}

}  // namespace itin::viewshed
