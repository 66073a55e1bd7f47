// Progress on a stream that nobody can write to.
#include "program/stderr_progress.hpp"

#include <chrono>
#include <fcntl.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

namespace itin::cli {
namespace {

/// Lets standard error lead to a full disk for as long as the object lives.
class FullStderr {
 public:
  FullStderr() : kept_(dup(STDERR_FILENO)) {
    const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
    dup2(full, STDERR_FILENO);
    close(full);
  }
  ~FullStderr() {
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  FullStderr(const FullStderr&) = delete;
  FullStderr& operator=(const FullStderr&) = delete;

 private:
  int kept_;
};

TEST(StderrProgress, DoesNotEndACallThatCannotShowIt) {
  const FullStderr full;
  StderrProgress progress(StderrProgress::Style::kTerminal);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  EXPECT_NO_THROW(progress.report("reading", 0.5));
  EXPECT_NO_THROW(progress.clear());
}

}  // namespace
}  // namespace itin::cli
