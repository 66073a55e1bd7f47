// Writes a store of a fractal surface as an importer would, except that it knows every level beforehand: nearly at the
// rate of the encoder, in about 75 MB and 64 bytes for each 82 m by 82 m of ground.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/progress.hpp>

namespace itin::huge {

struct FractalStoreOptions {
  double side_km = 1;
  std::uint64_t seed = 1994;
  std::vector<double> tolerances{0, 0.5, 1, 2, 4, 8, 16, 32};  ///< metres, as the importer's
};

struct FractalStoreReport {
  std::int32_t side_m = 0;
  std::uint64_t posts = 0;
  double lowest = 0, highest = 0;  ///< metres
};

/// Writes a square of posts 1 m apart. Its side is rounded up to a multiple of the coarsest level's spacing, so that
/// its border's ends belong to every level. Any number of threads writes equal bytes, except for the time noted. Throws
/// InputError, FileError, Cancelled; until it returns, the file at `path` is what it was.
FractalStoreReport write_fractal_store(const std::string& path, const FractalStoreOptions& options, Progress& progress);

}  // namespace itin::huge
