// A task that this process works on, for others to see.
//
//   const JobClaim claim(job, task, patience);
//   ...                                         // touched from time to time, until the end of its life
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

#include <itin/unfinished.hpp>
#include <viewshed/job.hpp>

namespace itin::viewshed {

class JobClaim {
 public:
  /// Throws JobError where the file cannot be written.
  JobClaim(const JobFolder& job, std::size_t task, double patience_s);
  ~JobClaim();
  /// Tells whether no other runner has claimed the task before. Runners that saw it open at the same time all claim it,
  /// and all but the first leave it.
  bool is_first() const;
  /// Tells whether no other runner has removed the claim, which it does after the time that a claim lasts untouched.
  bool is_held() const;
  JobClaim(const JobClaim&) = delete;
  JobClaim& operator=(const JobClaim&) = delete;

 private:
  void keep_touching(double every_s);

  const JobFolder& job_;
  std::size_t task_;
  Unfinished file_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::thread toucher_;
};

}  // namespace itin::viewshed
