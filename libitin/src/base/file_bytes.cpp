#include "base/file_bytes.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin {

FileBytes::FileBytes(const std::string& path) : path_(path), in_(path, std::ios::binary) {
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error || !in_) throw FileError(path, "cannot be opened for reading");
}

void FileBytes::read(std::uint64_t offset, std::span<char> out, std::string_view what) {
  if (offset > size_ || out.size() > size_ - offset)
    fail(offset, fmt::format("the file ends at {} within {}; it is truncated or damaged", size_, what));
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(offset));
  if (!in_.read(out.data(), static_cast<std::streamsize>(out.size())))
    fail(offset, fmt::format("{} cannot be read", what));
}

void FileBytes::fail(std::uint64_t offset, const std::string& what) const {
  throw FileError(path_, fmt::format("offset {}: {}", offset, what));
}

}  // namespace itin
