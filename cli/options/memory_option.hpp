// `--memory SIZE`: the memory that a call may use. The result never depends on it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <itin/memory_shares.hpp>

namespace itin::cli {

class MemoryOption {
 public:
  /// `help` says what happens where not everything fits, and gives the default.
  void declare(CLI::App& app, const std::string& help);
  /// The memory; nothing where it is not given. Throws InputError.
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

}  // namespace itin::cli
