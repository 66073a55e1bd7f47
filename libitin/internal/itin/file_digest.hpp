// A digest that tells one source file from another.
#pragma once

#include <string>

#include <itin/progress.hpp>

namespace itin {

/// The SHA-256 of a file's bytes in hexadecimal; empty for what is not a plain file (/vsizip/..., a directory).
/// Throws FileError, Cancelled.
std::string file_sha256(const std::string& path, Progress& progress);

}  // namespace itin
