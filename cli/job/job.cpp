// itin job: a large question as a folder of tasks that any number of machines may work on.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/byte_archive.hpp>
#include <itin/call_progress.hpp>
#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <viewshed/job.hpp>

#include "job/parent_watch.hpp"
#include "job/planned_call.hpp"
#include "job/staged_store.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/unusable_options.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

using viewshed::JobFolder;

/// About how long a task is to take, seconds of one thread, where nobody says how many there are to be.
constexpr double kSecondsOfTask = 30;
constexpr int kMostTasks = 1000000;

class JobVerb final : public Verb {
 public:
  std::string name() const override { return "job"; }
  std::string summary() const override {
    return "Divide a viewshed, ztv, visibility index or choice of sites among machines";
  }
  bool takes_call() const override { return true; }
  void take_call(const std::vector<std::string>& call) override { call_ = call; }

  void declare(CLI::App& app) override {
    app_ = &app;
    reads(app.add_option("ACTION", action_,
                         "plan - divide a call of viewshed, ztv, visibility or site into tasks, written as a folder\n"
                         "run - answer open tasks, on any machine that has the folder, until none is left\n"
                         "status - tell which tasks are done, worked on, open, or set aside after failures\n"
                         "merge - write the outputs of the call, with the bytes that the call by itself writes"))
        ->type_name("plan|run|status|merge")
        ->required();
    reads(app.add_option("JOB", folder_, "The folder of the job"))->type_name("DIR")->required();
    reads(app.add_option("CALL", unparsed_, "The call that a job is planned for: its verb, and all of its arguments"))
        ->type_name("VERB ARGUMENT...")
        ->expected(0, -1);
    begin_group(app, "Plan");
    app.add_option("--tasks", tasks_text_,
                   "About how many tasks (default: as many as take half a minute each of one core)")
        ->type_name("N");
    begin_group(app, "Run");
    app.add_option("--part", part_text_, "Answer one task in N only, from the I-th on: of N runners, each has its own")
        ->type_name("I/N");
    app.add_option("--task", task_text_, "Answer the task of this number only")->type_name("K");
    app.add_option("--stage", stage_, "Copy the store into this folder of the machine first, and read it there")
        ->type_name("FOLDER");
    app.add_option("--patience", patience_text_,
                   "How long a task stays with a runner that gives no sign of life (default: 60)")
        ->type_name("SECONDS");
    app.add_flag("--again", again_, "Try again what was set aside after failures");
    app.add_flag("--with-parent", with_parent_, "Stop when the calling process ends, or closes standard input");
    reads(app.add_option("--store", store_, "Where the store lies on this machine (run, merge)"))->type_name("FILE");
    begin_group(app, "Status");
    app.add_flag("--open", open_, "Print the numbers of the open tasks alone, a line each, the dearest first");
  }

  void validate() override {
    parse_choice("ACTION", action_, {"plan", "run", "status", "merge"});
    const std::map<std::string, std::vector<const char*>> options{
        {"plan", {"--tasks"}},
        {"run", {"--part", "--task", "--stage", "--patience", "--again", "--with-parent"}},
        {"status", {"--open"}}};
    for (const auto& [action, names] : options)
      for (const char* option : names)
        if (action != action_) require_not_given(*app_, {option}, "is of itin job " + action);
    if (action_ != "run" && action_ != "merge") require_not_given(*app_, {"--store"}, "is of itin job run and merge");
    if (action_ != "plan" && (!call_.empty() || !unparsed_.empty()))
      throw InputError("a call is given to itin job plan alone");
    if (!unparsed_.empty()) throw InputError(fmt::format("'{}': is no verb", unparsed_.front()));
    if (action_ == "plan" && call_.empty())
      throw InputError("no call: give the verb that the job is for, and its arguments, after the folder");
    if (!tasks_text_.empty()) wanted_ = parse_whole("--tasks", tasks_text_, 1, kMostTasks);
    if (!patience_text_.empty()) run_.patience_s = parse_number("--patience", patience_text_, Range::kPositive);
    if (!task_text_.empty()) run_.task = static_cast<std::size_t>(parse_whole("--task", task_text_, 0, kMostTasks));
    if (!part_text_.empty()) parse_part();
    if (!part_text_.empty() && run_.task) throw InputError("--part and --task exclude each other; give one of them");
  }

