// Judges sight lines by an envelope: certainly visible, certainly hidden, or undecided.
//
//   const EnvelopeScene scene(envelop(...), request, tiles, Voids::kDoubt);
//   const CertifiedPass pass(scene, grid, tiles);
//   const auto work = pass.begin(tile_index);
//   pass.judge(scene.look_from(eye), values, *work, [](const Doubtful& d) { ... });
//
// The target stands between the lower and the upper surface at its cell's centre. A line to the lowest target that
// clears the upper surface sees whatever the full surface is; one to the highest target that the lower surface hides
// does not.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include <viewshed/viewshed.hpp>

#include "bounds/triangle_bins.hpp"
#include "line/cell_tiles.hpp"
#include "request/eye.hpp"
#include "request/void_shadow.hpp"
#include "scene/rays/scene.hpp"
#include "scene/rays/upper_scene.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {

class EnvelopeScene {
 public:
  /// `tiles` must outlive it.
  EnvelopeScene(Envelope envelope, const Request& request, const RasterGrid& tiles, Voids voids);
  EnvelopeScene(const EnvelopeScene&) = delete;
  EnvelopeScene& operator=(const EnvelopeScene&) = delete;

  /// An eye that looks at this scene.
  struct Look {
    Eye eye;
    double upper = 0;  ///< grid units: the upper surface there, or -infinity where there is none
    std::optional<VoidShadow> shadow = std::nullopt;  ///< unless voids are passed
  };
  Look look_from(const Eye& eye) const;

  Envelope envelope;
  Scene lower;
  UpperScene upper;
  TriangleBins bins;
  std::optional<TriangleBins> ground_bins;  ///< of the bare ground, where the envelope has it
  Voids voids;
  bool exact;   ///< both surfaces are the full one, of level 0
  double drop;  ///< by curvature, grid units for a squared grid unit

 private:
  /// The upper surface's height, grid units; -infinity where there is none.
  double upper_height(const Eye& eye, std::span<const std::uint32_t> triangles) const;

  const RasterGrid& tiles_;
};

/// Lines of a packet that are not decided, to their lowest targets.
struct Doubtful {
  const SightLines& lines;    ///< active: the undecided
  unsigned starts_under = 0;  ///< of these, where the eye is not above the upper surface
  unsigned ends_under = 0;    ///< or the target is not
  std::size_t row, column;    ///< of the packet in its tile
};

/// Cells of a tile: rows and columns from the first to the last.
struct CellBlock {
  std::size_t row0, row1, column0, column1;
};

class CertifiedPass {
 public:
  CertifiedPass(const EnvelopeScene& scene, const RasterGrid& grid, const RasterGrid& tiles);

  /// Cells along the side of the smallest block that is decided as a whole.
  static constexpr std::size_t kBlockSide = 8, kBlocks = Tile::kSide / kBlockSide;
  /// One value per block of a tile, row by row.
  using BlockValues = std::array<double, kBlocks * kBlocks>;

  /// Holds what a tile's cells share between observers.
  struct TileWork {
    TileWork(const Grid& units, const RasterGrid& grid, const Tile& t) : tile(t), centres(units, grid, t) {}
    Tile tile;
    TileCentres centres;
    TileValues<double> low;   ///< the least height of what targets stand on, grid units
    TileValues<double> high;  ///< the upper surface
    BlockValues highest;      ///< that targets may stand on in each block; -infinity where there is no surface
    Occluder occluder;
    std::uint64_t rays = 0;
  };
  std::unique_ptr<TileWork> begin(std::size_t tile) const;

  /// Verdict::kUndecided cells of `values` become Verdict::kVisible, Verdict::kHidden or Verdict::kOutside, or stay.
  /// `doubtful` is called with those that stay, and may decide them in `values`.
  using OnDoubtful = std::function<void(const Doubtful&)>;
  void judge(const EnvelopeScene::Look& look, TileValues<Verdict>& values, TileWork& work,
             const OnDoubtful& doubtful) const;

 private:
  struct Packet;
  void hide_quarters(const EnvelopeScene::Look& look, TileValues<Verdict>& values, TileWork& work, std::size_t row,
                     std::size_t column, std::size_t side) const;
  bool aim(const EnvelopeScene::Look& look, const TileWork& work, const CellBlock& block, unsigned first,
           SightLines& lines) const;
  void fill(const EnvelopeScene::Look& look, TileValues<Verdict>& values, const TileWork& work, Packet& packet) const;

  const EnvelopeScene& scene_;
  const RasterGrid& grid_;
  const RasterGrid& tiles_;
};

}  // namespace itin::viewshed
