#include "job/staged_store.hpp"

#include <cstdio>
#include <filesystem>
#include <unistd.h>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/store.hpp>
#include <itin/unfinished.hpp>
#include <viewshed/job.hpp>

namespace itin::cli {

std::string staged_store(const std::string& store, const std::string& folder, const Progress& progress) {
  namespace fs = std::filesystem;
  const viewshed::StorePrint print = viewshed::print_of(Store(store));
  const fs::path from = fs::path(store);
  const std::string path = (fs::path(folder) / fmt::format("{}-{:016x}.itin", from.stem().string(), print.id)).string();
  std::error_code error;
  if (fs::exists(path, error) && viewshed::print_of(Store(path)) == print) return path;
  progress.throw_if_cancelled();
  fs::create_directories(folder, error);
  Unfinished copy(fmt::format("{}.{}.tmp", path, ::getpid()));
  if (!error) fs::copy_file(from, copy.path(), error);
  if (error) throw FileError(store, fmt::format("cannot be copied to {}: {}", folder, error.message()));
  copy.finish([&] { fs::rename(copy.path(), path); });
  return path;
}

}  // namespace itin::cli
