// The store that is served, and the surfaces of it that are kept in memory for live views.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <semaphore>
#include <string>

#include <itin/cross_section.hpp>
#include <itin/detail.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <viewshed/held_surface.hpp>

namespace itin::cli {

/// A surface of the store, for viewsheds and for single lines. Safe for concurrent use.
struct ServedSurface {
  ServedSurface(const Store& store, const Detail& detail, const ThemeChoice& themes, std::uint64_t memory_bytes);

  viewshed::PagedSurface views;
  SectionSurface lines;
  std::optional<SectionSurface> bare;  ///< the ground under raised features; nothing where there are none
};

/// A place among the calls that run at once, so that together they stay within the memory. It is given back at the end
/// of its life.
class CallPlace {
 public:
  static constexpr std::ptrdiff_t kMost = 4;
  using Places = std::counting_semaphore<kMost>;

  /// Waits for a place. Throws Cancelled.
  CallPlace(Places& places, const Progress& progress);
  ~CallPlace() { places_.release(); }
  CallPlace(const CallPlace&) = delete;
  CallPlace& operator=(const CallPlace&) = delete;

 private:
  Places& places_;
};

/// Safe for concurrent use.
class ServedStore {
 public:
  /// Opens the store. Throws as Store does. `memory_bytes` is for blocks, surfaces and the ground of cells.
  ServedStore(const std::string& path, std::uint64_t memory_bytes);

  const Store& store() const { return store_; }
  const StoreMetadata& metadata() const { return store_.metadata(); }
  std::uint64_t memory_bytes() const { return memory_bytes_; }
  /// The most cells that a call may have, so that all that run at once take an eighth of the memory.
  std::uint64_t most_cells() const;
  CallPlace::Places& places() { return places_; }
  /// A text that is another one for another store, or for a store that has been replaced.
  const std::string& version() const { return version_; }
  /// Throws FileError where the file is no longer the one that was opened, of which it is known only in part what it
  /// held: no answer may come of two stores.
  void require_unchanged() const;

  /// The surface at a tolerance with these themes. The two that were asked for last are kept. Throws InputError for
  /// themes that the store does not have.
  std::shared_ptr<ServedSurface> surface(const Detail& detail, const ThemeChoice& themes);

 private:
  struct Kept {
    std::string key;
    std::shared_ptr<ServedSurface> surface;
  };

  Store store_;
  std::uint64_t memory_bytes_;
  std::string version_;
  CallPlace::Places places_{CallPlace::kMost};
  std::mutex mutex_;
  std::list<Kept> kept_;  ///< the one used last first
};

}  // namespace itin::cli
