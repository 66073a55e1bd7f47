// Which cells of a tile some eyes see, over whatever is known of the surface: itself (exact_judge.hpp), or two surfaces
// that enclose it (envelope_judge.hpp).
//
//   const ExactJudge judge(surface, eyes, NoData::kClear);
//   const auto work = judge.begin(tile);
//   for (std::size_t eye = 0; eye < eyes.size(); ++eye) lines += work->judge(eye, values);
#pragma once

#include <cstdint>
#include <memory>

#include <viewshed/viewshed.hpp>

#include "line/cell_tiles.hpp"
#include "request/eye.hpp"

namespace itin::viewshed {

/// Where the targets of a tile's cells may be for an eye, grid units; kNoSurface where none is. Over the full surface
/// `low` and `high` are one.
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

    /// Verdict::kUndecided cells become Verdict::kVisible, Verdict::kHidden or Verdict::kOutside, or stay. Returns how
    /// many sight lines that took.
    virtual std::uint64_t judge(std::size_t eye, TileValues<Verdict>& values) = 0;
    /// Those of the eye that was judged last. Valid until the next one is.
    virtual TileTargets targets() = 0;
  };
  /// `tile` is one of those of the grid that it judges. Safe for concurrent use.
  virtual std::unique_ptr<Work> begin(std::size_t tile) const = 0;
  virtual const Eye& eye(std::size_t number) const = 0;
};

}  // namespace itin::viewshed
