#include "program/interruption.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <semaphore.h>
#include <string>
#include <system_error>
#include <thread>
#include <unistd.h>

#include <itin/error.hpp>
#include <itin/unfinished.hpp>

namespace itin::cli {

namespace {

/// The time of the first signal, in milliseconds of the monotonic clock; 0 before it.
std::atomic<long long> first_signal{0};
static_assert(std::atomic<long long>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
/// Posted when first_signal is set.
sem_t signalled;
/// Set by the thread that ends the program, whether by itself or not.
std::atomic<bool> ending{false};
std::atomic<bool> end_is_expected{false};

/// The time that a call has to stop and clean up. It is less than a second, for the system takes about that long to
/// take back gigabytes.
constexpr std::chrono::milliseconds kTimeToStop{750};
/// The milliseconds within which repeated signals are not a second interruption: timeout(1) and terminals tell the
/// process and then its group.
constexpr long long kPatience = 1000;

extern "C" void note_interruption(int) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const long long milliseconds = 1000LL * now.tv_sec + now.tv_nsec / 1000000 + 1;
  long long none = 0;
  if (first_signal.compare_exchange_strong(none, milliseconds)) {
    sem_post(&signalled);
  } else if (milliseconds - none > kPatience) {
    _exit(kInterruptedStatus);
  }
}

void end_what_does_not_stop() {
  while (sem_wait(&signalled) != 0) {
  }
  std::this_thread::sleep_for(kTimeToStop);
  if (ending.exchange(true)) return;
  remove_unfinished();
  say_interrupted();
  _exit(kInterruptedStatus);
}

}  // namespace

void catch_interruptions() {
  sem_init(&signalled, 0, 0);
  try {
    std::thread(end_what_does_not_stop).detach();
  } catch (const std::system_error&) {
    // The header says what happens without this thread.
  }
  struct sigaction action {};
  action.sa_handler = note_interruption;
  // System calls are restarted: a write that fails with EINTR would look like a full disk.
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  // Whoever started the program under nohup wants it to outlive the terminal.
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

bool interrupted() {
  return first_signal.load(std::memory_order_relaxed) != 0;
}

void expect_interruption() {
  end_is_expected = true;
}

/// This does not write by a stream: the thread that holds its lock may be the one that does not stop. On a terminal the
/// prompt that follows begins a line, behind the ^C that was typed.
void say_interrupted() {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  std::string line = terminal ? "\n" : "";
  if (!end_is_expected) line = (terminal ? "\r\x1b[K" : "") + std::string("itin: error: ") + Cancelled().what() + "\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, line.data(), line.size());
}

void end_interruptions() {
  while (ending.exchange(true)) pause();
}

}  // namespace itin::cli
