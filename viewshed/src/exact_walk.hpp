// The exact answer for sight lines that a scene of the full surface leaves open.
#pragma once

#include "certified_pass.hpp"

namespace itin::viewshed {

/// One bit for each active line that is hidden, over a scene of level 0, which only has to be complete where the upper
/// surface comes near the lines. `starts_under` and `ends_under` are as in Doubtful.
unsigned hidden_exactly(const EnvelopeScene& scene, const SightLines& lines, unsigned starts_under,
                        unsigned ends_under);

/// Decides every line of `doubtful` in `values` so.
void walk(const EnvelopeScene& scene, const Doubtful& doubtful, TileValues<std::uint8_t>& values);

}  // namespace itin::viewshed
