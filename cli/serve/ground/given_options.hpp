// Options that come as JSON or in a query, by the names of the command line: they become its arguments, so that they
// are understood, and refused, as there.
//
//   const std::vector<std::string> arguments = arguments_of({{"observer", "1,2,3"}, {"absolute-heights", true}});
//   // {"--observer=1,2,3", "--absolute-heights"}
//   CLI::App app;
//   options.declare(app);
//   take_arguments(app, arguments);
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/document.hpp>

#include "serve/http/http_message.hpp"

namespace itin::cli {

class ServedStore;

/// An object of names without dashes, and texts, numbers, true for flags, or lists of these for options that may be
/// given again. Throws InputError.
std::vector<std::string> arguments_of(const Document& options);
std::vector<std::string> arguments_of(const HttpQuery& query);

/// The arguments of a verb's call over the served store: STORE, and these.
std::vector<std::string> call_of(const ServedStore& served, std::vector<std::string> arguments);

/// Gives an app's options their values. Throws InputError, as the program does for a wrong call.
void take_arguments(CLI::App& app, const std::vector<std::string>& arguments);
/// Throws InputError where options that name files have values. Arguments that are no options, such as STORE, are ours.
void refuse_files(const CLI::App& app);

/// The command line that has these arguments, quoted for a shell.
std::string command_line(const std::vector<std::string>& words);

}  // namespace itin::cli
