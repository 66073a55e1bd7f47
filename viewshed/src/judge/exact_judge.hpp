// Cells judged over the full surface itself: none stays undecided, unless ground without data leaves it open.
//
//   const ExactJudge judge(surface, make_views(eyes.size(), [&](std::size_t i) {
//                            return EyeView{eyes[i], surface.view_from(eyes[i]), shadow_of(eyes[i], rim, result)};
//                          }));
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <itin/parallel.hpp>

#include "judge/tile_judge.hpp"
#include "request/void_shadow.hpp"
#include "scene/exact_scene.hpp"

namespace itin::viewshed {

/// An eye over a surface in memory.
struct EyeView {
  Eye eye;
  RadialSweep::View view;                              ///< the surface's view from this eye
  std::shared_ptr<const VoidShadow> shadow = nullptr;  ///< where ground without data hides, or may
};

class ExactJudge final : public TileJudge {
 public:
  /// The surface must outlive it.
  ExactJudge(const ExactScene& surface, std::vector<EyeView> views);
  /// Serves one eye.
  ExactJudge(const ExactScene& surface, EyeView view);

  /// Also holds what modes ask about a tile's ground and its lines.
  class ExactWork final : public Work {
   public:
    ExactWork(const ExactJudge& judge, std::unique_ptr<ExactScene::TileCells> of)
        : cells(*of), judge_(judge), cells_(std::move(of)) {}

    std::uint64_t judge(std::size_t eye, TileValues<Verdict>& values) override;
    TileTargets targets() override { return {cells.centres, cells.targets, cells.targets}; }
    const ExactScene& surface() const { return judge_.surface_; }
    const EyeView& view(std::size_t eye) const { return judge_.views_[eye]; }

    ExactScene::TileCells& cells;

   private:
    const ExactJudge& judge_;
    std::unique_ptr<ExactScene::TileCells> cells_;
  };

  std::unique_ptr<Work> begin(std::size_t tile) const override { return begin_exactly(tile); }
  std::unique_ptr<ExactWork> begin_exactly(std::size_t tile) const;
  /// Begins a tile where only cells in these parts are asked about.
  std::unique_ptr<ExactWork> begin_exactly(const Tile& tile, std::span<const Tile> parts) const;
  /// Calls ExactScene::hides() for one of the eyes.
  bool hides(std::size_t eye, const Tile& tile) const {
    return surface_.hides(views_[eye].eye, views_[eye].view, tile);
  }
  const Eye& eye(std::size_t number) const override { return views_[number].eye; }
  std::size_t eye_count() const { return views_.size(); }
  const ExactScene& surface() const { return surface_; }

 private:
  const ExactScene& surface_;
  const std::vector<EyeView> views_;
};

/// Calls make(i) for each i in [0, count) on all threads, and returns the views made.
template <class Make>
std::vector<EyeView> make_views(std::size_t count, const Make& make) {
  std::vector<std::optional<EyeView>> made(count);
  parallel_for(count, [&](std::size_t i) { made[i].emplace(make(i)); });
  std::vector<EyeView> views;
  views.reserve(count);
  for (std::optional<EyeView>& view : made) views.push_back(std::move(*view));
  return views;
}

}  // namespace itin::viewshed
