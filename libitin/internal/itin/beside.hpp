// Runs work beside the code that follows.
//
//   std::future<Table> table = beside([&] { return read(path); });
//   decide();
//   use(table.get());
#pragma once

#include <future>
#include <type_traits>
#include <utility>

namespace itin {

/// Tells whether calls may use more than one thread.
bool has_thread_to_spare();

/// Starts work on a thread of its own. Without a thread to spare, the work waits for get(), and is never done if nobody
/// calls get(). Exceptions of the work are thrown by get(). The destructor waits for work that has begun.
template <class Work>
std::future<std::invoke_result_t<Work>> beside(Work work) {
  constexpr auto kEither = std::launch::async | std::launch::deferred;
  return std::async(has_thread_to_spare() ? kEither : std::launch::deferred, std::move(work));
}

}  // namespace itin
