// The folder of a job: whatever runners do to each other, every task has one answer in the end.
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/packed_file.hpp>
#include <viewshed/job.hpp>

#include "support/temporary_directory.hpp"

namespace itin::viewshed {
namespace {

namespace fs = std::filesystem;

/// Tasks whose answers are told by a function.
class ToldTasks final : public Tasks {
 public:
  explicit ToldTasks(std::size_t count, std::function<std::string(std::size_t)> tell = {}) : tell_(std::move(tell)) {
    for (std::size_t i = 0; i < count; ++i) {
      Task& task = list_.emplace_back();
      task.north_west.column = static_cast<std::int64_t>(10 * i), task.columns = task.rows = 10;
      task.seconds = static_cast<double>(i % 3);
    }
  }
  const std::vector<Task>& list() const override { return list_; }
  std::string answer(std::size_t task, Progress&) const override {
    return tell_ ? tell_(task) : "answer " + std::to_string(task);
  }
  void add(std::size_t, std::string_view) override {}

 private:
  std::function<std::string(std::size_t)> tell_;
  std::vector<Task> list_;
};

class Job : public testing::Test {
 protected:
  std::string path() const { return directory_.file("job"); }
  void create(const Tasks& tasks) { JobFolder::create(path(), {{"verb", "told"}}, tasks, {}); }
  RunReport run(const Tasks& tasks, RunOptions options = {}) {
    return run_job(
        JobFolder(path()), tasks, [] {}, options, progress_);
  }
  std::size_t files_in(const std::string& folder) const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(path() + "/" + folder)) ++count;
    return count;
  }
  /// Leaves the claim of another runner, touched so long after now.
  void leave_claim(std::size_t task, int seconds) {
    std::ifstream lines(path() + "/tasks.jsonl");
    for (std::string line; std::getline(lines, line);) {
      const Document document = Document::parse(line);
      if (document["n"] != task) continue;
      const std::string claim = path() + "/claims/" + document["id"].get<std::string>() + ".elsewhere.1";
      std::ofstream(claim) << "\n";
      fs::last_write_time(claim, fs::file_time_type::clock::now() + std::chrono::seconds(seconds));
    }
  }
  static JobEnd end_of(const std::function<void()>& call) {
    try {
      call();
    } catch (const JobError& error) {
      return error.end();
    }
    ADD_FAILURE() << "no end";
    return JobEnd::kFailed;
  }

  test::TemporaryDirectory directory_;
  NoProgress progress_;
};

TEST_F(Job, IsDoneByManyRunnersOnce) {
  std::atomic<int> told = 0;
  const ToldTasks tasks(40, [&](std::size_t task) {
    ++told;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return "answer " + std::to_string(task);
  });
  create(tasks);
  std::atomic<std::size_t> answered = 0;
  std::vector<std::thread> runners;
  for (std::size_t part = 1; part <= 4; ++part)
    runners.emplace_back([&, part] { answered += run(tasks, {.part = part, .parts = 4}).answered; });
  for (std::thread& runner : runners) runner.join();
  EXPECT_EQ(answered, 40U);
  EXPECT_EQ(told, 40);
  EXPECT_EQ(run(tasks).answered, 0U);
  const JobFolder job(path());
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(job.answer(i), "answer " + std::to_string(i));
  EXPECT_EQ(files_in("tmp"), 0U);
  EXPECT_EQ(files_in("claims"), 0U);
  EXPECT_EQ(files_in("stats"), 40U);
}

TEST_F(Job, BeginsWithTheDearest) {
  std::vector<std::size_t> order;
  const ToldTasks tasks(6, [&](std::size_t task) { return order.push_back(task), ""; });
  create(tasks);
  run(tasks);
  EXPECT_EQ(order, (std::vector<std::size_t>{2, 5, 1, 4, 0, 3}));
}

TEST_F(Job, LeavesTasksToThoseWhoClaimThem) {
  const ToldTasks tasks(3);
  create(tasks);
  leave_claim(1, -3600);
  const JobFolder job(path());
  EXPECT_TRUE(job.claims(60).empty());
  ASSERT_EQ(job.claims(7200).size(), 1U);
  EXPECT_EQ(job.claims(7200)[0].task, 1U);
  EXPECT_EQ(job.claims(7200)[0].runner, "elsewhere.1");
  struct Stopped final : Progress {
    std::atomic<bool> stop = false;
    void report(std::string_view, double) override {}
    bool cancelled() const override { return stop; }
  } stopped;
  std::thread runner([&] {
    EXPECT_THROW(run_job(
                     job, tasks, [] {}, {.patience_s = 7200}, stopped),
                 Cancelled);
  });
  while (!job.is_done(0) || !job.is_done(2)) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(job.is_done(1));
  stopped.stop = true;
  runner.join();
  EXPECT_EQ(run(tasks).answered, 1U);
  EXPECT_EQ(job.failures(1), std::vector<std::string>{"the runner elsewhere.1 vanished"});
}

