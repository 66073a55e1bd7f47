#include "trace/call_stack.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <ctime>
#include <dlfcn.h>
#include <execinfo.h>
#include <stdexcept>
#include <unistd.h>
#include <vector>

namespace itin::trace {

namespace {

constexpr int kDepth = 40;
constexpr std::size_t kMostSamples = 50'000;

struct Sample {
  std::array<void*, kDepth> frames;
  int depth = 0;
};

std::atomic<std::size_t> taken = 0;
const volatile int* paused = nullptr;

/// The samples are made before the first signal, because a handler must not allocate, and are gone after whoever began
/// to sample.
std::vector<Sample>& samples() {
  static std::vector<Sample> all(kMostSamples);
  return all;
}

void take_sample(int) {
  const std::size_t i = taken;
  if (*paused != 0 || i == kMostSamples) return;
  samples()[i].depth = backtrace(samples()[i].frames.data(), kDepth);
  taken = i + 1;
}

Frames frames_of(const Sample& sample) {
  static void* const executable = [] {
    Dl_info here;
    dladdr(reinterpret_cast<void*>(&call_stack), &here);
    return here.dli_fbase;
  }();
  Frames frames;
  for (int i = 0; i < sample.depth; ++i) {
    Dl_info of;
    if (dladdr(sample.frames[static_cast<std::size_t>(i)], &of) == 0 || of.dli_fbase != executable) continue;
    const auto address = reinterpret_cast<std::uintptr_t>(sample.frames[static_cast<std::size_t>(i)]);
    // A return address is that of the instruction after the call.
    frames.push_back(address - reinterpret_cast<std::uintptr_t>(executable) - 1);
  }
  return frames;
}

}  // namespace

Frames call_stack() {
  Sample sample;
  sample.depth = backtrace(sample.frames.data(), kDepth);
  return frames_of(sample);
}

void sample_call_stacks(double period_seconds, const volatile int& unwanted) {
  paused = &unwanted;
  samples();
  call_stack();  // the first call loads what later ones need
  struct sigaction action {};
  action.sa_handler = take_sample;
  action.sa_flags = SA_RESTART;
  sigaction(SIGPROF, &action, nullptr);
  sigevent event{};
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = SIGPROF;
  event._sigev_un._tid = gettid();
  timer_t timer = nullptr;
  const auto nanoseconds = static_cast<long>(period_seconds * 1e9);
  const itimerspec every{{0, nanoseconds}, {0, nanoseconds}};
  if (timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &timer) != 0 || timer_settime(timer, 0, &every, nullptr) != 0) {
    throw std::runtime_error("no timer of processor time");
  }
}

std::vector<Frames> sampled_call_stacks() {
  std::signal(SIGPROF, SIG_IGN);
  const std::size_t count = taken;
  std::vector<Frames> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(frames_of(samples()[i]));
  return result;
}

}  // namespace itin::trace
