#include "program/thread_limit.hpp"

#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>

namespace itin::cli {

void require_threads() {
  const int wanted = thread_count() == 1 ? 1 : 3 * thread_count();
  std::latch all_there(1);
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(wanted));
  std::string refusal;
  try {
    for (int i = 1; i < wanted; ++i) threads.emplace_back([&] { all_there.wait(); });
  } catch (const std::system_error& error) {
    refusal = error.code().message();
  }
  all_there.count_down();
  for (std::thread& thread : threads) thread.join();
  if (refusal.empty()) return;
  throw Error(
      fmt::format("{} of {} threads can be had ({}); raise the limits on processes and memory (ulimit -u, -v, "
                  "-s), or give fewer --threads; 1 is the main thread alone",
                  threads.size() + 1, wanted, refusal));
}

}  // namespace itin::cli
