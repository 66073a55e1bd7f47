// Cells judged over two surfaces that enclose the full one: what they do not decide stays undecided.
#pragma once

#include <optional>
#include <vector>

#include "judge/certified_pass.hpp"
#include "judge/tile_judge.hpp"

namespace itin::viewshed {

class EnvelopeJudge final : public TileJudge {
 public:
  /// `tiles` are those of `grid`. All must outlive it.
  EnvelopeJudge(const EnvelopeScene& scene, const RasterGrid& grid, const RasterGrid& tiles,
                const std::vector<Eye>& eyes);

  std::unique_ptr<Work> begin(std::size_t tile) const override;
  const Eye& eye(std::size_t number) const override { return looks_[number]->eye; }

 private:
  class EnvelopeWork;

  CertifiedPass pass_;
  double resolution_;
  std::vector<std::optional<EnvelopeScene::Look>> looks_;
};

}  // namespace itin::viewshed
