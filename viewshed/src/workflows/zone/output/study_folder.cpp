#include "workflows/zone/output/study_folder.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <set>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/qgis_styles.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

namespace fs = std::filesystem;

namespace {

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

/// Names of the files that an earlier run wrote.
std::set<std::string> listed_outputs(const fs::path& manifest) {
  std::set<std::string> names{manifest.filename().string()};
  std::ifstream in(manifest);
  const nlohmann::json document = nlohmann::json::parse(in, nullptr, false);
  if (!document.is_object() || !document.contains("outputs") || !document["outputs"].is_array()) return names;
  for (const auto& output : document["outputs"]) {
    if (!output.is_object() || !output.contains("path") || !output["path"].is_string()) continue;
    const fs::path name = fs::path(output["path"].get<std::string>()).filename();
    names.insert(name.string());
    names.insert(style_beside(name.string()));
  }
  return names;
}

}  // namespace

void require_study_folder(const std::string& given, const char* manifest, bool overwrite) {
  const std::string path = without_slash(given);
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_directory(status)) throw FileError(path, "is a file; name a folder");
  if (fs::is_directory(status) && !fs::is_empty(path, ignored)) {
    if (!overwrite) throw FileError(path, "exists; give `overwrite` to replace its outputs");
    if (!fs::exists(fs::path(path) / manifest, ignored))
      throw FileError(path, fmt::format("is no folder of earlier outputs, for it has no {}; name another", manifest));
  }
  fs::path parent = fs::path(path).parent_path();
  if (parent.empty()) parent = ".";
  if (!fs::is_directory(parent, ignored))
    throw FileError(path, "its parent folder does not exist; create it or name another place");
  if (access(parent.c_str(), W_OK) != 0)
    throw FileError(path, "its parent folder is not writable; change its permissions or name another place");
}

void require_zone_folder(const std::string& path, bool overwrite) {
  require_study_folder(path, kZoneManifest, overwrite);
}

std::vector<PlanFile> files_within(const std::string& folder, std::vector<PlanFile> files) {
  for (PlanFile& file : files) file.path = (fs::path(folder) / file.path).string();
  return files;
}

std::string manifest_text(Document document, const std::vector<PlanFile>& files) {
  document.erase("statistics");
  document["outputs"] = outputs_document(files);
  return json_text(document, 2) + "\n";
}

StudyFolder::StudyFolder(std::string path, const char* manifest, bool overwrite)
    : path_(without_slash(std::move(path))), manifest_(manifest) {
  require_study_folder(path_, manifest, overwrite);
  const std::string working = fmt::format("{}.{}.tmp", path_, getpid());
  std::error_code error;
  fs::create_directory(working, error);
  if (error) throw FileError(working, "cannot be created: " + error.message());
  working_.emplace(working, Unfinished::Kind::folder);
}

void StudyFolder::publish() {
  const bool replace = fs::exists(path_) && !fs::is_empty(path_);
  const unsigned flags = replace ? RENAME_EXCHANGE : 0;
  working_->finish([&] {
    if (renameat2(AT_FDCWD, working().c_str(), AT_FDCWD, path_.c_str(), flags) != 0)
      throw FileError(path_, std::string("cannot be written: ") + std::strerror(errno));
  });
  if (!replace) return;
  keep_foreign_files(working());
  std::error_code ignored;
  fs::remove_all(working(), ignored);
}

void StudyFolder::keep_foreign_files(const std::string& earlier) const {
  const std::set<std::string> own = listed_outputs(fs::path(earlier) / manifest_);
  for (const fs::directory_entry& entry : fs::directory_iterator(earlier)) {
    const std::string name = entry.path().filename().string();
    const fs::path to = fs::path(path_) / name;
    std::error_code ignored;
    if (!own.contains(name) && !fs::exists(to, ignored)) fs::rename(entry.path(), to, ignored);
  }
}

}  // namespace itin::viewshed
