// An output that takes its name only when it is complete.
//
//   PendingFile output(path, overwrite);
//   write(output.temporary_path());
//   output.commit();
#pragma once

#include <string>

#include <itin/unfinished.hpp>

namespace itin {

class PendingFile {
 public:
  /// Throws FileError if `path` exists and may not be replaced, is a folder, or is in a folder that does not exist.
  static void require_possible(const std::string& path, bool overwrite);

  /// Throws as require_possible() does.
  PendingFile(std::string path, bool overwrite);

  const std::string& path() const { return path_; }
  /// Returns a name in the same folder, with the same ending, which no other PendingFile has. The file there is removed
  /// unless committed.
  const std::string& temporary_path() const { return unfinished_.path(); }
  /// Renames the file. Throws FileError, also when another program has made a file of its name meanwhile that may not
  /// be replaced.
  void commit();

 private:
  std::string path_;
  bool overwrite_;
  Unfinished unfinished_;
};

}  // namespace itin
