#include "export/pending_file.hpp"

#include <atomic>
#include <filesystem>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin {

namespace fs = std::filesystem;

namespace {

std::string temporary_name(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  const std::string name =
      fmt::format(".{}.part{}-{}{}", target.stem().string(), ::getpid(), ++count, target.extension().string());
  return (target.parent_path() / name).string();
}

}  // namespace

void PendingFile::require_possible(const std::string& path, bool overwrite) {
  std::error_code ignored;  // a path that cannot be looked at fails when it is opened, with a better message
  if (fs::is_directory(path, ignored)) throw FileError(path, "is a folder; name a file");
  if (!overwrite && fs::exists(path, ignored)) throw FileError(path, "exists already; `overwrite` replaces it");
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    throw FileError(path, fmt::format("there is no folder {}; create it first", folder.string()));
}

PendingFile::PendingFile(std::string path, bool overwrite)
    : path_(std::move(path)), overwrite_(overwrite), unfinished_(temporary_name(path_)) {
  require_possible(path_, overwrite_);
}

void PendingFile::commit() {
  require_possible(path_, overwrite_);
  unfinished_.finish([&] {
    std::error_code error;
    fs::rename(temporary_path(), path_, error);
    if (error) throw FileError(path_, "cannot be put in place: " + error.message());
  });
}

}  // namespace itin
