#include "serve/calls/job_call.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>

#include "program/call_files.hpp"
#include "program/verb.hpp"
#include "serve/ground/given_options.hpp"

namespace itin::cli {

namespace {

constexpr std::pair<const char*, std::unique_ptr<Verb> (*)()> kJobVerbs[] = {{"viewshed", make_viewshed_verb},
                                                                             {"visibility", make_visibility_verb},
                                                                             {"tin", make_tin_verb},
                                                                             {"profile", make_profile_verb},
                                                                             {"los", make_los_verb},
                                                                             {"ztv", make_ztv_verb},
                                                                             {"site", make_site_verb},
                                                                             {"premises", make_premises_verb},
                                                                             {"dwellings", make_dwellings_verb}};

std::unique_ptr<Verb> make_job_verb(const std::string& name) {
  for (const auto& [known, make] : kJobVerbs)
    if (name == known) return make();
  throw InputError(fmt::format("'verb' must be one of {}", fmt::join(job_verbs(), ", ")));
}

/// Whether a name is of a file in the job's own folder, on every system.
bool is_plain_file_name(const std::string& name) {
  return !name.empty() && name.size() <= 100 && name.front() != '.' && name.front() != '-' &&
         name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-") ==
             std::string::npos;
}

/// Whether an option that reads a file means none by this value: a word for something else, or a polygon as text.
bool means_no_file(const CLI::Option& option, const std::string& value) {
  if (option.get_name() == "--demand" && (value == "cells" || value == "premises")) return true;
  const bool polygon = value.starts_with("POLYGON") || value.starts_with("MULTIPOLYGON");
  return polygon && value.find_first_not_of("MULTIPOLYGON (),.0123456789eE+-") == std::string::npos;
}

/// Throws InputError where an option reads a file that is no upload, or would write one anywhere but in the job's
/// folder. Returns the uploads that are read.
std::vector<std::string> own_files(const CLI::App& app, const Uploads& uploads) {
  std::vector<std::string> read;
  for (const CLI::Option* option : app.get_options()) {
    const std::string role = role_of(*option);
    if (option->count() == 0 || option->get_positional() || role.empty()) continue;
    for (const std::string& name : option->results()) {
      if (role == "reads" && means_no_file(*option, name)) continue;
      if (role == "reads" && !uploads.has(name))
        throw InputError(
            fmt::format("{}: names a file to read, which is not for a client of the server to name; give the name of "
                        "an upload, or use the command line",
                        option->get_name()));
      if (role == "reads") {
        if (std::find(read.begin(), read.end(), name) == read.end()) read.push_back(name);
      } else if (!is_plain_file_name(name) || uploads.has(name)) {
        throw InputError(fmt::format("{} '{}': give a plain file name of letters, digits, '.', '_' and '-'",
                                     option->get_name(), name));
      }
    }
  }
  return read;
}

/// What a verb would take of a file that has options in it would pass this by.
void refuse_parameter_files(const CLI::App& app) {
  const CLI::Option* const params = app.get_option_no_throw("--params");
  if (params != nullptr && params->count() > 0) throw InputError("--params: give the options themselves");
}

}  // namespace

std::vector<std::string> job_verbs() {
  std::vector<std::string> names;
  for (const auto& [name, make] : kJobVerbs) names.emplace_back(name);
  return names;
}

JobCall job_call(const ServedStore& served, const Uploads& uploads, const Document& asked, std::uint64_t memory_bytes,
                 int threads) {
  if (!asked.is_object() || !asked.contains("verb") || !asked["verb"].is_string())
    throw InputError("send {\"verb\": NAME, \"options\": {...}}");
  JobCall call{asked["verb"].get<std::string>(), asked.value("options", Document::object()), {}, {}, {}};
  const std::unique_ptr<Verb> verb = make_job_verb(call.verb);
  CLI::App app;
  verb->declare(app);
  const std::vector<std::string> arguments = call_of(served, arguments_of(call.options));
  take_arguments(app, arguments);
  refuse_parameter_files(app);
  call.uploads = own_files(app, uploads);
  CLI::Option* const memory = app.get_option_no_throw("--memory");
  if (memory != nullptr && memory->count() > 0) throw InputError("--memory: is the server's own; leave it out");
  verb->complete();
  verb->validate();

  call.arguments = {call.verb};
  call.arguments.insert(call.arguments.end(), arguments.begin(), arguments.end());
  call.command = "itin " + command_line(call.arguments);
  if (memory != nullptr) call.arguments.push_back(fmt::format("--memory={}", memory_bytes));
  call.arguments.insert(call.arguments.end(), {fmt::format("--threads={}", threads), "--json", "--progress=lines"});
  if (!call.uploads.empty()) call.arguments.emplace_back("--uploads");
  return call;
}

}  // namespace itin::cli
