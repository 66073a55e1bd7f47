#include "judge/exact_judge.hpp"

namespace itin::viewshed {

ExactJudge::ExactJudge(const ExactScene& surface, std::vector<EyeView> views)
    : surface_(surface), views_(std::move(views)) {}

ExactJudge::ExactJudge(const ExactScene& surface, EyeView view)
    : ExactJudge(surface, make_views(1, [&](std::size_t) { return std::move(view); })) {}

std::unique_ptr<ExactJudge::ExactWork> ExactJudge::begin_exactly(std::size_t tile) const {
  return std::make_unique<ExactWork>(*this, surface_.begin(tile));
}

std::unique_ptr<ExactJudge::ExactWork> ExactJudge::begin_exactly(const Tile& tile, std::span<const Tile> parts) const {
  return std::make_unique<ExactWork>(*this, surface_.begin(tile, parts));
}

std::uint64_t ExactJudge::ExactWork::judge(std::size_t eye, TileValues<Verdict>& values) {
  const EyeView& from = view(eye);
  const std::uint64_t lines = surface().judge(from.eye, from.view, values, cells);
  if (from.shadow) from.shadow->apply_to(cells.centres, values);
  return lines;
}

}  // namespace itin::viewshed
