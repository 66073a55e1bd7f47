// The names of features that `--without` gives.
#pragma once

#include <string>
#include <vector>

namespace itin::cli {

/// Reads what `--without` gives: features with semicolons between, or a file with one in each line, in which empty
/// lines count for nothing. Throws InputError for an empty name, FileError.
std::vector<std::string> omitted_in(const std::string& text);

}  // namespace itin::cli
