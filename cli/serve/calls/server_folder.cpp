#include "serve/calls/server_folder.hpp"

#include <cstdlib>
#include <string>

#include <itin/error.hpp>

namespace itin::cli {

std::filesystem::path ServerFolder::path() {
  const std::lock_guard lock(mutex_);
  if (!folder_) {
    std::string pattern = (std::filesystem::temp_directory_path() / "itin-serve-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw FileError(pattern, "cannot be made; set TMPDIR to another folder");
    folder_.emplace(pattern, Unfinished::Kind::folder);
  }
  return folder_->path();
}

}  // namespace itin::cli
