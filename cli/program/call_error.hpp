// Messages about calls that cannot be parsed, in our own words: CLI11's are for its callers.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace itin::cli {

/// One line, without the way to the help. `verb` is the one whose options were being parsed.
std::string call_error(const CLI::App& verb, const CLI::ParseError& error);

/// The message about a lack of memory. It names the verb's options that reduce how much is worked on at once.
std::string out_of_memory(const CLI::App& verb);

}  // namespace itin::cli
