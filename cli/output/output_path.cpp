#include "output/output_path.hpp"

#include <filesystem>
#include <unistd.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>

#include "program/help.hpp"

namespace itin::cli {

void OutputPolicy::declare(CLI::App& app) {
  begin_group(app, kOutputs);
  app_ = &app;
  app.add_flag("--overwrite", overwrite, "Replace existing outputs");
}

void OutputPolicy::claim(const std::string& path) {
  if (!files_) files_.emplace(*app_);
  files_->add_output(path);
  require_writable(path);
}

void OutputPolicy::require_writable(const std::string& path) const {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) throw FileError(path, "is a directory; name a file");
  if (fs::exists(status) && !overwrite) throw FileError(path, "exists; give --overwrite to replace it");
  fs::path directory = fs::path(path).parent_path();
  if (directory.empty()) directory = ".";
  if (!fs::is_directory(directory, ignored)) {
    throw FileError(path, "its directory does not exist; create it or name another place");
  }
  if (access(directory.c_str(), W_OK) != 0) {
    throw FileError(path, "its directory is not writable; change its permissions or name another place");
  }
}

bool names_geotiff(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".tif" || ending == ".tiff";
}

}  // namespace itin::cli
