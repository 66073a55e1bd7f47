// A folder of outputs that appears complete or not at all.
//
//   ZtvFolder folder("ztv", policy);
//   write(folder.working() + "/tip-count.tif");
//   folder.publish();
#pragma once

#include <optional>
#include <string>

#include <itin/unfinished.hpp>

#include "output/output_path.hpp"

namespace itin::cli {

class ZtvFolder {
 public:
  /// The file that tells a folder of outputs from any other.
  static constexpr const char* kManifest = "ztv.json";

  /// Checks that a folder of outputs may be written at `path`. Throws FileError if nothing can be written beside it, or
  /// if `path` is something else than a folder or a folder with files in it that may not be replaced. Without
  /// `--overwrite` no files may be replaced; with it only those of a folder that has a manifest.
  static void require_writable(const std::string& path, const OutputPolicy& policy);

  /// Makes a working folder beside `path`, which is removed in the end unless it is published. Throws as
  /// require_writable() does.
  ZtvFolder(std::string path, const OutputPolicy& policy);

  const std::string& working() const { return working_->path(); }
  /// Renames the working folder to `path`, in one step. Files of the earlier folder that its manifest does not list as
  /// outputs move along. Throws FileError.
  void publish();

 private:
  void keep_foreign_files(const std::string& earlier) const;

  std::string path_;
  std::optional<Unfinished> working_;
};

}  // namespace itin::cli
