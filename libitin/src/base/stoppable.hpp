// Lets a thread's work be stopped in code so deep down that no progress handle reaches it.
//
//   const Stoppable stoppable(progress);   // as a long call begins
//   stop_if_asked();                       // in the loops of whatever it calls: throws Cancelled
//
// parallel_for passes the handle on to the threads that it uses.
#pragma once

#include <itin/progress.hpp>

namespace itin {

/// Lets `progress`, which must outlive it, stop what this thread works on, for as long as the object lives; null:
/// nothing can stop it.
class Stoppable {
 public:
  explicit Stoppable(const Progress* progress);
  explicit Stoppable(const Progress& progress) : Stoppable(&progress) {}
  ~Stoppable();
  Stoppable(const Stoppable&) = delete;
  Stoppable& operator=(const Stoppable&) = delete;

 private:
  const Progress* before_;
};

/// Returns the handle that may stop this thread, or null.
const Progress* stopper();

/// Throws Cancelled where this thread has been asked to stop. Cost: a few nanoseconds.
inline void stop_if_asked() {
  if (const Progress* const progress = stopper()) progress->throw_if_cancelled();
}

}  // namespace itin
