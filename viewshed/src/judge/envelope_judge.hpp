// Cells judged over two surfaces that enclose the full one: what they do not decide stays undecided.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "judge/envelope_scene.hpp"
#include "judge/tile_judge.hpp"

namespace itin::viewshed {

class EnvelopeJudge final : public TileJudge {
 public:
  /// Called with each packet of a tile's lines that stay undecided, which are active in packet.low. Called from any
  /// thread.
  using OnUndecided = std::function<void(std::size_t tile, const EnvelopePacket& packet)>;

  /// `tiles` are the tiles of `grid`. All must outlive this object.
  EnvelopeJudge(const EnvelopeScene& scene, const RasterGrid& grid, const RasterGrid& tiles,
                const std::vector<Eye>& eyes, OnUndecided on_undecided = nullptr);

  std::unique_ptr<Work> begin(std::size_t tile) const override;
  const Eye& eye(std::size_t number) const override { return view(number).eye; }
  const EnvelopeScene::View& view(std::size_t number) const { return *views_[number]; }

 private:
  class EnvelopeWork;

  const EnvelopeScene& scene_;
  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  std::vector<std::optional<EnvelopeScene::View>> views_;
  OnUndecided on_undecided_;
};

}  // namespace itin::viewshed
