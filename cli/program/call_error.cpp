#include "program/call_error.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/likely_meant.hpp>

namespace itin::cli {

namespace {

bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument.front() == '-';
}

std::vector<std::string> option_names(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The message about arguments that no option or place in the call takes. A misspelt option comes first, for the
/// argument that follows it is often its value.
std::string unexpected(const CLI::App& verb, const std::vector<std::string>& arguments) {
  const auto option = std::find_if(arguments.begin(), arguments.end(), is_option);
  if (option == arguments.end())
    return fmt::format("unexpected argument '{}': no option takes it, nor is it in place of one", arguments.front());
  const std::string name = option->substr(0, option->find('='));
  return fmt::format("unknown option '{}'{}", name, did_you_mean(name, option_names(verb)));
}

std::string named(const CLI::Option& option) {
  return option.get_positional() ? option.get_name() : option.get_name() + " " + option.get_type_name();
}

/// The options that are required but not given.
std::vector<std::string> missing(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    if (option->get_required() && option->count() == 0) names.push_back(named(*option));
  return names;
}

/// The message about an option with too many values, or without the value it takes.
std::string mismatch(const CLI::App& verb, const CLI::ParseError& error) {
  for (const CLI::Option* option : verb.get_options()) {
    const auto most = static_cast<std::size_t>(option->get_items_expected_max());
    const bool single = option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw;
    if (single && most > 0 && option->count() > most)
      return fmt::format("{} is given {} times; give it once", option->get_name(), option->count());
  }
  const std::string text = error.what();
  const CLI::Option* option = verb.get_option_no_throw(text.substr(0, text.find(':')));
  if (option == nullptr) return "the call is not understood";
  return fmt::format("{} has no value; give {}", option->get_name(), named(*option));
}

/// The message about a flag with something other than a truth behind its equals sign.
std::string bad_flag(const CLI::App& verb) {
  for (const CLI::Option* option : verb.get_options())
    if (option->get_items_expected_max() == 0 && option->count() > 0 && option->results().back() != "true")
      return fmt::format("{} takes no value, but has '{}'", option->get_name(), option->results().back());
  return "the call is not understood";
}

}  // namespace

std::string option_as_value(const CLI::App& verb) {
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& value : option->results())
      if (is_option(value) && verb.get_option_no_throw(value) != nullptr)
        return fmt::format("{} has no value: the option {} follows it; give {}", option->get_name(), value,
                           named(*option));
  return "";
}

std::string call_error(const CLI::App& verb, const CLI::ParseError& error) {
  if (std::string message = option_as_value(verb); !message.empty()) return message;
  const std::vector<std::string> rest = verb.remaining();
  if (std::any_of(rest.begin(), rest.end(), is_option)) return unexpected(verb, rest);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) return mismatch(verb, error);
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) return bad_flag(verb);
  if (const auto names = missing(verb); !names.empty()) return fmt::format("give {}", fmt::join(names, " and "));
  return rest.empty() ? "the call is not understood" : unexpected(verb, rest);
}

std::string out_of_memory(const CLI::App& verb) {
  constexpr std::pair<const char*, const char*> kRemedies[] = {
      {"--bbox", "a smaller window"}, {"--radius", "a smaller --radius"},
      {"--cell", "a larger --cell"},  {"--tolerance", "a coarser --tolerance"},
      {"--memory", "less --memory"},  {"SOURCE", "fewer sources at once"}};
  std::vector<std::string> remedies;
  for (const auto& [option, remedy] : kRemedies)
    if (verb.get_option_no_throw(option) != nullptr) remedies.emplace_back(remedy);
  if (remedies.empty()) return "out of memory; free some";
  return fmt::format("out of memory; free some, or give {}", fmt::join(remedies, " or "));
}

}  // namespace itin::cli
