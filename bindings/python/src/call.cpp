#include "call.hpp"

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace itin::python {

namespace {

constexpr std::chrono::milliseconds kPatience{50};

pid_t process = 0;

void require_own_process() {
  if (getpid() != process)
    throw Error(
        "this process was forked after itin was imported, and has none of its threads; start workers by the method "
        "'spawn' of multiprocessing");
}

/// The progress of a call, as the worker reports it and the caller reads it.
class Reported final : public Progress {
 public:
  void report(std::string_view stage, double fraction) override {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return;  // workers must not queue up here
    stage_ = stage, fraction_ = fraction;
  }
  bool cancelled() const override { return stopped_; }
  void stop() { stopped_ = true; }
  std::pair<std::string, double> now() {
    const std::lock_guard lock(mutex_);
    return {stage_, fraction_};
  }

 private:
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::string stage_;
  double fraction_ = 0;
};

bool ends_soon(const std::future<void>& work) {
  const py::gil_scoped_release others_may_run;
  return work.wait_for(kPatience) == std::future_status::ready;
}

void hear(Reported& progress, const py::object& show) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (show.is_none()) return;
  const auto [stage, fraction] = progress.now();
  show(stage, fraction);
}

}  // namespace

void note_process() {
  process = getpid();
}

void run(const py::object& show, const std::function<void(Progress&)>& work) {
  require_own_process();
  Reported progress;
  std::future<void> working = std::async(std::launch::async, [&] { work(progress); });
  try {
    while (!ends_soon(working)) hear(progress, show);
  } catch (...) {
    progress.stop();
    const py::gil_scoped_release others_may_run;
    working.wait();
    throw;
  }
  working.get();
}

}  // namespace itin::python
