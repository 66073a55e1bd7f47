// Loops over threads: within each other, and when one throws.
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <itin/beside.hpp>
#include <itin/parallel.hpp>

#include "base/stoppable.hpp"

namespace itin {
namespace {

TEST(ParallelFor, RunsEachIterationOnce) {
  std::vector<std::atomic<int>> runs(1000);
  parallel_for(runs.size(), [&](std::size_t i) { ++runs[i]; });
  for (const auto& count : runs) EXPECT_EQ(count, 1);
}

TEST(ParallelFor, Rethrows) {
  EXPECT_THROW(parallel_for(100,
                            [](std::size_t i) {
                              if (i == 37) throw std::runtime_error("37");
                            }),
               std::runtime_error);
}

TEST(ParallelFor, CanBeStoppedOnAllItsThreads) {
  struct Stopped final : public Progress {
    void report(std::string_view, double) override {}
    bool cancelled() const override { return true; }
  } stopped;
  std::atomic<int> ran = 0;
  const auto work = [&](std::size_t) {
    stop_if_asked();
    ++ran;
  };
  {
    const Stoppable stoppable(stopped);
    for (int round = 0; round < 20; ++round) EXPECT_THROW(parallel_for(100, work), Cancelled);
  }
  EXPECT_EQ(ran, 0);
  parallel_for(100, work);
  EXPECT_EQ(ran, 100);
}

TEST(Beside, GivesWhatTheWorkGives) {
  std::future<int> sum = beside([] { return 40 + 2; });
  std::future<void> fails = beside([] { throw std::runtime_error("37"); });
  EXPECT_EQ(sum.get(), 42);
  EXPECT_THROW(fails.get(), std::runtime_error);
}

TEST(Beside, WaitsForWorkThatNobodyAsksAbout) {
  if (!has_thread_to_spare()) GTEST_SKIP() << "threads: there is one";
  std::atomic<bool> done = false;
  {
    const std::future<void> work = beside([&] { done = true; });
  }
  EXPECT_TRUE(done);
}

TEST(Beside, DoesTheWorkOnTheOnlyThreadWhenItIsAskedFor) {
  set_thread_count(1);
  std::thread::id thread;
  const auto work = [&] { thread = std::this_thread::get_id(); };
  { const std::future<void> dropped = beside(work); }
  EXPECT_EQ(thread, std::thread::id());
  beside(work).get();
  EXPECT_EQ(thread, std::this_thread::get_id());
  set_thread_count(0);
}

TEST(ParallelFor, StaysOnItsThreadWhereItIsTheOnlyOne) {
  set_thread_count(1);
  std::vector<std::thread::id> threads(100);
  parallel_for(threads.size(), [&](std::size_t i) { threads[i] = std::this_thread::get_id(); });
  set_thread_count(0);
  for (const std::thread::id& id : threads) EXPECT_EQ(id, std::this_thread::get_id());
}

/// How many threads take part in loops within each other.
std::size_t threads_of_a_loop() {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  parallel_for(40, [&](std::size_t) {
    parallel_for(20, [&](std::size_t) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
  });
  return threads.size();
}

TEST(ThreadLimit, BindsTheCallsOfOneThread) {
  set_thread_count(6);
  const int before = thread_count();
  {
    const ThreadLimit three(3);
    EXPECT_EQ(thread_count(), 3);
#ifndef __SANITIZE_THREAD__  // under which each loop has threads of its own
    EXPECT_LE(threads_of_a_loop(), 3U);
#endif
    int beside = 0;
    std::jthread([&] { beside = thread_count(); }).join();
    EXPECT_EQ(beside, before);
    {
      const ThreadLimit one(1);
      EXPECT_EQ(threads_of_a_loop(), 1U);
    }
    EXPECT_EQ(thread_count(), 3);
    const ThreadLimit more(100);
    EXPECT_EQ(thread_count(), 3) << "no more than it had";
  }
  EXPECT_EQ(thread_count(), before);
  set_thread_count(0);
  EXPECT_THROW(ThreadLimit(0), InputError);
}

// A body that goes on while another one throws must find its own loops whole.
TEST(ParallelFor, LoopsWithinAreWholeWhateverOthersThrow) {
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> begun = 0, broken = 0;
    const auto body = [&](std::size_t i) {
      if (i == 1) {
        // Waits for another thread to be at its loops, where there is one.
        for (int k = 0; k < 100 && begun == 0; ++k) std::this_thread::sleep_for(std::chrono::microseconds(100));
        throw std::runtime_error("1");
      }
      for (int k = 0; k < 20; ++k) {
        std::atomic<int> runs = 0;
        ++begun;
        parallel_for(50, [&](std::size_t) {
          std::this_thread::sleep_for(std::chrono::microseconds(2));
          ++runs;
        });
        if (runs != 50) ++broken;
      }
    };
    EXPECT_THROW(parallel_for(2, body), std::runtime_error);
    ASSERT_EQ(broken, 0) << "round " << round;
  }
}

}  // namespace
}  // namespace itin
