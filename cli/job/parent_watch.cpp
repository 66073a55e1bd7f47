#include "job/parent_watch.hpp"

#include <array>
#include <csignal>
#include <sys/prctl.h>
#include <thread>
#include <unistd.h>

#include <itin/error.hpp>

namespace itin::cli {

void end_with_parent() {
  const pid_t parent = ::getppid();
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  // A parent that died before that has left the process to another one.
  if (parent == 1 || ::getppid() != parent) throw Error("the process that called this one has ended");
  std::thread([] {
    std::array<char, 64> ignored{};
    while (::read(STDIN_FILENO, ignored.data(), ignored.size()) > 0) {
    }
    ::kill(::getpid(), SIGTERM);
  }).detach();
}

}  // namespace itin::cli
