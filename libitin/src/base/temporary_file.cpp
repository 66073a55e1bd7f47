#include "base/temporary_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <itin/error.hpp>

namespace itin {

namespace {

[[noreturn]] void throw_file_error(const std::string& directory, const std::string& doing, int error) {
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  throw FileError(directory, "cannot " + doing + " a temporary file: " + std::generic_category().message(error) +
                                 (full ? "; free some space there, about 32 bytes per point, and try again" : ""));
}

}  // namespace

TemporaryFile::TemporaryFile(std::string directory)
    : directory_(directory.empty() ? std::string(1, '.') : std::move(directory)) {
  std::string name = directory_ + "/.itin-XXXXXX";
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) throw_file_error(directory_, "create", errno);
  ::unlink(name.c_str());
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : directory_(std::move(other.directory_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

TemporaryFile& TemporaryFile::operator=(TemporaryFile&& other) noexcept {
  std::swap(directory_, other.directory_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void TemporaryFile::read(std::uint64_t offset, void* bytes, std::size_t count) const {
  auto* next = static_cast<std::byte*>(bytes);
  while (count > 0) {
    const ssize_t done = ::pread(descriptor_, next, count, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw_file_error(directory_, "read", errno);
    if (done == 0) throw FileError(directory_, "a temporary file ended early; was it changed by another program?");
    next += done, offset += static_cast<std::uint64_t>(done), count -= static_cast<std::size_t>(done);
  }
}

void TemporaryFile::write(std::uint64_t offset, const void* bytes, std::size_t count) {
  const auto* next = static_cast<const std::byte*>(bytes);
  while (count > 0) {
    const ssize_t done = ::pwrite(descriptor_, next, count, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw_file_error(directory_, "write", errno);
    next += done, offset += static_cast<std::uint64_t>(done), count -= static_cast<std::size_t>(done);
  }
}

}  // namespace itin
