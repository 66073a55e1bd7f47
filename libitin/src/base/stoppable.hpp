// Lets a thread's work be stopped in code so deep down that no handle of progress reaches it.
//
//   const Stoppable stoppable(progress);   // as a long call begins
//   stop_if_asked();                       // in the loops of whatever it calls: throws Cancelled
//
// parallel_for hands it on to the threads that it uses.
#pragma once

#include <itin/progress.hpp>

namespace itin {

/// While one lives, what its thread works on can be stopped by `progress`, which must outlive it; null: by none.
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

/// The handle that may stop this thread, or null.
const Progress* stopper();

/// Throws Cancelled where this thread has been asked to stop. A few nanoseconds.
inline void stop_if_asked() {
  if (const Progress* const progress = stopper()) progress->throw_if_cancelled();
}

}  // namespace itin
