#include "judge/exact_judge.hpp"

#include <itin/parallel.hpp>

namespace itin::viewshed {

class ExactJudge::ExactWork final : public TileJudge::Work {
 public:
  ExactWork(const ExactJudge& judge, std::size_t tile) : judge_(judge), work_(judge.surface_.begin(tile)) {}

  std::uint64_t judge(std::size_t eye, TileValues<Verdict>& values) override {
    const auto& [of, view, shadow] = *judge_.views_[eye];
    const std::uint64_t lines = judge_.surface_.judge(of, view, values, *work_);
    if (shadow) shadow->apply_to(work_->centres, values);
    return lines;
  }
  TileTargets targets() override { return {work_->centres, work_->targets, work_->targets}; }

 private:
  const ExactJudge& judge_;
  std::unique_ptr<FullSurface::TileWork> work_;
};

ExactJudge::ExactJudge(const FullSurface& surface, const std::vector<Eye>& eyes, NoData nodata)
    : surface_(surface), views_(eyes.size()) {
  parallel_for(eyes.size(), [&](std::size_t i) {
    views_[i].emplace(EyesView{eyes[i], surface.view_from(eyes[i]), std::nullopt});
    if (nodata == NoData::kBlock) views_[i]->shadow.emplace(surface.rim(), eyes[i].units);
  });
}

std::unique_ptr<TileJudge::Work> ExactJudge::begin(std::size_t tile) const {
  return std::make_unique<ExactWork>(*this, tile);
}

}  // namespace itin::viewshed
