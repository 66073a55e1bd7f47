#include "interruption.hpp"

#include <atomic>
#include <csignal>

namespace itin::cli {

namespace {

std::atomic<bool> interruption{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void note_interruption(int) {
  interruption.store(true, std::memory_order_relaxed);
}

}  // namespace

void catch_interruptions() {
  struct sigaction action {};
  action.sa_handler = note_interruption;
  // Restart system calls: a write that fails with EINTR would look like a full disk. Reset the handler: a second
  // signal must end a process that does not listen.
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  // Whoever started us under nohup means us to outlive the terminal.
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() {
  return interruption.load(std::memory_order_relaxed);
}

}  // namespace itin::cli
