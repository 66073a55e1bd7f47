// The rules for files a verb is asked to write, checked before any work is done for them.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace itin::cli {

/// `--overwrite`, and what it allows.
struct OutputPolicy {
  bool overwrite = false;

  void declare(CLI::App& app);
  /// Throws FileError if `path` exists and may not be replaced, is a directory, or lies where nothing can be written.
  void require_writable(const std::string& path) const;
};

/// What of a name can be part of every file system's names.
std::string file_name(const std::string& name);

}  // namespace itin::cli
