#include "job/job_claim.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "job/runner_name.hpp"

namespace itin::viewshed {

namespace {

/// A claim is touched this often within the time that it lasts.
constexpr double kTouches = 4;

}  // namespace

JobClaim::JobClaim(const JobFolder& job, std::size_t task, double patience_s)
    : job_(job), task_(task), file_(job.name_path("claims", task) + "." + runner_name()) {
  const int file = ::open(file_.path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) throw JobError(JobEnd::kTryAgain, file_.path() + ": cannot be written: " + std::strerror(errno));
  ::close(file);
  toucher_ = std::thread([this, patience_s] { keep_touching(patience_s / kTouches); });
}

JobClaim::~JobClaim() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_all();
  toucher_.join();
}

bool JobClaim::is_first() const {
  return job_.first_claim(task_) == file_.path();
}

bool JobClaim::is_held() const {
  return ::access(file_.path().c_str(), F_OK) == 0;
}

void JobClaim::keep_touching(double every_s) {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, std::chrono::duration<double>(every_s), [this] { return end_; }))
    // The time is the file server's, not this machine's.
    ::utimensat(AT_FDCWD, file_.path().c_str(), nullptr, 0);
}

}  // namespace itin::viewshed
