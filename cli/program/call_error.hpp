// What is wrong with a call that cannot be parsed, in our own words: CLI11's are for its callers.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace itin::cli {

/// One line, without the way to the help. `verb` is the one whose options were being parsed.
std::string call_error(const CLI::App& verb, const CLI::ParseError& error);

/// What the options of a verb that change how much is worked on at once could do against a lack of memory.
std::string out_of_memory(const CLI::App& verb);

}  // namespace itin::cli
