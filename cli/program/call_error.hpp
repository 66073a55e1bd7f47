// Writes messages about calls that cannot be parsed, in our own words, for CLI11's are for its callers.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace itin::cli {

/// Returns the message about an option that another option follows where its value should be; empty where there is
/// none.
std::string option_as_value(const CLI::App& verb);

/// Returns one line, without the advice to see the help. `verb` is the one whose options were being parsed.
std::string call_error(const CLI::App& verb, const CLI::ParseError& error);

/// The message about a lack of memory. It names the verb's options that reduce the work done at once.
std::string out_of_memory(const CLI::App& verb);

}  // namespace itin::cli
