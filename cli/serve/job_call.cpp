#include "serve/job_call.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>

#include "program/call_files.hpp"
#include "program/verb.hpp"
#include "serve/given_options.hpp"

namespace itin::cli {

namespace {

constexpr std::pair<const char*, std::unique_ptr<Verb> (*)()> kJobVerbs[] = {{"viewshed", make_viewshed_verb},
                                                                             {"visibility", make_visibility_verb},
                                                                             {"tin", make_tin_verb},
                                                                             {"profile", make_profile_verb},
                                                                             {"los", make_los_verb}};

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

/// Throws InputError where an option reads a file, or would write one anywhere but in the job's folder.
void require_own_files(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string role = role_of(*option);
    if (option->count() == 0 || option->get_positional() || role.empty()) continue;
    if (role == "reads")
      throw InputError(
          fmt::format("{}: names a file to read, which is not for a client of the server to name; use the "
                      "command line",
                      option->get_name()));
    for (const std::string& name : option->results())
      if (!is_plain_file_name(name))
        throw InputError(fmt::format("{} '{}': give a plain file name of letters, digits, '.', '_' and '-'",
                                     option->get_name(), name));
  }
}

}  // namespace

std::vector<std::string> job_verbs() {
  std::vector<std::string> names;
  for (const auto& [name, make] : kJobVerbs) names.emplace_back(name);
  return names;
}

JobCall job_call(const ServedStore& served, const Document& asked, std::uint64_t memory_bytes, int threads) {
  if (!asked.is_object() || !asked.contains("verb") || !asked["verb"].is_string())
    throw InputError("send {\"verb\": NAME, \"options\": {...}}");
  JobCall call{asked["verb"].get<std::string>(), {}, {}};
  const std::unique_ptr<Verb> verb = make_job_verb(call.verb);
  CLI::App app;
  verb->declare(app);
  const std::vector<std::string> arguments = call_of(served, arguments_of(asked.value("options", Document::object())));
  take_arguments(app, arguments);
  require_own_files(app);
  CLI::Option* const memory = app.get_option_no_throw("--memory");
  if (memory != nullptr && memory->count() > 0) throw InputError("--memory: is the server's own; leave it out");
  verb->complete();
  verb->validate();

  call.arguments = {call.verb};
  call.arguments.insert(call.arguments.end(), arguments.begin(), arguments.end());
  call.command = "itin " + command_line(call.arguments);
  if (memory != nullptr) call.arguments.push_back(fmt::format("--memory={}", memory_bytes));
  call.arguments.insert(call.arguments.end(), {fmt::format("--threads={}", threads), "--json", "--progress=lines"});
  return call;
}

}  // namespace itin::cli
