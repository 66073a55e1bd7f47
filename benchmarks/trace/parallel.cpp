// The parallel seam of a program whose loops are traced. Loops run in order, on one thread, but are divided as if there
// were as many threads as --threads says (32 where it does not), so that the trace tells what these would do.
#include <memory>

#include <tbb/global_control.h>

#include <itin/beside.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>

#include "trace/trace.hpp"

namespace itin {

namespace {

int divided_for = 32;

/// Embree has threads of its own, from oneTBB.
const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  trace::TracedLoop loop(count);
  for (std::size_t i = 0; i < count; ++i) loop.run(body, i);
}

bool has_thread_to_spare() {
  return false;
}

void set_thread_count(int threads) {
  if (threads > 0) divided_for = threads;
}

int thread_count() {
  return divided_for;
}

class ThreadLimit::Impl {};

ThreadLimit::ThreadLimit(int threads) {
  if (threads < 1) throw InputError("threads: give at least 1");
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace itin
