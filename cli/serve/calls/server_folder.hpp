// The one folder that the server writes into. It is removed when the server ends.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>

#include <itin/unfinished.hpp>

namespace itin::cli {

/// Safe for concurrent use.
class ServerFolder {
 public:
  /// Makes the folder when first called. Throws FileError where there is no place for it.
  std::filesystem::path path();

 private:
  std::mutex mutex_;
  std::optional<Unfinished> folder_;
};

}  // namespace itin::cli
