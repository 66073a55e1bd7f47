// A file that takes the place of another at once, or not at all.
//
// It is written beside the target, under a lock that lets nobody else write the same target. The lock dies with the
// process, so that the next one simply overwrites the file that a killed one left behind.
#pragma once

#include <optional>
#include <string>

#include <itin/unfinished.hpp>

namespace itin {

class ReplacementFile {
 public:
  /// Creates the empty temporary file. Throws FileError: not writable, or another process is writing this target.
  explicit ReplacementFile(const std::string& target);
  /// Removes the temporary file unless committed.
  ~ReplacementFile();
  ReplacementFile(const ReplacementFile&) = delete;
  ReplacementFile& operator=(const ReplacementFile&) = delete;

  /// The target's name as the caller gave it.
  const std::string& target() const { return shown_; }
  const std::string& temporary_path() const { return temporary_; }
  /// Syncs the bytes, renames, syncs the directory. Throws FileError, which leaves the target as it was.
  void commit();

 private:
  void lock();
  [[noreturn]] void fail(const std::string& what) const;

  std::string shown_;
  std::string target_;  ///< with symbolic links followed
  std::string temporary_;
  int descriptor_ = -1;
  std::optional<Unfinished> unfinished_;  ///< the file of the temporary name, as long as the lock is held
};

}  // namespace itin
