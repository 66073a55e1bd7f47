#include "exact_walk.hpp"

#include <algorithm>
#include <bit>

#include <viewshed/certified.hpp>

namespace itin::viewshed {

unsigned hidden_exactly(const EnvelopeScene& scene, const SightLines& lines, unsigned starts_under,
                        unsigned ends_under) {
  UpperScene::Stretches stretches;
  scene.upper.find_stretches(lines, starts_under, ends_under, stretches);
  unsigned result = 0;
  for (unsigned active = lines.active; active != 0; active &= active - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(active));
    const bool hidden = std::any_of(stretches[i].begin(), stretches[i].end(), [&](const Stretch& s) {
      return scene.lower.hidden_between(lines, i, s.from, s.to);
    });
    if (hidden) result |= 1U << i;
  }
  return result;
}

void walk(const EnvelopeScene& scene, const Doubtful& doubtful, TileValues<std::uint8_t>& values) {
  const unsigned hidden = hidden_exactly(scene, doubtful.lines, doubtful.starts_under, doubtful.ends_under);
  for (unsigned active = doubtful.lines.active; active != 0; active &= active - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(active));
    const std::size_t cell = (doubtful.row + i / kPacketSide) * Tile::kSide + doubtful.column + i % kPacketSide;
    values[cell] = (hidden >> i & 1) != 0 ? kCertainlyHidden : kCertainlyVisible;
  }
}

}  // namespace itin::viewshed
