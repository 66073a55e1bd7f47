#include "program/interruption.hpp"

#include <atomic>
#include <csignal>
#include <ctime>
#include <unistd.h>

namespace itin::cli {

namespace {

/// When the first signal came, in milliseconds of the monotonic clock; 0 before it.
std::atomic<long long> first_signal{0};
static_assert(std::atomic<long long>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

/// timeout(1) and terminals tell the process and then its group: repetitions this soon are no second wish.
constexpr long long kPatience = 1000;
constexpr int kInterruptedStatus = 130;

extern "C" void note_interruption(int) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const long long milliseconds = 1000LL * now.tv_sec + now.tv_nsec / 1000000 + 1;
  long long none = 0;
  if (first_signal.compare_exchange_strong(none, milliseconds)) return;
  if (milliseconds - none > kPatience) _exit(kInterruptedStatus);
}

}  // namespace

void catch_interruptions() {
  struct sigaction action {};
  action.sa_handler = note_interruption;
  // Restart system calls: a write that fails with EINTR would look like a full disk.
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  // Whoever started us under nohup means us to outlive the terminal.
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

bool interrupted() {
  return first_signal.load(std::memory_order_relaxed) != 0;
}

}  // namespace itin::cli
