// Files that clients send, for calls of the program to read: tables of places (CSV), and GeoJSON.
//
//   Uploads uploads(served, folder);
//   const Document document = uploads.add(".csv", bytes);  // {"name": "upload-7a….csv", "places": [...], ...}
//   uploads.path(document["name"]);
//
// A file has a name of the server's choosing, which nobody can guess and no other server gives. It is opened by a child
// of its own, which reads CSV and GeoJSON alone, whatever the bytes look like, and has little memory and time.
#pragma once

#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include <itin/document.hpp>

#include "serve/calls/server_folder.hpp"
#include "serve/ground/served_store.hpp"

namespace itin::cli {

inline constexpr const char* kUploadsPath = "/api/v1/uploads";

/// How files of this content type are to end; nothing where such files are not taken.
std::optional<std::string> upload_ending(std::string_view content_type);

/// Safe for concurrent use.
class Uploads {
 public:
  /// Both must outlive the uploads.
  Uploads(const ServedStore& served, ServerFolder& folder) : served_(served), folder_(folder) {}

  /// Keeps a file, and returns what PROTOCOL.md says of it. The oldest goes where there are too many. Throws InputError
  /// for a file that cannot be read, and FileError where there is no room for it.
  Document add(const std::string& ending, std::string_view bytes);
  /// Returns what add() told of a file; nothing where there is none of this name.
  std::optional<Document> told(const std::string& name) const;
  /// Returns whether there was one of this name.
  bool remove(const std::string& name);
  bool has(const std::string& name) const;
  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

 private:
  /// Returns what the child that reads a file says of it. Throws InputError, FileError.
  Document read(const std::string& name) const;
  void keep(const std::string& name);

  const ServedStore& served_;
  ServerFolder& folder_;
  mutable std::mutex mutex_;
  std::deque<std::string> names_;  ///< the oldest first
};

}  // namespace itin::cli
