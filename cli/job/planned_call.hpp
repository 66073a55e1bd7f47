// The call of a verb that a job was planned for: recorded in the job's folder, and made again from it, where the store
// and the tables may lie elsewhere.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <itin/document.hpp>
#include <itin/progress.hpp>
#include <viewshed/job.hpp>

#include "program/verb_call.hpp"

namespace itin::cli {

/// Tells whether a file is still what it was.
struct FileStamp {
  std::uint64_t file = 0;
  std::int64_t bytes = 0, seconds = 0, nanoseconds = 0;

  bool operator==(const FileStamp&) const = default;
};

/// What a job needs to be planned.
struct JobPlan {
  Document document;                                        ///< for job.json
  std::vector<std::pair<std::string, std::string>> inputs;  ///< files to copy, and their names within inputs/
};
/// Records a call. Reads the store, for its digest. Throws InputError, FileError.
JobPlan plan_of(const VerbCall& call, std::uint64_t most_cells, Progress& progress);

/// Finds the job's store: `given`, where that is not empty, else as the call has it, else where it lay when the job was
/// planned. Throws JobError where it is another store, FileError where there is none.
std::string store_of_job(const viewshed::JobFolder& job, const std::string& given, Progress& progress);

/// A call that was recorded.
class PlannedCall {
 public:
  /// Takes store_of_job(), and the tables as the call has them where these are unchanged, else the job's copies. Throws
  /// JobError where the store is another one, or this is another version of the program.
  PlannedCall(const viewshed::JobFolder& job, const std::string& store, Progress& progress);

  /// Divides the question as planned.
  std::unique_ptr<viewshed::Tasks> divide(Progress& progress);
  /// Throws JobError where the store is no longer what it was.
  void require_same_store() const;
  /// Another verb of the same call, for execute().
  Verb& verb();

 private:
  std::string store_;
  FileStamp stamp_;  ///< the store's
  std::uint64_t most_cells_;
  VerbCall dividing_, executing_;
};

}  // namespace itin::cli
