// Which cells of a tile some eyes see, over whatever is known of the surface: itself (exact_judge.hpp), or two surfaces
// that enclose it (envelope_judge.hpp).
//
//   const EnvelopeJudge judge(scene, grid, tiles, eyes);
//   lines += judge_tile(judge, tile, eyes.size(),
//                       [&](std::size_t eye, TileValues<Verdict>& values) { ... },                 // what is asked
//                       [&](std::size_t eye, TileValues<Verdict>& values, auto& work) { ... });    // the answer
#pragma once

#include <cstdint>
#include <memory>

#include <viewshed/result.hpp>

#include "line/cell_tiles.hpp"
#include "request/eye.hpp"

namespace itin::viewshed {

/// The places where the targets of a tile's cells may be for an eye, grid units; kNoSurface where none is. Over the
/// full surface `low` and `high` are the same array.
struct TileTargets {
  const TileCentres& centres;
  const TileValues<double>& low;
  const TileValues<double>& high;
  bool exact() const { return &low == &high; }
};

class TileJudge {
 public:
  TileJudge() = default;
  TileJudge(const TileJudge&) = delete;
  TileJudge& operator=(const TileJudge&) = delete;
  virtual ~TileJudge() = default;

  /// One thread's work on one tile.
  class Work {
   public:
    Work() = default;
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    virtual ~Work() = default;

    /// Turns Verdict::kUndecided cells to Verdict::kVisible, Verdict::kHidden or Verdict::kOutside, or leaves them.
    /// Returns how many sight lines that took.
    virtual std::uint64_t judge(std::size_t eye, TileValues<Verdict>& values) = 0;
    /// The targets of the eye that was judged last. Valid until the next eye is judged.
    virtual TileTargets targets() = 0;
  };
  /// Begins a tile of the grid that is judged. Safe for concurrent use.
  virtual std::unique_ptr<Work> begin(std::size_t tile) const = 0;
  virtual const Eye& eye(std::size_t number) const = 0;
};

/// Judges a tile for one eye after another; what all eyes share is made once anything is asked. open(eye, values) gets
/// values that are all Verdict::kOutside, turns what is asked to Verdict::kUndecided, and returns whether anything is.
/// If so, close(eye, values, work) is called with what has become of the values. Returns how many sight lines that
/// took.
template <class Open, class Close>
std::uint64_t judge_tile(const TileJudge& judge, std::size_t tile, std::size_t eyes, const Open& open,
                         const Close& close) {
  std::unique_ptr<TileJudge::Work> work;
  std::uint64_t lines = 0;
  for (std::size_t eye = 0; eye < eyes; ++eye) {
    TileValues<Verdict> values;
    values.fill(Verdict::kOutside);
    if (!open(eye, values)) continue;
    if (!work) work = judge.begin(tile);
    lines += work->judge(eye, values);
    close(eye, values, *work);
  }
  return lines;
}

}  // namespace itin::viewshed
