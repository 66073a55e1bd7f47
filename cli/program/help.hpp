// What --help shows: groups of options, and descriptions that are broken into lines.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace itin::cli {

// The groups that several verbs have.
inline constexpr const char* kOutputs = "Outputs";
inline constexpr const char* kMapsOnPaper = "Maps on paper";
inline constexpr const char* kRadio = "Radio";
inline constexpr const char* kSurface = "Surface";
inline constexpr const char* kEarth = "Curvature and refraction";
inline constexpr const char* kRunning = "Running";
/// What help does not show.
inline constexpr const char* kHidden = "";

/// Puts all options into this group that are declared from here on, until the next call. Groups are shown in the order
/// of their first options.
void begin_group(CLI::App& app, const char* group);

/// Breaks descriptions into lines that fit the terminal, or into lines of 100 columns where --help goes elsewhere. A
/// description may have line breaks of its own.
class HelpText : public CLI::Formatter {
 public:
  HelpText();
  std::string make_group(std::string group, bool positional, std::vector<const CLI::Option*> options) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace itin::cli
