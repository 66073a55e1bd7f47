// A folder of outputs that appears complete or not at all.
//
//   StudyFolder folder("ztv", false);
//   write(folder.working() + "/tip-count.tif");
//   folder.publish();
#pragma once

#include <optional>
#include <string>

#include <itin/unfinished.hpp>

namespace itin::viewshed {

class StudyFolder {
 public:
  /// Makes a working folder beside `path`, which is removed in the end unless it is published. Throws as
  /// require_zone_folder() does.
  StudyFolder(std::string path, bool overwrite);

  const std::string& working() const { return working_->path(); }
  /// Renames the working folder to `path`, in one step. Files of the earlier folder that its manifest does not list as
  /// outputs move along. Throws FileError.
  void publish();

 private:
  void keep_foreign_files(const std::string& earlier) const;

  std::string path_;
  std::optional<Unfinished> working_;
};

}  // namespace itin::viewshed
