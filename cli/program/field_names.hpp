// Puts messages of the libraries into the words of the command line.
#pragma once

#include <string>

namespace itin::cli {

/// Replaces names of fields by names of options. Libraries name the fields of their requests between backticks,
/// "`to_crs`"; the result has "--to-crs".
std::string in_options(std::string message);

}  // namespace itin::cli
