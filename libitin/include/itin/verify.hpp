// Whether a store keeps its promises about surfaces: certificates hold, and features are no higher than its index says.
//
//   const Store store("wales.itin");
//   std::vector<Damage> damage = check(store, progress);  // that every byte is what was written
//   if (damage.empty()) damage = verify(store, {}, progress).damage;
//
// check() finds what disk and network do to a file. verify() also finds what a faulty program, or a hand, has written
// under right checksums: it makes the surfaces of all levels anew, tile by tile, and compares them.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

namespace itin {

struct VerifyOptions {
  /// About how many tiles of the ground, and of each part of a raised theme, are verified, evenly spread along the
  /// Morton curve. 0: all of them.
  std::size_t sample = 0;
};

struct Verification {
  std::vector<Damage> damage;        ///< empty where every promise holds
  std::uint64_t tiles = 0;           ///< tiles of the ground, and of the raised features on it
  std::uint64_t tiles_verified = 0;  ///< all, or the sample
};

/// Verifies for every level and index cell that there is a certificate wherever there is ground, and that
/// T_k + lo <= T_0 <= T_k + hi all over the cell, to a thousandth of a grid step. Verifies that the directory's
/// statements about levels agree with its cells. For every cell of every part of a raised theme, verifies that no
/// feature of that part rises higher above T_0 within the cell than the cell says, to two grid steps, as the ground
/// under features is rounded.
///
/// The store must be sound by check(). Memory: the surfaces of a tile of some 32,000 vertices per thread. Cost: as much
/// as the import took to verify its levels, about 10 microseconds per vertex. Throws FileError, CorruptStore and
/// Cancelled.
Verification verify(const Store& store, const VerifyOptions& options, Progress& progress);

}  // namespace itin
