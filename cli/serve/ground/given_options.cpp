#include "serve/ground/given_options.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/call_error.hpp"
#include "program/call_files.hpp"
#include "serve/ground/served_store.hpp"

namespace itin::cli {

namespace {

void require_option_name(const std::string& name) {
  const bool plain = !name.empty() && name.front() != '-' &&
                     std::all_of(name.begin(), name.end(), [](char c) { return c == '-' || (c >= 'a' && c <= 'z'); });
  if (!plain) throw InputError(fmt::format("'{}' is no name of an option; give it without dashes", name));
}

void add_argument(const std::string& name, const std::string& value, std::vector<std::string>& arguments) {
  if (value.empty()) throw InputError(fmt::format("--{}: its value is empty; give one, or leave it out", name));
  arguments.push_back(fmt::format("--{}={}", name, value));
}

void add_argument(const std::string& name, const Document& value, std::vector<std::string>& arguments) {
  if (value.is_boolean()) {
    if (value.get<bool>()) arguments.push_back("--" + name);
  } else if (value.is_string()) {
    add_argument(name, value.get<std::string>(), arguments);
  } else if (value.is_number()) {
    add_argument(name, value.dump(), arguments);
  } else {
    throw InputError(fmt::format("--{}: expected a text, a number, true, or a list of these", name));
  }
}

/// Whether a shell takes the word as it is.
bool is_plain_word(const std::string& word) {
  return !word.empty() && word.find_first_not_of(
                              "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                              "-_./,:=+%@") == std::string::npos;
}

std::string quoted_word(const std::string& word) {
  if (is_plain_word(word)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::vector<std::string> arguments_of(const Document& options) {
  if (!options.is_object()) throw InputError("`options` is not an object of names and values");
  std::vector<std::string> arguments;
  for (const auto& [name, value] : options.items()) {
    require_option_name(name);
    if (!value.is_array()) {
      add_argument(name, value, arguments);
      continue;
    }
    for (const Document& one : value) add_argument(name, one, arguments);
  }
  return arguments;
}

std::vector<std::string> arguments_of(const HttpQuery& query) {
  std::vector<std::string> arguments;
  for (const auto& [name, value] : query) {
    require_option_name(name);
    add_argument(name, value, arguments);
  }
  return arguments;
}

std::vector<std::string> call_of(const ServedStore& served, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), std::filesystem::absolute(served.store().path()).string());
  return arguments;
}

void take_arguments(CLI::App& app, const std::vector<std::string>& arguments) {
  app.set_help_flag();
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    throw InputError(call_error(app, error));
  }
}

void refuse_files(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->count() > 0 && !option->get_positional() && !role_of(*option).empty())
      throw InputError(
          fmt::format("{}: names a file, which is not for a client of the server to name; use the command "
                      "line",
                      option->get_name()));
}

std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted_word(word);
  return line;
}

}  // namespace itin::cli
