#include "judge/envelope_judge.hpp"

#include <itin/parallel.hpp>

namespace itin::viewshed {

class EnvelopeJudge::EnvelopeWork final : public TileJudge::Work {
 public:
  EnvelopeWork(const EnvelopeJudge& judge, std::size_t tile) : judge_(judge), work_(judge.pass_.begin(tile)) {}

  std::uint64_t judge(std::size_t eye, TileValues<Verdict>& values) override {
    const std::uint64_t before = work_->rays;
    last_ = &*judge_.looks_[eye];
    judge_.pass_.judge(*last_, values, *work_, nullptr);
    return work_->rays - before;
  }

  TileTargets targets() override {
    const double metres = judge_.resolution_;
    for (std::size_t cell = 0; cell < low_.size(); ++cell) {
      low_[cell] = last_->eye.target(work_->low[cell] * metres) / metres;
      high_[cell] = last_->eye.target(work_->high[cell] * metres) / metres;
    }
    return {work_->centres, low_, high_};
  }

 private:
  const EnvelopeJudge& judge_;
  std::unique_ptr<CertifiedPass::TileWork> work_;
  const EnvelopeScene::Look* last_ = nullptr;
  TileValues<double> low_, high_;
};

EnvelopeJudge::EnvelopeJudge(const EnvelopeScene& scene, const RasterGrid& grid, const RasterGrid& tiles,
                             const std::vector<Eye>& eyes)
    : pass_(scene, grid, tiles), resolution_(scene.envelope.lower.grid.resolution), looks_(eyes.size()) {
  parallel_for(eyes.size(), [&](std::size_t i) { looks_[i] = scene.look_from(eyes[i]); });
}

std::unique_ptr<TileJudge::Work> EnvelopeJudge::begin(std::size_t tile) const {
  return std::make_unique<EnvelopeWork>(*this, tile);
}

}  // namespace itin::viewshed
