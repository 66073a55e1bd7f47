#include "serve/live/tile_batch.hpp"

#include <utility>

namespace itin::cli {

namespace {

constexpr std::size_t kFullBatch = 256 << 10;
constexpr std::chrono::milliseconds kOldestTile{8};

}  // namespace

void TileBatch::add(const viewshed::Result& result, const viewshed::DecidedCells& cells) {
  if (std::exchange(step_, cells.step) != cells.step) flush();
  if (cells.step > 1 && to_.unsent() > kMostUnsent) return;
  if (bytes_.empty()) oldest_ = Clock::now();
  add_tile(number_, result, cells, bytes_);
  if (bytes_.size() >= kFullBatch || Clock::now() - oldest_ >= kOldestTile) flush();
}

void TileBatch::flush() {
  if (!bytes_.empty()) to_.send_binary(std::exchange(bytes_, {}));
}

}  // namespace itin::cli
