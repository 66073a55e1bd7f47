// `--memory SIZE`: what a call may take to work in. The result never depends on it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <itin/cross_section.hpp>
#include <itin/store.hpp>

namespace itin::cli {

class MemoryOption {
 public:
  /// `help` says what happens where it does not hold all at once, and the default.
  void declare(CLI::App& app, const std::string& help);
  /// Nothing where it is not given. Throws InputError.
  std::optional<std::uint64_t> bytes() const;

 private:
  std::string text_;
};

/// The help of verbs that read along lines.
inline constexpr const char* kKeptOfTheStore =
    "Memory for what is kept of the store, for example 100M; the result does not depend on it (default: as much as "
    "helps, less than 1G)";

/// The help of verbs that look at surfaces.
inline constexpr const char* kReadInParts =
    "Memory to work in, for example 2G. Surfaces that exceed it are read in parts, and rasters that do are refused; "
    "the result does not depend on it (default: 1G)";

/// What is kept of a store's blocks: at most a quarter of the memory, where that is bounded.
StoreOptions cache_within(std::optional<std::uint64_t> memory_bytes);
/// What each surface keeps for cross-sections: at most an eighth.
SectionSurface::Options section_cache_within(std::optional<std::uint64_t> memory_bytes);

}  // namespace itin::cli
