// A digest that tells one source file from another.
#pragma once

#include <string>

#include <itin/progress.hpp>

namespace itin {

/// Returns the SHA-256 of a file's bytes in hexadecimal; empty where the path is no plain file (/vsizip/..., a
/// directory). Throws FileError, Cancelled.
std::string file_sha256(const std::string& path, Progress& progress);

}  // namespace itin
