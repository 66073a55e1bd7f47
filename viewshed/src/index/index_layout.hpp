// What an index is made of, before anything is looked at: its cells, and how their observers look about.
//
//   const IndexLayout layout = lay_out_index(store, request, progress);
//   if (layout.sample.rays > 0) ...
//
// The layout depends on the store and the request alone, and so is the same for every part of an index, whoever
// computes it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <itin/lattice_reader.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/visibility_index.hpp>

namespace itin::viewshed {

struct IndexLayout {
  RasterGrid grid;
  IndexSample sample;
  std::uint32_t rings = 0;  ///< into which rays divide the radius, each as wide as the distance between posts at most
};

/// Bytes of the rasters for each cell.
inline constexpr std::uint64_t kBytesPerIndexCell = 24;

/// Throws InputError for values out of range, where the memory does not hold the rasters, and where rays are asked for
/// that cannot be.
IndexLayout lay_out_index(const Store& store, const IndexRequest& request, Progress& progress);

/// Where the centres of cells lie among the posts of a lattice: `step` posts apart, each as far from the post to its
/// north-west as all others.
struct ObserverPosts {
  std::int64_t column = 0, row = 0;  ///< the post at the first cell's centre, or to the north-west of it
  std::int64_t step = 1;
  double east = 0, south = 0;  ///< from that post, as shares of the way to the next, in [0, 1)
};
/// Returns nothing where cells are no multiple of what lies between posts.
std::optional<ObserverPosts> observers_among_posts(const RasterGrid& cells, const LatticeTin& lattice);

/// Returns the posts under all sight lines of an index, none of which is read; null where its surface is no lattice.
std::unique_ptr<LatticeReader> posts_under_index(const Store& store, const IndexRequest& request,
                                                 const RasterGrid& grid, Progress& progress);

}  // namespace itin::viewshed
