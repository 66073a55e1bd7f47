// Files that the libraries write for themselves: compressed, with a checksum.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace itin {

/// Returns the XXH3 of the bytes, equal on every machine.
std::uint64_t content_hash(std::string_view bytes);

/// Writes as write_file() does, and waits until the file is on disk; an existing file is replaced. Throws FileError.
void write_packed(const std::string& path, std::string_view bytes);

/// Returns the bytes that write_packed() was given. Throws FileError where the file cannot be read, was not written by
/// write_packed(), or is damaged.
std::string read_packed(const std::string& path);

/// What became of a file that was to have a name that nobody takes from it again.
enum class Placed {
  kPlaced,    ///< it has the name, and is on disk with it
  kSame,      ///< another file has the name, with the same bytes
  kDiffering  ///< another file has the name, with other bytes
};
/// Gives a file its last name in the same file system, whatever other machines are doing, and removes its first name;
/// where the bytes differ, that stays. Throws FileError, also where the folder of the last name cannot be brought to
/// disk; a file system that knows no such thing is let pass.
Placed place_for_good(const std::string& path, const std::string& last_name);

}  // namespace itin
