#include "trace/trace.hpp"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "trace/call_stack.hpp"
#include "trace/task.hpp"

namespace itin::trace {

namespace {

/// The period of sampling, seconds. Kernels take their own tick for it where that is longer.
constexpr double kPeriod = 0.001;

double seconds_of(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

nlohmann::json json_of(const Task& task);

nlohmann::json json_of(const Loop& loop) {
  nlohmann::json tasks = nlohmann::json::array();
  for (const Task& task : loop.tasks) tasks.push_back(json_of(task));
  return {{"at", loop.at}, {"tasks", std::move(tasks)}};
}

nlohmann::json json_of(const Task& task) {
  if (task.stretches.size() == 1 && !task.stretches[0].loop) return task.stretches[0].seconds;
  nlohmann::json items = nlohmann::json::array();
  for (const Stretch& stretch : task.stretches) {
    items.push_back(stretch.seconds);
    if (stretch.loop) items.push_back(json_of(*stretch.loop));
  }
  return items;
}

/// The trace of a program from its first loop, or its start, to its end.
class Trace {
 public:
  Trace() { sample_call_stacks(kPeriod, depth_); }
  ~Trace() {
    lap();
    try {
      const std::vector<Frames> serial = sampled_call_stacks();
      if (const char* path = std::getenv("ITIN_TRACE")) write(path, serial);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "no trace: %s\n", error.what());
    }
  }
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

  Task& current() { return *current_; }

  /// Ends the stretch that runs: its time goes to the current task.
  void lap() {
    const double now = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    current_->stretches.push_back({now - std::exchange(since_, now), nullptr});
  }
  /// Ends the current stretch with a loop.
  Loop& begin_loop() {
    lap();
    current_->stretches.back().loop = std::make_unique<Loop>();
    return *current_->stretches.back().loop;
  }
  /// Gives work from now on to another task; the time since the last lap belongs to none.
  void enter(Task& task, int deeper) {
    current_ = &task;
    depth_ = depth_ + deeper;
    since_ = seconds_of(CLOCK_THREAD_CPUTIME_ID);
  }

 private:
  void write(const char* path, const std::vector<Frames>& serial) const {
    const double others = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - seconds_of(CLOCK_THREAD_CPUTIME_ID);
    const nlohmann::json document = {{"others", others}, {"root", json_of(root_)}, {"serial", serial}};
    std::ofstream file(path);
    file << document;
    if (!file.flush()) throw std::runtime_error(std::string(path) + " cannot be written");
  }

  Task root_;
  Task* current_ = &root_;
  volatile int depth_ = 0;  ///< how many loops are open
  double since_ = 0;        ///< the processor time at which the stretch began; that of the program's start is 0
};

Trace trace;

}  // namespace

TracedLoop::TracedLoop(std::size_t count) : around_(trace.current()), loop_(trace.begin_loop()) {
  loop_.at = call_stack();  // after the lap, for it takes its time
  loop_.tasks.reserve(count);
  trace.enter(around_, 1);
}

TracedLoop::~TracedLoop() {
  trace.enter(around_, -1);
}

void TracedLoop::run(const std::function<void(std::size_t)>& body, std::size_t i) {
  trace.enter(loop_.tasks.emplace_back(), 0);
  body(i);
  trace.lap();
}

}  // namespace itin::trace