/// Two runners see a task open at the same time, and both claim it: it is that of the first claim.
TEST_F(Job, LeavesATaskToTheOneWhoClaimedItFirst) {
  for (const bool other_is_first : {true, false}) {
    SCOPED_TRACE(other_is_first);
    fs::remove_all(path());
    const ToldTasks tasks(3);
    create(tasks);
    const JobFolder job(path());
    /// Claims task 2, the first to be answered, for another runner, which answers it while this one is at the next.
    struct Claiming final : Progress {
      std::function<void()> next;
      void report(std::string_view stage, double) override {
        if (stage.starts_with("task")) next();
      }
    } progress;
    int reported = 0;
    progress.next = [&] {
      if (++reported == 1) leave_claim(2, other_is_first ? -2 : 2);
      if (reported == 2 && other_is_first) job.seal(2, "answer 2", [] {});
    };
    const RunReport report = run_job(
        job, tasks, [] {}, {}, progress);
    EXPECT_EQ(report.answered, other_is_first ? 2U : 3U);
    for (const std::size_t task : {0U, 1U, 2U}) EXPECT_TRUE(job.is_done(task));
  }
}

TEST_F(Job, EndsLoudlyWhereATaskHasTwoAnswers) {
  const ToldTasks tasks(2);
  create(tasks);
  const JobFolder job(path());
  job.seal(0, "one", [] {});
  job.seal(0, "one", [] {});
  EXPECT_EQ(end_of([&] { job.seal(0, "another", [] {}); }), JobEnd::kTwoAnswers);
  EXPECT_EQ(job.answer(0), "one");
  EXPECT_EQ(files_in("failed"), 1U) << "the other answer is kept";
  EXPECT_EQ(files_in("tmp"), 0U);
}

/// What a runner was writing goes with its claim, and what others write stays.
TEST_F(Job, RemovesWhatAVanishedRunnerWasWriting) {
  const ToldTasks tasks(3);
  create(tasks);
  leave_claim(1, -3600);
  const std::string tmp = path() + "/tmp/";
  for (const char* name :
       {"0123.elsewhere.1", ".0123.elsewhere.part1-1.1", "clock.3.elsewhere.1", "0123.time.elsewhere.1"})
    std::ofstream(tmp + name) << "half of";
  for (const char* name : {"0123.elsewhere.2", ".0123.elsewhere.part2-1.2", "clock.3.there.1"})
    std::ofstream(tmp + name) << "half of";
  EXPECT_EQ(files_in("tmp"), 7U);
  std::ignore = JobFolder(path()).claims(60);
  EXPECT_EQ(files_in("tmp"), 7U) << "to ask who works removes nothing";
  std::ignore = JobFolder(path()).clear_claims(60);
  EXPECT_EQ(files_in("tmp"), 3U);
  EXPECT_EQ(files_in("claims"), 0U);
}

/// A runner that stood still loses its claim and what it was writing, and goes on with the tasks that are left.
TEST_F(Job, OutlivesThatItIsTakenForGone) {
  const ToldTasks tasks(3);
  create(tasks);
  int asked = 0;
  const auto lose_all = [&] {
    if (++asked != 2) return;
    for (const char* folder : {"claims", "tmp"})
      for (const auto& entry : fs::directory_iterator(path() + "/" + folder)) fs::remove(entry.path());
  };
  const RunReport report = run_job(JobFolder(path()), tasks, lose_all, {}, progress_);
  EXPECT_EQ(report.answered, 3U);
  EXPECT_EQ(asked, 5) << "once before all, and once more for the task whose answer was lost";
  for (const std::size_t task : {0U, 1U, 2U})
    EXPECT_EQ(JobFolder(path()).answer(task), "answer " + std::to_string(task));
}

/// A runner that is killed while it writes leaves a part of a file.
TEST_F(Job, PassesOverWhatARunnerLeftUnfinished) {
  const ToldTasks tasks(2);
  create(tasks);
  run(tasks);
  const JobFolder job(path());
  const double seconds = job.seconds_spent();
  for (const char* folder : {"stats", "claims", "failed"})
    std::ofstream(path() + "/" + folder + "/.0123.part1-1.json") << "{\"seco";
  EXPECT_EQ(job.seconds_spent(), seconds);
  EXPECT_TRUE(job.claims(60).empty());
}

