#include "scene/rays/ray_sieve.hpp"

#include <cstdint>
#include <cstring>

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace itin::viewshed {

namespace {

/// One bit of each lane of a vector of truths.
template <class Truths>
unsigned bits_of_lanes(const Truths& lanes) {
  unsigned bits = 0;
  for (unsigned i = 0; i < sizeof lanes / sizeof lanes[0]; ++i) bits |= static_cast<unsigned>(lanes[i] & 1) << i;
  return bits;
}

// What follows is compiled once for each set of instructions.

namespace baseline {
#define ITIN_INSTRUCTIONS
#define ITIN_BITS_OF(lanes) bits_of_lanes(lanes)
constexpr unsigned kRaysInVector = 4;
#include "scene/rays/ray_sieve_lanes.inc"
#undef ITIN_BITS_OF
#undef ITIN_INSTRUCTIONS
}  // namespace baseline

#ifdef __x86_64__
namespace avx2 {
#define ITIN_INSTRUCTIONS ITIN_AVX2
#define ITIN_BITS_OF(lanes) static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(lanes)))
constexpr unsigned kRaysInVector = 8;
#include "scene/rays/ray_sieve_lanes.inc"
#undef ITIN_BITS_OF
#undef ITIN_INSTRUCTIONS
}  // namespace avx2

namespace avx512 {
#define ITIN_INSTRUCTIONS ITIN_AVX512
#define ITIN_BITS_OF(lanes) static_cast<unsigned>(_mm512_movepi32_mask(reinterpret_cast<__m512i>(lanes)))
constexpr unsigned kRaysInVector = 16;
#include "scene/rays/ray_sieve_lanes.inc"
#undef ITIN_BITS_OF
#undef ITIN_INSTRUCTIONS
}  // namespace avx512
#endif

}  // namespace

RaySieve ray_sieve(Instructions instructions) {
  switch (instructions) {
#ifdef __x86_64__
    case Instructions::kAvx512:
      return avx512::sift;
    case Instructions::kAvx2:
      return avx2::sift;
#endif
    default:
      return baseline::sift;
  }
}

}  // namespace itin::viewshed
