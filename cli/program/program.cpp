#include "program/program.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/likely_meant.hpp>
#include <itin/peak_memory.hpp>
#include <viewshed/job.hpp>

#include "program/call_error.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/help_document.hpp"
#include "program/interruption.hpp"
#include "program/stderr_progress.hpp"
#include "program/thread_limit.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"
#include "program/verb_call.hpp"

namespace itin::cli {

namespace {

enum Status : int { kDone = 0, kFailed = 1, kWrongCall = 2, kInterrupted = kInterruptedStatus };

/// Throws InputError for an unknown verb, which CLI11 would call an unexpected argument.
void require_known_verb(const std::vector<std::string>& arguments, const std::vector<std::unique_ptr<Verb>>& verbs) {
  std::vector<std::string> names;
  for (const auto& verb : verbs)
    if (!verb->is_internal() || (!arguments.empty() && arguments.front() == verb->name()))
      names.push_back(verb->name());
  if (arguments.empty()) throw InputError(fmt::format("no verb given; the verbs are {}", fmt::join(names, ", ")));
  const std::string& first = arguments.front();
  const bool option = !first.empty() && first.front() == '-';
  if (!option && std::find(names.begin(), names.end(), first) == names.end()) {
    throw InputError(fmt::format("unknown verb '{}'{}; the verbs are {}", first, did_you_mean(first, names),
                                 fmt::join(names, ", ")));
  }
}

Document complete_document(const Verb& verb, Result& result, double seconds) {
  Document document = call_document(verb);
  Document statistics = result.document.value("statistics", Document::object());
  result.document.erase("statistics");
  document.update(result.document);
  document["warnings"] = result.warnings;
  statistics["seconds"] = seconds;
  statistics["peak_memory_bytes"] = peak_memory_bytes();
  document["statistics"] = std::move(statistics);
  return document;
}

void print(const std::string& text) {
  std::cout << text << std::flush;
  if (!std::cout) throw FileError("standard output", "could not be written; check the disk or pipe behind it");
}

void run_verb(Verb& verb, CLI::App& options, const Everywhere& everywhere) {
  const auto start = std::chrono::steady_clock::now();
  complete_call(verb, options, everywhere);
  require_threads();
  Result result;
  {
    StderrProgress progress(everywhere.style());
    result = verb.execute(progress);
  }
  for (std::string& warning : result.warnings) warning = in_options(std::move(warning));
  for (const std::string& warning : result.warnings) std::cerr << "itin: warning: " << warning << "\n";
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  print(everywhere.json ? json_text(complete_document(verb, result, elapsed.count()), 2) + "\n" : result.text);
  if (!result.failure.empty()) throw Error(result.failure);
}

/// Parts the arguments of a verb that takes a call from those of the call: they begin with the name of a verb, after
/// the first verb and two words at least.
std::pair<std::vector<std::string>, std::vector<std::string>> split_at_call(
    const std::vector<std::string>& arguments, const std::vector<std::unique_ptr<Verb>>& verbs) {
  constexpr std::ptrdiff_t kWords = 3;
  const auto is_verb = [&](const std::string& name) {
    return std::any_of(verbs.begin(), verbs.end(), [&](const auto& verb) { return verb->name() == name; });
  };
  const bool takes_call = std::any_of(verbs.begin(), verbs.end(), [&](const auto& verb) {
    return verb->name() == arguments.front() && verb->takes_call();
  });
  if (!takes_call || std::ssize(arguments) <= kWords) return {arguments, {}};
  const auto call = std::find_if(arguments.begin() + kWords, arguments.end(), is_verb);
  return {{arguments.begin(), call}, {call, arguments.end()}};
}

void parse_and_run(const std::vector<std::string>& arguments) {
  const std::vector<std::unique_ptr<Verb>> verbs = make_verbs();
  require_known_verb(arguments, verbs);

  CLI::App app("Intervisibility and viewsheds on a multiscale implicit TIN", "itin");
  app.formatter(std::make_shared<HelpText>());
  app.set_version_flag("--version", "itin " ITIN_VERSION);
  app.require_subcommand(1);
  Everywhere everywhere;
  for (const auto& verb : verbs) declare_verb(app, *verb, everywhere);
  const auto [own, call] = split_at_call(arguments, verbs);
  try {
    parse_arguments(app, own);
  } catch (const CLI::CallForHelp&) {
    const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    return print(json ? json_text(help_document(app), 2) + "\n" : app.help());
  } catch (const CLI::CallForVersion&) {
    return print(app.version() + "\n");
  }
  CLI::App& chosen = *app.get_subcommands().front();
  const auto verb =
      std::find_if(verbs.begin(), verbs.end(), [&](const auto& v) { return v->name() == chosen.get_name(); });
  if (!call.empty()) (*verb)->take_call(call);
  try {
    run_verb(**verb, chosen, everywhere);
  } catch (const std::bad_alloc&) {
    throw Error(out_of_memory(chosen));
  }
}

int report(const std::string& error, Status status) {
  end_interruptions();
  std::string message = in_options(error);
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << "itin: error: " << message << std::endl;
  return status;
}

}  // namespace

int run(int argc, char** argv) {
  try {
    catch_interruptions();
    parse_and_run({argv + 1, argv + argc});
    end_interruptions();
    return kDone;
  } catch (const Cancelled&) {
    end_interruptions();
    say_interrupted();
    return kInterrupted;
  } catch (const viewshed::JobError& error) {
    return report(error.what(), static_cast<Status>(error.end()));
  } catch (const InputError& error) {
    return report(error.what(), kWrongCall);
  } catch (const Error& error) {
    return report(error.what(), kFailed);
  } catch (const std::bad_alloc&) {
    return report("out of memory; free some", kFailed);
  } catch (const std::system_error& error) {
    return report(error.what(), kFailed);
  } catch (const std::exception& error) {
    return report(
        fmt::format("an internal error of itin ({}); please report it with the command that led to it", error.what()),
        kFailed);
  } catch (...) {
    return report("an internal error of itin; please report it with the command that led to it", kFailed);
  }
}

}  // namespace itin::cli