  Document parameters() const override {
    Document parameters{{"action", action_}, {"job", folder_}};
    if (!call_.empty()) parameters["call"] = call_;
    return parameters;
  }

  Result execute(Progress& progress) override {
    if (action_ == "plan") return plan(progress);
    if (action_ == "run") return run(progress);
    if (action_ == "status") return status();
    return merge(progress);
  }

 private:
  void parse_part() {
    const auto slash = part_text_.find('/');
    if (slash == std::string::npos) throw InputError(fmt::format("--part '{}': give it as I/N, 2/8", part_text_));
    run_.parts = static_cast<std::size_t>(parse_whole("--part", part_text_.substr(slash + 1), 1, kMostTasks));
    run_.part =
        static_cast<std::size_t>(parse_whole("--part", part_text_.substr(0, slash), 1, static_cast<int>(run_.parts)));
  }

  // Plan

  static std::unique_ptr<viewshed::Tasks> divided(VerbCall& call, std::uint64_t most_cells, Progress& progress) {
    return call.complete().divide(most_cells, progress);
  }

  /// The greatest number of cells, or of sites, of a task, so that there are as many as wanted, or each takes about as
  /// long as it should.
  std::uint64_t most_cells(Progress& progress) const {
    VerbCall whole(call_);
    const auto tasks = divided(whole, viewshed::kAnyNumberOfCells, progress);
    double seconds = 0;
    std::uint64_t cells = 0;
    for (const viewshed::Task& task : tasks->list()) seconds += task.seconds, cells += task.cells();
    const double wanted =
        wanted_ > 0 ? wanted_ : std::clamp(std::ceil(seconds / kSecondsOfTask), 1.0, 1.0 * kMostTasks);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(static_cast<double>(cells) / wanted)));
  }

  Result plan(Progress& progress) const {
    const std::uint64_t most = most_cells(progress);
    VerbCall call(call_);
    const auto tasks = divided(call, most, progress);
    const JobPlan plan = plan_of(call, most, progress);
    JobFolder::create(folder_, plan.document, *tasks, plan.inputs);
    double seconds = 0, dearest = 0;
    for (const viewshed::Task& task : tasks->list()) seconds += task.seconds, dearest = std::max(dearest, task.seconds);
    Result result;
    result.document["tasks"] = tasks->list().size();
    result.document["cost_s"] = seconds;
    result.document["dearest_s"] = dearest;
    result.document["outputs"] = {folder_};
    result.text =
        fmt::format("{}: {}, about {} of one core, the dearest about {}\nitin job run {} answers them\n", folder_,
                    counted(tasks->list().size(), "task"), duration(seconds), duration(dearest), folder_);
    return result;
  }

  // Run

  Result run(Progress& progress) {
    if (with_parent_) end_with_parent();
    const JobFolder job(folder_);
    if (run_.task && *run_.task >= job.count())
      throw InputError(fmt::format("--task {}: the job has the tasks 0 to {}", *run_.task, job.count() - 1));
    if (again_) job.forget_failures();
    if (!stage_.empty()) store_ = staged_store(store_of_job(job, store_, progress), stage_, progress);
    PlannedCall call(job, store_, progress);
    const auto tasks = call.divide(progress);
    const viewshed::RunReport report = viewshed::run_job(
        job, *tasks, [&] { call.require_same_store(); }, run_, progress);
    Result result;
    result.document["answered"] = report.answered;
    result.document["set_aside"] = report.set_aside;
    result.text = fmt::format("{}: {} answered here\n", folder_, counted(report.answered, "task"));
    if (!report.set_aside.empty()) result.failure = set_aside_text(job, report.set_aside);
    return result;
  }

  static std::string set_aside_text(const JobFolder& job, const std::vector<std::size_t>& tasks) {
    const std::vector<std::string> failures = job.failures(tasks.front());
    return fmt::format("{}: {} set aside after failures, the first is task {}: {}; itin job run --again tries again",
                       job.path(), counted(tasks.size(), "task"), tasks.front(),
                       failures.empty() ? "" : failures.front());
  }

  struct NotDone {
    std::vector<std::size_t> open, aside;
  };
  /// Tells in their order which of these tasks are open, and which are set aside.
  static NotDone not_done(const JobFolder& job, const std::vector<std::size_t>& tasks) {
    NotDone left;
    for (const std::size_t task : tasks)
      if (!job.is_done(task)) (job.is_set_aside(task) ? left.aside : left.open).push_back(task);
    return left;
  }

  // Status

  Result status() const {
    const JobFolder job(folder_);
    const auto [open, aside] = not_done(job, job.order());
    double left = 0;
    for (const auto* tasks : {&open, &aside})
      for (const std::size_t task : *tasks) left += job.seconds(task);
    const std::vector<JobFolder::Claim> claims = job.claims(run_.patience_s);
    const double spent = job.seconds_spent();
    Result result;
    Document& document = result.document;
    document["tasks"] = job.count();
    document["done"] = job.count() - open.size() - aside.size();
    document["open"] = open;
    document["set_aside"] = Document::array();
    for (const std::size_t task : aside)
      document["set_aside"].push_back({{"task", task}, {"failures", job.failures(task)}});
    document["worked_on"] = Document::array();
    for (const JobFolder::Claim& claim : claims)
      document["worked_on"].push_back({{"task", claim.task}, {"runner", claim.runner}});
    document["seconds_spent"] = spent;
    document["cost_left_s"] = left;
    if (open_) {
      for (const std::size_t task : open) result.text += fmt::format("{}\n", task);
      return result;
    }
    result.text = fmt::format("{}: {} of {} done in {}; {} open, about {} of one core\n", folder_,
                              job.count() - open.size() - aside.size(), counted(job.count(), "task"), duration(spent),
                              open.size() + aside.size(), duration(left));
    for (const JobFolder::Claim& claim : claims)
      result.text += fmt::format("task {} is worked on by {}\n", claim.task, claim.runner);
    if (!aside.empty()) result.text += set_aside_text(job, aside) + "\n";
    return result;
  }

  // Merge

  Result merge(Progress& progress) const {
    const JobFolder job(folder_);
    require_all_done(job);
    PlannedCall call(job, store_, progress);
    const auto tasks = call.divide(progress);
    job.require_same(*tasks);
    Verb& verb = call.verb();
    if (verb.writes_by_parts()) tasks->read_again_by([&](std::size_t task) { return job.answer(task); });
    CallProgress whole(progress);
    Progress& reading = whole.step(kShareOfReading);
    for (std::size_t task = 0; task < job.count(); ++task) {
      reading.throw_if_cancelled();
      try {
        tasks->add(task, job.answer(task));
      } catch (const NotThoseValues&) {
        throw FileError(folder_, fmt::format("the answer of task {} is of another question", task));
      }
      reading.report("reading answers", static_cast<double>(task + 1) / static_cast<double>(job.count()));
    }
    verb.take_answers(*tasks);
    Result result = verb.execute(whole.step(1));
    whole.finish();
    call.require_same_store();
    return result;
  }

  void require_all_done(const JobFolder& job) const {
    std::vector<std::size_t> numbers = job.order();
    std::sort(numbers.begin(), numbers.end());
    const auto [open, aside] = not_done(job, numbers);
    if (!aside.empty()) throw Error(set_aside_text(job, aside));
    if (!open.empty())
      throw Error(fmt::format("{}: {} of {} not done, task {} first; itin job run {} answers them", folder_,
                              open.size(), counted(job.count(), "task"), open.front(), folder_));
  }

  static std::string duration(double seconds) {
    if (seconds < 120) return fmt::format("{:.0f} s", seconds);
    if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
  }

  /// About the share of the time that reading answers takes.
  static constexpr double kShareOfReading = 0.2;

  CLI::App* app_ = nullptr;
  std::string action_, folder_, tasks_text_, part_text_, task_text_, stage_, patience_text_, store_;
  std::vector<std::string> call_, unparsed_;
  bool again_ = false, with_parent_ = false, open_ = false;
  int wanted_ = 0;
  viewshed::RunOptions run_;
};

}  // namespace

std::unique_ptr<Verb> make_job_verb() {
  return std::make_unique<JobVerb>();
}

}  // namespace itin::cli
