// The rules for files a verb is asked to write, checked before any work is done for them.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "program/call_files.hpp"

namespace itin::cli {

/// The option `--overwrite`, and what it allows.
class OutputPolicy {
 public:
  bool overwrite = false;

  void declare(CLI::App& app);
  /// Throws FileError if `path` exists and may not be replaced, is a directory, or lies where nothing can be written.
  void require_writable(const std::string& path) const;
  /// Does what require_writable() does, for a file whose name no option gives in full. Throws InputError, too, where
  /// the call reads or writes that file already.
  void claim(const std::string& path);

 private:
  CLI::App* app_ = nullptr;
  std::optional<CallFiles> files_;
};

/// Whether the name has the ending of a GeoTIFF.
bool names_geotiff(const std::string& path);

}  // namespace itin::cli
