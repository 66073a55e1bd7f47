// A task as it is traced: stretches of work and loops, in their order.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace itin::trace {

/// Return addresses, innermost first, as offsets in the executable.
using Frames = std::vector<std::uintptr_t>;

struct Loop;

/// `seconds` of work, after which the loop runs, where there is one.
struct Stretch {
  double seconds = 0;
  std::unique_ptr<Loop> loop;
};

struct Task {
  std::vector<Stretch> stretches;
};

struct Loop {
  Frames at;
  std::vector<Task> tasks;
};

}  // namespace itin::trace
