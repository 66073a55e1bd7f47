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

}  // namespace itin
