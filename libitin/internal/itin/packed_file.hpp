// Files that the libraries write for themselves: compressed, with a checksum.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace itin {

/// XXH3 of the bytes, the same on every machine.
std::uint64_t content_hash(std::string_view bytes);

/// As write_file() does; an existing file is replaced. Throws FileError.
void write_packed(const std::string& path, std::string_view bytes);

/// The bytes that write_packed() was given. Throws FileError where the file cannot be read, was not written by it, or
/// is damaged.
std::string read_packed(const std::string& path);

}  // namespace itin
