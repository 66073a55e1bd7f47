// The surface of a window that is a lattice (lattice_tin.hpp); its heights are read where they are asked for.
//
//   if (const auto reader = LatticeReader::open(store, window, themes, LatticeReader::Heights::kNone, most, progress))
//   {
//     reader->read(tiles, progress);             // by their number in reader->lattice().tiles
//     ...
//   }
//
// From the first, the reader has proved that the surface is a lattice, and knows where there is ground, and how high
// the posts of each tile are at most.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <itin/lattice_tin.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/window.hpp>

namespace itin {

class LatticeReader {
 public:
  /// Which tiles with ground have heights after opening.
  enum class Heights : std::uint8_t { kNone, kAll };

  /// Opens the window as triangulate_lattice() does; nothing where that returns nothing. The store must outlive the
  /// reader. Cost: with all heights, about twice that without them.
  static std::unique_ptr<LatticeReader> open(const Store& store, const Window& window, const ThemeChoice& themes,
                                             Heights heights, std::uint64_t most_posts, Progress& progress);
  /// Tells from a few blocks whether open() may find a lattice.
  static bool may_open(const Store& store, const Window& window, const ThemeChoice& themes, std::uint64_t most_posts);
  ~LatticeReader();
  LatticeReader(const LatticeReader&) = delete;
  LatticeReader& operator=(const LatticeReader&) = delete;

  const LatticeTin& lattice() const;
  /// Moves the lattice out; the reader may not be used afterwards.
  LatticeTin take();

  /// Returns a height, grid units, that no post of the tile exceeds. Precondition: opened without heights.
  std::int32_t highest(std::uint32_t tile) const;

  /// Reads the heights of tiles with ground that have none yet: all of them, or none where it throws. Reports nothing.
  /// Cost: reads the tiles' blocks; blocks at their borders may have been read before. Not for several threads at once;
  /// the call itself uses all threads.
  void read(std::span<const std::uint32_t> tiles, Progress& progress);
  /// Reads the heights of all tiles that have none yet.
  void read_all(Progress& progress);

 private:
  class Work;
  explicit LatticeReader(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

}  // namespace itin
