// The functions of the executable that are being called.
#pragma once

#include "trace/task.hpp"

namespace itin::trace {

/// Returns the functions that this thread is calling now.
Frames call_stack();

/// From now on remembers the call stack of this thread after every `period_seconds` of its processor time, while
/// `unwanted` is 0. To be called once, before anything is traced.
void sample_call_stacks(double period_seconds, const volatile int& unwanted);
/// Ends the sampling, and returns what has been remembered.
std::vector<Frames> sampled_call_stacks();

}  // namespace itin::trace
