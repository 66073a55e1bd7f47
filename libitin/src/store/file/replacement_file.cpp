#include "store/file/replacement_file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <itin/error.hpp>

#include "base/disk_sync.hpp"

namespace itin {

namespace fs = std::filesystem;

ReplacementFile::ReplacementFile(const std::string& target) : shown_(target), target_(target) {
  std::error_code missing;  // no target yet: neither a link nor a directory
  if (fs::is_symlink(target, missing)) {
    std::error_code error;
    target_ = fs::weakly_canonical(target, error).string();
    if (error) fail(error.message());
    if (!fs::exists(target, missing))
      fail("is a symbolic link to " + fs::read_symlink(target, missing).string() +
           ", which is not there; name that, or remove the link");
  }
  if (fs::is_directory(target_, missing)) fail("is a directory, name a file");
  temporary_ = target_ + ".writing";
  lock();
  unfinished_.emplace(temporary_);
  struct stat old = {};
  const bool kept = ::stat(target_.c_str(), &old) != 0 || ::fchmod(descriptor_, old.st_mode & 07777) == 0;
  if (!kept || ::ftruncate(descriptor_, 0) != 0) {
    const int code = errno;
    unfinished_.reset();
    ::close(descriptor_);
    fail(std::strerror(code));
  }
}

// Opens and locks the temporary file. Whoever held the lock before may have renamed or removed the file that was opened
// and waited for. Then it is no longer the one under this name, and the loop starts again.
void ReplacementFile::lock() {
  for (;;) {
    descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) fail(std::string("cannot be written: ") + std::strerror(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      fail("another import is writing this store; wait for it to end");
    }
    struct stat opened = {}, named = {};
    if (::fstat(descriptor_, &opened) == 0 && ::stat(temporary_.c_str(), &named) == 0 &&
        opened.st_ino == named.st_ino && opened.st_dev == named.st_dev) {
      return;
    }
    ::close(descriptor_);
  }
}

ReplacementFile::~ReplacementFile() {
  unfinished_.reset();
  ::close(descriptor_);
}

void ReplacementFile::commit() {
  if (::fsync(descriptor_) != 0) fail(std::string("cannot be written: ") + std::strerror(errno));
  unfinished_->finish([&] {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
      fail(std::string("cannot be replaced: ") + std::strerror(errno));
  });
  sync_folder_of(target_);
}

void ReplacementFile::fail(const std::string& what) const {
  throw FileError(shown_, what);
}

}  // namespace itin
