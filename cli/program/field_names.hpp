// Messages of the libraries in the words of the command line.
#pragma once

#include <string>

namespace itin::cli {

/// Libraries name the fields of their requests, between backticks: "`to_crs`". Here they are options: "--to-crs".
std::string in_options(std::string message);

}  // namespace itin::cli
