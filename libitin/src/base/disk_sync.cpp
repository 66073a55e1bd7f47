#include "base/disk_sync.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <tuple>
#include <unistd.h>

namespace itin {

int sync_folder(const std::string& path) {
  const int folder = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return errno;
  const int failed = ::fsync(folder) == 0 ? 0 : errno;
  ::close(folder);
  return failed;
}

void sync_folder_of(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  std::ignore = sync_folder(parent.empty() ? "." : parent);
}

}  // namespace itin
