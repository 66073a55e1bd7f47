#include "serve/ground/served_store.hpp"

#include <algorithm>
#include <chrono>
#include <sys/stat.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/memory_shares.hpp>

namespace itin::cli {

namespace {

constexpr std::size_t kMostSurfaces = 2;
/// The memory that a running call has for each of its cells.
constexpr std::uint64_t kBytesPerCell = 8;
constexpr std::uint64_t kPartForCalls = 8;
constexpr std::chrono::milliseconds kBetweenTries{5};

std::string version_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return fmt::format("{:x}-{:x}-{:x}.{:x}", status.st_ino, status.st_size, status.st_mtim.tv_sec,
                     status.st_mtim.tv_nsec);
}

}  // namespace

ServedSurface::ServedSurface(const Store& store, const Detail& detail, const ThemeChoice& themes,
                             std::uint64_t memory_bytes)
    : views(store, detail, themes, {.memory_bytes = memory_bytes / 2}),
      lines(store, detail, themes, section_cache_within(memory_bytes)) {
  if (themes.includes_raised(store.metadata().themes))
    bare.emplace(store, detail, ThemeChoice::none(), section_cache_within(memory_bytes));
}

CallPlace::CallPlace(Places& places, const Progress& progress) : places_(places) {
  while (!places_.try_acquire_for(kBetweenTries)) progress.throw_if_cancelled();
}

std::uint64_t ServedStore::most_cells() const {
  return memory_bytes_ / kPartForCalls / CallPlace::kMost / kBytesPerCell;
}

ServedStore::ServedStore(const std::string& path, std::uint64_t memory_bytes)
    : store_(path, cache_within(memory_bytes)), memory_bytes_(memory_bytes), version_(version_of(path)) {}

void ServedStore::require_unchanged() const {
  const std::string version = version_of(store_.path());
  if (version.empty()) throw FileError(store_.path(), "is no longer there; put it back, or serve another store");
  if (version != version_)
    throw FileError(store_.path(), "was changed or replaced since the server started; start itin serve again");
}

std::shared_ptr<ServedSurface> ServedStore::surface(const Detail& detail, const ThemeChoice& themes) {
  const std::string key = fmt::format("{} {}", detail.coarsest(), fmt::join(themes.names(metadata().themes), ","));
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.key == key; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
  } else {
    kept_.push_front({key, std::make_shared<ServedSurface>(store_, detail, themes, memory_bytes_ / kMostSurfaces)});
    if (kept_.size() > kMostSurfaces) kept_.pop_back();
  }
  return kept_.front().surface;
}

}  // namespace itin::cli
