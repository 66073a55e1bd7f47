// Triangles of a part of the store, for the 3-D view: what `itin tin` writes as glTF, made by a child of the server.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <itin/progress.hpp>

#include "serve/calls/server_folder.hpp"
#include "serve/calls/uploads.hpp"
#include "serve/ground/served_store.hpp"
#include "serve/http/http_message.hpp"

namespace itin::cli {

/// Safe for concurrent use; one window is made at a time.
class TinWindows {
 public:
  /// All must outlive the windows. A child uses `threads`.
  TinWindows(const ServedStore& served, const Uploads& uploads, ServerFolder& folder, int threads)
      : served_(served), uploads_(uploads), folder_(folder), threads_(threads) {}

  /// Returns the bytes of a .glb file; nothing while another one is being made. The query has `bbox`, and may have
  /// `tolerance` and `themes`. Throws InputError for another query, and where there are too many triangles; Error,
  /// Cancelled.
  std::optional<std::string> glb(const HttpQuery& query, const Progress& progress);

 private:
  std::string made(const std::vector<std::string>& arguments, const Progress& progress) const;
  std::uint64_t most_bytes() const;

  const ServedStore& served_;
  const Uploads& uploads_;
  ServerFolder& folder_;
  int threads_;
  std::mutex one_;
};

}  // namespace itin::cli
