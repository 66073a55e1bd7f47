#include "scene/rays/ray_sieve.hpp"

#include <cstdint>
#include <cstring>

namespace itin::viewshed {

namespace {

// What follows is compiled once for each set of instructions.

namespace baseline {
#define ITIN_INSTRUCTIONS
constexpr unsigned kInVector = 4;
#include "scene/rays/ray_sieve_lanes.inc"
#undef ITIN_INSTRUCTIONS
}  // namespace baseline

#ifdef __x86_64__
namespace avx2 {
#define ITIN_INSTRUCTIONS [[gnu::target("avx2")]]
constexpr unsigned kInVector = 8;
#include "scene/rays/ray_sieve_lanes.inc"
#undef ITIN_INSTRUCTIONS
}  // namespace avx2

namespace avx512 {
#define ITIN_INSTRUCTIONS [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]]
constexpr unsigned kInVector = 16;
#include "scene/rays/ray_sieve_lanes.inc"
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
