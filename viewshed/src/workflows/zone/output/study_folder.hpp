// A folder of outputs that appears complete or not at all.
//
//   StudyFolder folder("ztv", kZoneManifest, false);
//   write(folder.working() + "/tip-count.tif");
//   folder.publish();
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/document.hpp>
#include <itin/unfinished.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Checks that such a folder may be written at `path`. `manifest` is the file that tells a folder of earlier outputs
/// from any other. Throws FileError if nothing can be written beside it, or if it is something else than a folder, or a
/// folder with files in it that may not be replaced.
void require_study_folder(const std::string& path, const char* manifest, bool overwrite);

/// Returns the files with their names as paths within the folder.
std::vector<PlanFile> files_within(const std::string& folder, std::vector<PlanFile> files);
/// Returns the text of the manifest of a folder: the document and the files, without times, so that equal runs write
/// equal files.
std::string manifest_text(Document document, const std::vector<PlanFile>& files);

class StudyFolder {
 public:
  /// Makes a working folder beside `path`, which is removed in the end unless it is published. Throws as
  /// require_study_folder() does.
  StudyFolder(std::string path, const char* manifest, bool overwrite);

  const std::string& working() const { return working_->path(); }
  /// Renames the working folder to `path`, in one step. Files of the earlier folder that its manifest does not list as
  /// outputs move along. Throws FileError.
  void publish();

 private:
  void keep_foreign_files(const std::string& earlier) const;

  std::string path_;
  const char* manifest_;
  std::optional<Unfinished> working_;
};

}  // namespace itin::viewshed
