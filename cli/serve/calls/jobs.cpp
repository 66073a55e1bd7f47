#include "serve/calls/jobs.hpp"

#include <algorithm>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "serve/calls/admission.hpp"

namespace itin::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostWaiting = 2;
constexpr std::size_t kMostEnded = 16;
constexpr const char* kStateNames[] = {"queued", "running", "done", "failed", "cancelled"};

std::string job_url(const std::string& id) {
  return "/api/v1/jobs/" + id;
}

/// The names of all files below a folder, relative to it, but for some.
std::vector<std::string> files_below(const fs::path& folder, const std::vector<std::string>& but) {
  std::vector<std::string> names;
  std::error_code gone;
  for (fs::recursive_directory_iterator entry(folder, gone), end; !gone && entry != end; entry.increment(gone))
    if (entry->is_regular_file(gone)) names.push_back(fs::relative(entry->path(), folder, gone).generic_string());
  std::erase_if(names, [&](const std::string& name) { return std::find(but.begin(), but.end(), name) != but.end(); });
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Jobs::Jobs(ServerFolder& folder) : folder_(folder), thread_([this] { work(); }) {}

Jobs::~Jobs() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    for (const auto& job : jobs_)
      if (job->process != nullptr) job->process->terminate();
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<std::string> Jobs::start(JobCall call) {
  const std::lock_guard lock(mutex_);
  const auto waiting =
      std::count_if(jobs_.begin(), jobs_.end(), [](const auto& job) { return job->state == State::queued; });
  if (static_cast<std::size_t>(waiting) >= kMostWaiting) return std::nullopt;
  const auto job = std::make_shared<Job>(Job{random_key(), std::move(call)});
  std::error_code error;
  if (!fs::create_directory(folder_of(*job), error))
    throw FileError(folder_of(*job).string(), "cannot be made: " + error.message());
  link_uploads(*job);
  jobs_.push_back(job);
  changed_.notify_all();
  return job->id;
}

/// Puts the uploads that a call reads beside its outputs, where it finds them by the names that a person would type.
/// They stay there whatever becomes of the uploads.
void Jobs::link_uploads(const Job& job) const {
  for (const std::string& name : job.call.uploads) {
    std::error_code error;
    fs::create_hard_link(folder_.path() / name, folder_of(job) / name, error);
    if (!error) continue;
    fs::remove_all(folder_of(job), error);
    throw InputError(name + ": is no longer there; send it again");
  }
}

std::optional<Document> Jobs::state(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto job = find(id);
  if (!job) return std::nullopt;
  Document document{{"id", job->id}, {"verb", job->call.verb}, {"state", kStateNames[static_cast<int>(job->state)]}};
  document.update(job->progress);
  document["options"] = job->call.options;
  document["command"] = job->call.command;
  document["error"] = job->error.empty() ? Document(nullptr) : Document(job->error);
  document["document"] = job->document;
  document["files"] = files_of(*job);
  return document;
}

Document Jobs::files_of(const Job& job) const {
  Document files = Document::array();
  if (job.state != State::done) return files;
  std::error_code gone;
  for (const std::string& name : files_below(folder_of(job), job.call.uploads))
    files.push_back(
        {{"name", name}, {"bytes", fs::file_size(folder_of(job) / name, gone)}, {"url", job_url(job.id) + "/" + name}});
  return files;
}

bool Jobs::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto job = find(id);
  if (!job) return false;
  // What runs is removed once it has ended.
  if (job->process != nullptr) job->process->terminate();
  if (job->state != State::running) {
    remove_files(*job);
    jobs_.remove(job);
  }
  job->state = State::cancelled;
  return true;
}

std::optional<fs::path> Jobs::file(const std::string& id, const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto job = find(id);
  if (!job || job->state != State::done) return std::nullopt;
  const std::vector<std::string> names = files_below(folder_of(*job), job->call.uploads);
  if (std::find(names.begin(), names.end(), name) == names.end()) return std::nullopt;
  return folder_of(*job) / name;
}

std::shared_ptr<Jobs::Job> Jobs::find(const std::string& id) const {
  const auto found = std::find_if(jobs_.begin(), jobs_.end(), [&](const auto& job) { return job->id == id; });
  return found == jobs_.end() ? nullptr : *found;
}

fs::path Jobs::folder_of(const Job& job) const {
  return folder_.path() / job.id;
}
fs::path Jobs::document_of(const Job& job) const {
  return folder_.path() / (job.id + ".json");
}

void Jobs::remove_files(const Job& job) const {
  std::error_code ignored;
  fs::remove_all(folder_of(job), ignored);
  fs::remove(document_of(job), ignored);
}

void Jobs::work() {
  std::unique_lock lock(mutex_);
  const auto next = [&] {
    return std::find_if(jobs_.begin(), jobs_.end(), [](const auto& job) { return job->state == State::queued; });
  };
  while (true) {
    changed_.wait(lock, [&] { return ending_ || next() != jobs_.end(); });
    if (ending_) return;
    const std::shared_ptr<Job> job = *next();
    job->state = State::running;
    lock.unlock();
    run(*job);
    lock.lock();
    forget_old_jobs();
  }
}

void Jobs::run(Job& job) {
  try {
    ChildProcess process(job.call.arguments, folder_of(job).string(), document_of(job).string());
    {
      const std::lock_guard lock(mutex_);
      job.process = &process;
      if (ending_ || job.state == State::cancelled) process.terminate();
    }
    for (std::string line; process.read_line(line);) hear(job, line);
    const int status = process.wait();
    end(job, status);
  } catch (const Error& error) {
    const std::lock_guard lock(mutex_);
    job.process = nullptr;
    job.state = State::failed;
    job.error = error.what();
  }
}

/// Takes a line of progress, or the error that the program ends with.
void Jobs::hear(Job& job, const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (const auto error = told_error(line)) job.error = *error;
  const Document progress = Document::parse(line, nullptr, false);
  if (progress.is_object()) job.progress.update(progress);
}

void Jobs::end(Job& job, int status) {
  std::ifstream output(document_of(job));
  const Document document = Document::parse(output, nullptr, false);
  const std::lock_guard lock(mutex_);
  job.process = nullptr;
  if (job.state == State::cancelled) return;
  job.state = status == 0 ? State::done : State::failed;
  if (document.is_object()) job.document = document;
  if (status != 0 && job.error.empty()) job.error = fmt::format("the call ended with status {}", status);
  if (status == 0) job.progress["share"] = 1;
}

/// Removes cancelled jobs, and the oldest of those that ended otherwise.
void Jobs::forget_old_jobs() {
  std::size_t ended = 0;
  for (auto job = jobs_.end(); job != jobs_.begin();) {
    --job;
    const State state = (*job)->state;
    if (state == State::queued || state == State::running) continue;
    if (state != State::cancelled && ++ended <= kMostEnded) continue;
    remove_files(**job);
    job = jobs_.erase(job);
  }
}

}  // namespace itin::cli