TEST_F(Job, SealsNothingOnceTheStoreHasChanged) {
  const ToldTasks tasks(2);
  create(tasks);
  const JobFolder job(path());
  int asked = 0;
  const auto guard = [&] {
    if (++asked > 1) throw JobError(JobEnd::kStoreChanged, "changed");
  };
  EXPECT_EQ(end_of([&] { run_job(job, tasks, guard, {}, progress_); }), JobEnd::kStoreChanged);
  for (const std::size_t task : {0U, 1U}) EXPECT_FALSE(job.is_done(task));
  EXPECT_EQ(files_in("tmp"), 0U);
  EXPECT_EQ(files_in("claims"), 0U);
}

TEST_F(Job, SetsATaskAsideThatFailsThreeTimes) {
  int tries = 0;
  const ToldTasks tasks(5, [&](std::size_t task) -> std::string {
    if (task != 3) return "fine";
    ++tries;
    throw Error("three is bad");
  });
  create(tasks);
  const RunReport report = run(tasks);
  EXPECT_EQ(report.answered, 4U);
  EXPECT_EQ(report.set_aside, std::vector<std::size_t>{3});
  EXPECT_EQ(tries, 3);
  const JobFolder job(path());
  EXPECT_TRUE(job.is_set_aside(3));
  EXPECT_EQ(job.failures(3).size(), 3U);
  EXPECT_EQ(run(tasks).answered, 0U);
  job.forget_failures();
  EXPECT_FALSE(job.is_set_aside(3));
  EXPECT_EQ(end_of([&] { run(tasks, {.task = 3}); }), JobEnd::kFailed);
}

TEST_F(Job, SetsARefusedTaskAsideAtOnce) {
  const ToldTasks tasks(2, [](std::size_t) -> std::string { throw InputError("no ground"); });
  create(tasks);
  EXPECT_EQ(end_of([&] { run(tasks, {.task = 0}); }), JobEnd::kRefused);
  EXPECT_EQ(run(tasks).set_aside.size(), 2U);
  EXPECT_EQ(JobFolder(path()).failures(0), std::vector<std::string>{"no ground"});
}

TEST_F(Job, AsksToTryAgainWhereTheFolderTakesNothing) {
  const ToldTasks tasks(1);
  create(tasks);
  fs::remove_all(path() + "/tmp");
  EXPECT_EQ(end_of([&] { JobFolder(path()).seal(0, "fine", [] {}); }), JobEnd::kTryAgain);
}

TEST_F(Job, RefusesOtherTasksThanItsOwn) {
  create(ToldTasks(4));
  EXPECT_EQ(end_of([&] { run(ToldTasks(5)); }), JobEnd::kRefused);
  EXPECT_THROW(JobFolder::create(path(), {}, ToldTasks(4), {}), FileError);
  EXPECT_EQ(run(ToldTasks(4)).answered, 4U);
}

TEST_F(Job, RefusesDamagedAndForeignAnswers) {
  const ToldTasks tasks(2);
  create(tasks);
  run(tasks);
  const JobFolder job(path());
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(path() + "/done"))
    if (entry.is_regular_file()) files.push_back(entry.path().string());
  ASSERT_EQ(files.size(), 2U);
  fs::copy_file(files[0], files[1], fs::copy_options::overwrite_existing);
  int foreign = 0;
  for (std::size_t task = 0; task < 2; ++task) {
    try {
      std::ignore = job.answer(task);
    } catch (const FileError&) {
      ++foreign;
    }
  }
  EXPECT_EQ(foreign, 1);
  std::ofstream(files[0]) << "itinpack and nothing more";
  std::ofstream(files[1]) << "";
  for (std::size_t task = 0; task < 2; ++task) EXPECT_THROW(std::ignore = job.answer(task), FileError);
}

TEST_F(Job, ADamagedFolderIsNamed) {
  EXPECT_THROW(JobFolder{path()}, FileError);
  create(ToldTasks(2));
  std::ofstream(path() + "/tasks.jsonl", std::ios::app) << "{\"n\": 7}\n";
  EXPECT_THROW(JobFolder{path()}, FileError);
  std::ofstream(path() + "/job.json") << "{";
  EXPECT_THROW(JobFolder{path()}, FileError);
}

}  // namespace
}  // namespace itin::viewshed
