// A folder for outputs that is removed again if it stays empty.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include <itin/error.hpp>
#include <itin/unfinished.hpp>

namespace itin {

class NewFolder {
 public:
  /// Makes the folder where it is missing. Throws FileError where that fails, or something else has the name.
  explicit NewFolder(const std::string& path) {
    std::error_code error;
    if (std::filesystem::create_directory(path, error)) made_.emplace(path, Unfinished::Kind::folder_if_empty);
    if (!std::filesystem::is_directory(path)) throw FileError(path, "the directory cannot be made; name another place");
  }

  /// Whether the folder was not there before.
  bool made() const { return made_.has_value(); }

 private:
  std::optional<Unfinished> made_;
};

}  // namespace itin
