// The one parallel seam. Everything above it is written as if there were no threads; oneTBB appears only in
// src/base/parallel.cpp, and the serial build (ITIN_PARALLEL=OFF) runs the same loops in order.
#pragma once

#include <cstddef>
#include <functional>
#include <thread>

#include <itin/progress.hpp>

namespace itin {

/// Runs body(i) for i in [0, count), in any order and on any thread. The iterations must not depend on each other.
/// The first exception thrown by a body is rethrown here after the running bodies have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Does work beside what follows, where a thread is to spare, else not at all: for what is done anyway once it is
/// needed, such as loading a library. Its end is waited for in the destructor. The work must not throw.
class Ahead {
 public:
  explicit Ahead(void (*work)());

 private:
  std::jthread thread_;
};

}  // namespace itin
