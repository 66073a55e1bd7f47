// The one parallel seam. Code above it is written as if there were no threads. oneTBB appears only in
// src/base/parallel.cpp, and the serial build (ITIN_PARALLEL=OFF) runs the same loops in order.
#pragma once

#include <cstddef>
#include <functional>

#include <itin/progress.hpp>

namespace itin {

/// Runs body(i) for i in [0, count), in any order and on any thread. The iterations must not depend on each other.
/// The first exception thrown by a body is rethrown here after the running bodies have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace itin
