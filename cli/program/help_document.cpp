#include "program/help_document.hpp"

#include <algorithm>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/call_files.hpp"
#include "program/help.hpp"

namespace itin::cli {

namespace {

/// Returns the unit of values of this type; empty where they have none.
std::string unit_of(const std::string& type) {
  constexpr std::pair<const char*, const char*> kUnits[] = {
      {"METRES", "m"}, {"KM", "km"}, {"GHZ", "GHz"}, {"DEGREES", "deg"}, {"BEARING", "deg"}};
  for (const auto& [name, unit] : kUnits)
    if (type == name) return unit;
  return {};
}

/// Returns the first group of every place where the expression holds.
std::vector<std::string> all_found(const std::string& text, const std::regex& expression) {
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) found.push_back((*at)[1]);
  return found;
}

/// Returns the values to choose from: those of a type such as "ground|surface", or those that the help explains line by
/// line. None where there are others, which types have in capitals.
std::vector<std::string> choices_of(const std::string& type, const std::string& help) {
  static const std::regex listed(R"(([A-Z]*[a-z0-9-]+\|)+[A-Z]*[a-z0-9-]+)"), item(R"(([^|]+))"),
      line(R"((?:^|\n)([a-z-]+) - )");
  return std::regex_match(type, listed) ? all_found(type, item) : all_found(help, line);
}

/// Returns the default as the help words it, "(default: 2)" or, of choices, "ground (default)"; empty where it says
/// none.
std::string default_of(const std::string& help, const std::vector<std::string>& choices) {
  static const std::regex stated(R"(\(default: ([^)]*)\))"), marked(R"(([a-z-]+) (?:- [^\n(]*)?\((?:the )?default\))");
  if (const auto found = all_found(help, stated); !found.empty()) return found.front();
  for (const std::string& found : all_found(help, marked))
    if (found == "all" || std::find(choices.begin(), choices.end(), found) != choices.end()) return found;
  return {};
}

std::vector<std::string> names_of(const CLI::Option& option) {
  if (option.get_positional()) return {option.get_name()};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back(fmt::format("-{}", name));
  for (const std::string& name : option.get_lnames()) names.push_back(fmt::format("--{}", name));
  return names;
}

Document option_document(const CLI::Option& option) {
  const std::string& help = option.get_description();
  const std::string type = option.get_type_name();
  const bool flag = option.get_items_expected_max() == 0;
  Document document{{"names", names_of(option)},
                    {"help", help},
                    {"kind", flag                      ? "flag"
                             : option.get_positional() ? "argument"
                                                       : "value"},
                    {"required", option.get_required()},
                    {"repeats", option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll ||
                                    option.get_items_expected_max() > 1}};
  if (flag) return document;
  document["type"] = type;
  if (const std::string unit = unit_of(type); !unit.empty()) document["unit"] = unit;
  const std::vector<std::string> choices = choices_of(type, help);
  if (!choices.empty()) document["choices"] = choices;
  if (const std::string value = default_of(help, choices); !value.empty()) document["default"] = value;
  if (const std::string role = role_of(option); !role.empty()) document["files"] = role;
  return document;
}

Document verb_document(const CLI::App& verb) {
  Document groups = Document::array();
  for (const std::string& group : verb.get_groups()) {
    if (group == kHidden) continue;
    Document options = Document::array();
    for (const CLI::Option* option : verb.get_options([&](const CLI::Option* o) { return o->get_group() == group; }))
      options.push_back(option_document(*option));
    if (!options.empty()) groups.push_back({{"name", group}, {"options", std::move(options)}});
  }
  return {{"name", verb.get_name()}, {"summary", verb.get_description()}, {"groups", std::move(groups)}};
}

}  // namespace

Document help_document(const CLI::App& app) {
  Document verbs = Document::array();
  for (const CLI::App* verb : app.get_subcommands({}))
    if (verb->get_group() != kHidden) verbs.push_back(verb_document(*verb));
  return {{"itin", ITIN_VERSION}, {"verbs", std::move(verbs)}};
}

}  // namespace itin::cli
