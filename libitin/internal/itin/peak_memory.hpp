// How much memory this process has taken.
#pragma once

#include <cstdint>
#include <sys/resource.h>

namespace itin {

/// Returns the most that this process has had in memory so far.
inline std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace itin
