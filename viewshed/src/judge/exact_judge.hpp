// Cells judged over the full surface itself: none stays undecided.
#pragma once

#include <optional>
#include <vector>

#include "judge/tile_judge.hpp"
#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"

namespace itin::viewshed {

class ExactJudge final : public TileJudge {
 public:
  /// Under NoData::kBlock ground that is missing hides. The surface must outlive it.
  ExactJudge(const FullSurface& surface, const std::vector<Eye>& eyes, NoData nodata);

  std::unique_ptr<Work> begin(std::size_t tile) const override;
  const Eye& eye(std::size_t number) const override { return views_[number]->eye; }

 private:
  struct EyesView {
    Eye eye;
    RadialSweep::View view;
    std::optional<VoidShadow> shadow;  ///< where ground without data hides
  };
  class ExactWork;

  const FullSurface& surface_;
  std::vector<std::optional<EyesView>> views_;
};

}  // namespace itin::viewshed
