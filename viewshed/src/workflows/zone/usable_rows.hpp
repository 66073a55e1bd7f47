// The error about a table of which no row can be used.
#pragma once

#include <cstddef>
#include <string>

#include <fmt/format.h>

namespace itin::viewshed {

/// Says so, and what is wrong with the first of its rows.
inline std::string none_usable(const std::string& path, std::size_t rows, const std::string& first) {
  return fmt::format("{}: none of its rows can be used ({} in all); the first: {}", path, rows, first);
}

}  // namespace itin::viewshed
