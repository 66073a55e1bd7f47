// A folder for outputs that is gone again if none of them came about.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include <itin/error.hpp>

namespace itin::cli {

class NewFolder {
 public:
  /// Makes it where it is missing. Throws FileError where that fails, or something else has the name.
  explicit NewFolder(std::string path) : path_(std::move(path)) {
    std::error_code error;
    made_ = std::filesystem::create_directory(path_, error);
    if (!std::filesystem::is_directory(path_)) throw FileError(path_, "cannot be made a directory; name another place");
  }
  /// Removes it if this made it and it is empty.
  ~NewFolder() {
    std::error_code ignored;
    if (made_) std::filesystem::remove(path_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Whether it was not there before.
  bool made() const { return made_; }

 private:
  std::string path_;
  bool made_ = false;
};

}  // namespace itin::cli
