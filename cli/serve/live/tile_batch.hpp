// Tiles on their way to a client: several in a message, unless that would make it wait.
#pragma once

#include <chrono>
#include <string>

#include <viewshed/viewshed.hpp>

#include "serve/http/http_server.hpp"
#include "serve/live/live_tile.hpp"

namespace itin::cli {

/// How many bytes may wait for a client before passes that are shown for a moment alone are left out.
inline constexpr std::size_t kMostUnsent = std::size_t{2} << 20;

/// Used by one thread at a time.
class TileBatch {
 public:
  TileBatch(const LiveNumber& number, LiveConnection& to) : number_(number), to_(to) {}

  void add(const viewshed::Result& result, const viewshed::DecidedCells& cells);
  /// Sends what waits.
  void flush();

 private:
  using Clock = std::chrono::steady_clock;

  LiveNumber number_;
  LiveConnection& to_;
  std::string bytes_;
  std::int64_t step_ = 0;
  Clock::time_point oldest_;
};

}  // namespace itin::cli
