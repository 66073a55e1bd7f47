#include "line/instructions.hpp"

#include <array>

namespace itin::viewshed {

std::span<const Instructions> instructions_here() {
  static constexpr std::array kAll{Instructions::kBaseline, Instructions::kAvx2, Instructions::kAvx512};
  static const std::size_t count = [] {
#ifdef __x86_64__
    if (!__builtin_cpu_supports("avx2")) return 1;
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    return wide ? 3 : 2;
#else
    return 1;
#endif
  }();
  return std::span(kAll).first(count);
}

}  // namespace itin::viewshed
