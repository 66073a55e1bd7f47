// A large question as a folder of tasks, which any number of runners on any number of machines may work on.
//
//   JobFolder::create("job", document, tasks);                   // once
//   const JobFolder job("job");                                  // on each machine
//   run_job(job, tasks, guard, {}, progress);
//   for (std::size_t i = 0; i < tasks.list().size(); ++i) tasks.add(i, job.answer(i));   // once all are done
//
// The folder:
//
//   job.json            what was asked for, of which store
//   tasks.jsonl         a line for each task: its number and name, what it decides, about how long; the dearest first
//   inputs/             copies of the tables that the question names
//   tmp/NAME.RUNNER     an answer that is being written
//   done/ab/NAME        an answer, for good: written, on disk, and linked here
//   stats/NAME.json     how long it took, where
//   claims/NAME.RUNNER  somebody works on this task: a hint, which is void once its file has not been touched for long
//   failed/NAME.K       the K-th failure of the task
//
// Nothing is ever locked. Two runners may answer the same task: their answers have the same bytes, or both end loudly.
// A name is that of a task of one job; a runner's is its machine, its process and a number drawn at random.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/progress.hpp>
#include <viewshed/tasks.hpp>

namespace itin::viewshed {

/// Why a runner ended without doing what it should. The numbers are statuses of the program.
enum class JobEnd {
  kFailed = 1,
  kTwoAnswers = 3,    ///< a task has two answers: a defect of a machine, or of this program
  kStoreChanged = 4,  ///< the store is not the one that the job was planned for
  kRefused = 5,       ///< the task, or this version of the program, refuses: to try again changes nothing
  kTryAgain = 75      ///< a full disk and the like, which are not the task's fault
};
class JobError : public Error {
 public:
  JobError(JobEnd end, const std::string& what) : Error(what), end_(end) {}
  JobEnd end() const { return end_; }

 private:
  JobEnd end_;
};

/// The files of a job. Safe for concurrent use, also of several processes.
class JobFolder {
 public:
  /// Writes the folder, complete or not at all. `document` says what was asked for. Throws FileError where there is
  /// one already.
  static void create(const std::string& path, Document document, const Tasks& tasks,
                     const std::vector<std::pair<std::string, std::string>>& inputs);

  /// Throws FileError where the folder is no job.
  explicit JobFolder(std::string path);

  const std::string& path() const { return path_; }
  const Document& document() const { return document_; }
  std::string input(const std::string& name) const { return path_ + "/inputs/" + name; }
  std::size_t count() const { return names_.size(); }
  /// The numbers of all tasks, the dearest first.
  const std::vector<std::size_t>& order() const { return order_; }
  /// About how long the task takes, seconds of one thread.
  double seconds(std::size_t task) const { return seconds_.at(task); }
  /// Throws JobError where these are other tasks than those of the job.
  void require_same(const Tasks& tasks) const;

  bool is_done(std::size_t task) const;
  /// Throws FileError where there is no sound answer.
  std::string answer(std::size_t task) const;
  /// Gives the task its answer, for good. Throws JobError where it has another, or the disk is full.
  void seal(std::size_t task, const std::string& answer, const std::function<void()>& guard) const;

  /// What went wrong with the task so far, in words; and whether that was often enough to set it aside.
  std::vector<std::string> failures(std::size_t task) const;
  bool is_set_aside(std::size_t task) const;
  /// Notes a failure. One that is refused is set aside at once.
  void fail(std::size_t task, const std::string& message, bool refused) const;
  /// Forgets all failures, so that the tasks are tried again.
  void forget_failures() const;

  void note_time(std::size_t task, double seconds, std::uint64_t peak_bytes) const;
  /// The seconds that were spent on tasks that are done.
  double seconds_spent() const;

  /// The tasks that others work on, and who does, by the file server's clock: whose claim was touched within `patience`
  /// seconds.
  struct Claim {
    std::size_t task = 0;
    std::string runner;
  };
  std::vector<Claim> claims(double patience) const;
  /// Returns the same. Removes the claims of runners that have vanished, and what these were writing, and notes for
  /// their tasks that they have.
  std::vector<Claim> clear_claims(double patience) const;

 private:
  friend class JobClaim;
  std::string name_path(const char* folder, std::size_t task) const;
  std::optional<std::size_t> task_of(const std::string& name) const;
  void remove_unfinished_of(const std::string& runner) const;
  /// Returns the path of the claim of a task that was touched first; empty where there is none.
  std::string first_claim(std::size_t task) const;
  /// Tells the live claims, and calls stale(path, claim) for the others.
  template <class Stale>
  std::vector<Claim> claims_but(double patience, const Stale& stale) const;

  std::string path_;
  Document document_;
  std::vector<std::string> names_;  ///< by number
  std::vector<std::size_t> order_;
  std::vector<double> seconds_;
};

struct RunOptions {
  std::optional<std::size_t> task = {};  ///< this one alone
  std::size_t part = 1, parts = 1;       ///< every `parts`-th task, from the `part`-th on
  double patience_s = 60;                ///< how long a claim lasts that nobody touches
};
struct RunReport {
  std::size_t answered = 0;
  std::vector<std::size_t> set_aside;
};

/// Answers tasks until none is open that is this runner's to answer; waits for those that others work on, and takes
/// them over where these vanish. `guard` throws JobError where the store has changed, and is called before each answer
/// is sealed. Throws JobError, Cancelled.
RunReport run_job(const JobFolder& job, const Tasks& tasks, const std::function<void()>& guard,
                  const RunOptions& options, Progress& progress);

/// What tells a store from others without reading all of it.
struct StorePrint {
  std::uint64_t bytes = 0, id = 0;

  bool operator==(const StorePrint&) const = default;
};
StorePrint print_of(const Store& store);

}  // namespace itin::viewshed
