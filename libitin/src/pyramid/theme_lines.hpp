// Lines on their way into a store: planar already, and to be laid on the ground.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>
#include <itin/theme.hpp>

#include "features/planar.hpp"
#include "pyramid/source_index.hpp"
#include "pyramid/working_index.hpp"

namespace itin {

/// The lines of all themes; owner i is theme i + 1.
struct ThemeLines {
  PlanarLines lines;
  std::vector<bool> terrain;           ///< by owner: whether they are part of the full surface
  std::vector<ThemeKind> kinds;        ///< by owner
  std::vector<std::uint16_t> sources;  ///< by vertex: where it comes from

  bool empty() const { return lines.edges.empty(); }
};

/// What of them lies on the ground.
struct PlacedLines {
  std::vector<Segment> terrain;           ///< part of the full surface; their ends are points of the index
  std::vector<Segment> features;          ///< on it
  std::vector<std::uint64_t> ends;        ///< of both, ascending Morton codes
  std::vector<std::uint64_t> on_outline;  ///< of these, those on it
  std::vector<std::uint64_t> strays;      ///< vertices of terrain lines beyond the ground
  std::uint64_t left_out = 0;             ///< segments beyond the ground, or that leave it
};

/// Leaves out every segment that is not wholly on the ground of the given sources, whose outline is `outline`.
/// `gap_bases` in grid units. The index must have no segments yet.
PlacedLines place_lines(const ThemeLines& lines, const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                        const Sources& ground, const std::vector<std::array<double, 4>>& gap_bases,
                        const std::vector<Segment>& outline, Progress& progress);

/// The full surface's heights at positions (ascending Morton codes) on the ground that have no vertex of it; those that
/// have are left out.
std::vector<GridPoint> drape(const std::vector<std::uint64_t>& codes, const WorkingIndex& index,
                             const std::vector<CurveRange>& tiles, Progress& progress);

}  // namespace itin
