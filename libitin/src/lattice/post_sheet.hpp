// The heights of a rectangle of a lattice's posts, as a leaf has them.
//
//   if (const auto sheet = PostSheet::of(posts, lattice)) sheet->row(3)[0]   // the westernmost post of the lattice's
//   row 3
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include <itin/lattice_tin.hpp>

#include "lattice/lattice_frame.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

struct PostSheet {
  PostHeights posts;
  std::uint32_t first_column = 0;  ///< the westernmost of the posts that are on the lattice, counted among `posts`
  std::uint32_t last_row = 0;      ///< the row of the lattice, perhaps beyond its end, of the southernmost posts
  PlaceBox places;                 ///< those of the lattice

  /// Returns the posts as a sheet of the lattice; nothing where they are not neighbours on it, or none is within it.
  static std::optional<PostSheet> of(PostHeights posts, const LatticeTin& lattice);

  /// Returns the heights of one of the lattice's rows within `places`, from places.west on.
  const std::int32_t* row(std::uint32_t row) const {
    return posts.heights.data() + std::size_t{last_row - row} * posts.columns + first_column;
  }
};

}  // namespace itin
