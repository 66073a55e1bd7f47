#include <algorithm>
#include <chrono>
#include <new>
#include <set>
#include <thread>

#include <fmt/format.h>

#include <itin/peak_memory.hpp>
#include <itin/silent_progress.hpp>
#include <viewshed/job.hpp>

#include "job/job_claim.hpp"
#include "progress/stopwatch.hpp"

namespace itin::viewshed {

namespace {

/// How often tasks that others work on are looked at again.
constexpr std::chrono::milliseconds kPause{500};

class Runner {
 public:
  Runner(const JobFolder& job, const Tasks& tasks, const std::function<void()>& guard, const RunOptions& options,
         Progress& progress)
      : job_(job), tasks_(tasks), guard_(guard), options_(options), progress_(progress) {
    for (std::size_t i = 0; i < job.order().size(); ++i) {
      const std::size_t task = job.order()[i];
      if (options.task ? task == *options.task : i % options.parts == options.part - 1) open_.push_back(task);
    }
    all_ = open_.size();
  }

  RunReport run() {
    guard_();
    while (!open_.empty()) {
      progress_.throw_if_cancelled();
      if (!answer_next()) std::this_thread::sleep_for(kPause);
    }
    return std::move(report_);
  }

 private:
  /// Answers the first open task that nobody works on. Returns false where there is none.
  bool answer_next() {
    std::set<std::size_t> claimed;
    for (const JobFolder::Claim& claim : job_.clear_claims(options_.patience_s)) claimed.insert(claim.task);
    for (auto at = open_.begin(); at != open_.end();) {
      const std::size_t task = *at;
      if (job_.is_done(task)) {
        at = open_.erase(at);
      } else if (job_.is_set_aside(task)) {
        report_.set_aside.push_back(task);
        at = open_.erase(at);
      } else if (claimed.contains(task)) {
        ++at;
      } else {
        answer(task);
        return true;
      }
    }
    return false;
  }

  /// Answers the task, unless another runner has claimed it meanwhile.
  void answer(std::size_t task) {
    const double share = static_cast<double>(all_ - open_.size()) / static_cast<double>(all_);
    progress_.report(fmt::format("task {} of {}", task, job_.count()), share);
    const JobClaim claim(job_, task, options_.patience_s);
    // Another one may have answered it since it was seen to be open.
    if (!claim.is_first() || job_.is_done(task)) return;
    Stopwatch watch;
    std::string answer;
    try {
      SilentProgress silent(progress_);
      answer = tasks_.answer(task, silent);
    } catch (const Cancelled&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw JobError(JobEnd::kTryAgain,
                     fmt::format("task {}: out of memory; free some, or plan the job with less `memory_bytes`", task));
    } catch (const InputError& error) {
      return fail(task, error, true);
    } catch (const Error& error) {
      return fail(task, error, false);
    }
    keep(task, answer, watch.lap(), claim);
  }

  void keep(std::size_t task, const std::string& answer, double seconds, const JobClaim& claim) {
    try {
      job_.seal(task, answer, guard_);
      ++report_.answered;
      job_.note_time(task, seconds, peak_memory_bytes());
    } catch (const JobError& error) {
      // A runner that stood still for too long is taken for gone, and what it was writing is removed by the one that
      // answers its task instead.
      if (error.end() != JobEnd::kTryAgain || claim.is_held()) throw;
    }
  }

  void fail(std::size_t task, const Error& error, bool refused) {
    guard_();
    job_.fail(task, error.what(), refused);
    if (options_.task)
      throw JobError(refused ? JobEnd::kRefused : JobEnd::kFailed, fmt::format("task {}: {}", task, error.what()));
  }

  const JobFolder& job_;
  const Tasks& tasks_;
  const std::function<void()>& guard_;
  const RunOptions& options_;
  Progress& progress_;
  std::vector<std::size_t> open_;
  std::size_t all_ = 0;
  RunReport report_;
};

}  // namespace

RunReport run_job(const JobFolder& job, const Tasks& tasks, const std::function<void()>& guard,
                  const RunOptions& options, Progress& progress) {
  job.require_same(tasks);
  return Runner(job, tasks, guard, options, progress).run();
}

}  // namespace itin::viewshed
