// The surface over which sight lines are decided: a Tin or, where a raster's full surface was asked for, its posts
// alone.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <itin/detail.hpp>
#include <itin/lattice_reader.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

struct RetrievedSurface {
  Tin tin;                                 ///< empty where the surface is a lattice, until it is listed
  std::unique_ptr<LatticeReader> lattice;  ///< else null
  Box extent;                              ///< the box of all the data that it is a part of, metres; empty: its own box

  std::size_t triangle_count() const { return lattice ? lattice->lattice().triangle_count() : tin.triangles.size(); }
  const RetrievalStatistics& statistics() const { return lattice ? lattice->lattice().statistics : tin.statistics; }
  /// Returns every triangle; those of a lattice are listed at the first call.
  const Tin& listed(Progress& progress) {
    if (lattice && tin.triangles.empty()) {
      lattice->read_all(progress);
      tin = lattice->lattice().tin();
    }
    return tin;
  }
};

/// A number of posts that no lattice exceeds.
inline constexpr std::uint64_t kAnyLattice = std::uint64_t{1} << 31;
/// Bytes that a lattice takes while it is swept.
inline constexpr std::uint64_t kBytesPerPost = 9;

/// Returns a box that holds all data of the store, metres.
Box extent_of(const Store& store);

/// Retrieves the surface that triangulate() makes, as a lattice if it is one, at full detail and of at most
/// `most_posts` posts.
RetrievedSurface retrieve_surface(const Store& store, const Window& window, const Detail& detail,
                                  const ThemeChoice& themes, std::uint64_t most_posts, Progress& progress);

/// Retrieves such a lattice; returns nothing where the surface is none. Heights that are not read now are read later,
/// while the store is open.
std::optional<RetrievedSurface> retrieve_lattice(const Store& store, const Window& window, const Detail& detail,
                                                 const ThemeChoice& themes, LatticeReader::Heights heights,
                                                 std::uint64_t most_posts, Progress& progress);

/// Computes as compute() on a Tin does. A lattice takes a tenth of the memory and a third of the time, in modes that
/// ask for sight lines alone. `ground` may be null. Reads those heights of the lattice that are asked for and have not
/// been read, so it must not run in several threads at once.
Result compute(const RetrievedSurface& surface, const Tin* ground, const Request& request, Progress& progress,
               const CellSink& sink = {});

}  // namespace itin::viewshed
