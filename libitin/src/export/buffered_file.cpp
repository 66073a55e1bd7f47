#include "export/buffered_file.hpp"

#include <cerrno>
#include <system_error>
#include <unistd.h>

#include <itin/error.hpp>

namespace itin {

BufferedFile::BufferedFile(const PendingFile& output)
    : path_(output.path()), file_(std::fopen(output.temporary_path().c_str(), "wbx")) {
  if (!file_) fail();
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // buffer_ already gathers large pieces
}

void BufferedFile::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size()) fail();
  buffer_.clear();
}

void BufferedFile::close() {
  flush();
  if (std::fclose(file_.release()) != 0) fail();
}

void BufferedFile::close_synced() {
  flush();
  if (::fsync(::fileno(file_.get())) != 0) fail();
  close();
}

void BufferedFile::fail() const {
  throw FileError(path_, "cannot be written: " + std::generic_category().message(errno));
}

}  // namespace itin
