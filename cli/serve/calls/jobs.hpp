// Calls of the program that clients start and come back for: one runs, a few wait, and those that ended keep their
// files for a while.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <itin/document.hpp>

#include "serve/calls/child_process.hpp"
#include "serve/calls/job_call.hpp"
#include "serve/calls/server_folder.hpp"

namespace itin::cli {

/// Safe for concurrent use.
class Jobs {
 public:
  /// `folder`, which must outlive the jobs, is where each has a folder.
  explicit Jobs(ServerFolder& folder);
  /// Ends what runs, and removes all files.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Returns the id of the job; nothing where too many wait. Throws FileError where there is no place for its files,
  /// InputError where an upload is gone.
  std::optional<std::string> start(JobCall call);
  /// The document of a job as PROTOCOL.md describes it; nothing where there is none of this id.
  std::optional<Document> state(const std::string& id) const;
  /// Ends a job and removes its files. Returns whether there was one.
  bool remove(const std::string& id);
  /// The path of a file that a job has written, by its name in the job's document.
  std::optional<std::filesystem::path> file(const std::string& id, const std::string& name) const;

 private:
  enum class State { queued, running, done, failed, cancelled };
  struct Job {
    std::string id;
    JobCall call;
    State state = State::queued;
    Document progress = {{"stage", nullptr}, {"share", 0}, {"seconds_left", nullptr}};
    std::string error = {};
    Document document = nullptr;
    ChildProcess* process = nullptr;  ///< while it runs
  };

  void work();
  void run(Job& job);
  void hear(Job& job, const std::string& line);
  void end(Job& job, int status);
  void forget_old_jobs();
  std::shared_ptr<Job> find(const std::string& id) const;
  Document files_of(const Job& job) const;
  std::filesystem::path folder_of(const Job& job) const;
  std::filesystem::path document_of(const Job& job) const;
  void link_uploads(const Job& job) const;
  void remove_files(const Job& job) const;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::shared_ptr<Job>> jobs_;  ///< the oldest first
  ServerFolder& folder_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace itin::cli
