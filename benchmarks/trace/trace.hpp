// Which tasks a program's parallel loops have, and how long each takes, on one thread.
//
//   TracedLoop loop(count);
//   for (std::size_t i = 0; i < count; ++i) loop.run(body, i);
//
// The file that ITIN_TRACE names is written as the program ends; benchmarks/peers/trace.py reads it. It is JSON:
//
//   {"others": 0.1, "root": TASK, "serial": [[frame, ...], ...]}
//   TASK is a list of stretches (seconds of processor time) and loops, {"at": [frame, ...], "tasks": [TASK, ...]}.
//   A task that is one stretch stands for itself: 0.25.
//
// `serial` has the call stack, innermost first, at equal distances of processor time outside loops; frames are offsets
// in the executable. `others` is the processor time of threads that are not the program's main one.
#pragma once

#include <cstddef>
#include <functional>

namespace itin::trace {

struct Loop;
struct Task;

class TracedLoop {
 public:
  explicit TracedLoop(std::size_t count);
  ~TracedLoop();
  TracedLoop(const TracedLoop&) = delete;
  TracedLoop& operator=(const TracedLoop&) = delete;

  void run(const std::function<void(std::size_t)>& body, std::size_t i);

 private:
  Task& around_;
  Loop& loop_;
};

}  // namespace itin::trace
