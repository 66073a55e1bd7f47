#include "program/program.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <sys/resource.h>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/likely_meant.hpp>
#include <itin/network.hpp>
#include <itin/parallel.hpp>

#include "program/call_error.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/help_document.hpp"
#include "program/interruption.hpp"
#include "program/stderr_progress.hpp"
#include "program/thread_limit.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

enum Status { kDone = 0, kFailed = 1, kWrongCall = 2, kInterrupted = kInterruptedStatus };

/// The options that every verb has.
struct Everywhere {
  bool json = false;
  bool quiet = false;
  bool network = false;
  bool uploads = false;
  std::string threads, progress;

  void declare(CLI::App& app) {
    begin_group(app, kRunning);
    app.add_flag("--json", json, "Print the result as one JSON document");
    app.add_flag("--quiet", quiet, "No progress; the result and warnings are still told");
    app.add_option(
           "--progress", progress,
           "lines: a line of JSON every 200 ms on stderr, with stage, share and seconds_left, for programs that "
           "run this one")
        ->type_name("lines");
    app.add_option("--threads", threads, "Threads to use; the result never depends on it (default: all cores)")
        ->type_name("N");
    app.add_flag("--allow-network", network,
                 "Let sources send the requests that they name; none leaves this machine else");
    app.add_flag("--uploads", uploads, "Files were sent by strangers, to itin serve")->group(kHidden);
  }
  StderrProgress::Style style() const {
    return progress.empty() ? StderrProgress::style_for(quiet) : StderrProgress::Style::kJson;
  }
  void apply() const {
    if (network) allow_network();
    if (uploads) read_tables_alone();
    if (!progress.empty()) parse_choice("--progress", progress, {"lines"});
    if (!progress.empty() && quiet) throw InputError("--progress and --quiet exclude each other; give one of them");
    if (!threads.empty()) set_thread_count(parse_whole("--threads", threads, 1, 4096));
  }
};

std::vector<std::unique_ptr<Verb>> make_verbs() {
  std::vector<std::unique_ptr<Verb>> verbs;
  verbs.push_back(make_import_verb());
  verbs.push_back(make_info_verb());
  verbs.push_back(make_check_verb());
  verbs.push_back(make_tin_verb());
  verbs.push_back(make_viewshed_verb());
  verbs.push_back(make_visibility_verb());
  verbs.push_back(make_ztv_verb());
  verbs.push_back(make_profile_verb());
  verbs.push_back(make_los_verb());
  verbs.push_back(make_site_verb());
  verbs.push_back(make_premises_verb());
  verbs.push_back(make_dwellings_verb());
  verbs.push_back(make_serve_verb());
  verbs.push_back(make_read_upload_verb());
  return verbs;
}

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

/// Repeats the option, since `--observer 1,2,3 4,5,6` means what `--observer 1,2,3 --observer 4,5,6` does. CLI11 by
/// itself would let an option with any number of values swallow the arguments behind it and stop at a negative number.
std::vector<std::string> repeat_observer(const std::vector<std::string>& arguments) {
  const std::string option = "--observer";
  std::vector<std::string> repeated;
  bool listing = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool value = i > 0 && arguments[i - 1] == option;
    const bool another = !value && listing && may_be_place(arguments[i]);
    if (another) repeated.push_back(option);
    repeated.push_back(arguments[i]);
    listing = value || another;
  }
  return repeated;
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
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

/// Refuses an option in place of a value, and an empty value, which an unset variable of a script gives; it must not
/// silently mean the default.
void require_values(const CLI::App& verb) {
  if (const std::string message = option_as_value(verb); !message.empty()) throw InputError(message);
  for (const CLI::Option* option : verb.get_options()) {
    const std::vector<std::string>& values = option->results();
    if (std::find(values.begin(), values.end(), "") != values.end())
      throw InputError(fmt::format("{}: its value is empty; give one, or leave it out", option->get_name()));
  }
}

void run_verb(Verb& verb, CLI::App& options, const Everywhere& everywhere) {
  const auto start = std::chrono::steady_clock::now();
  verb.complete();
  require_values(options);
  everywhere.apply();
  static_cast<void>(CallFiles(options));  // throws where a file would be lost
  verb.validate();
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

void parse_and_run(const std::vector<std::string>& arguments) {
  const std::vector<std::unique_ptr<Verb>> verbs = make_verbs();
  require_known_verb(arguments, verbs);

  CLI::App app("Intervisibility and viewsheds on a multiscale implicit TIN", "itin");
  app.formatter(std::make_shared<HelpText>());
  app.set_version_flag("--version", "itin " ITIN_VERSION);
  app.require_subcommand(1);
  Everywhere everywhere;
  for (const auto& verb : verbs) {
    CLI::App* subcommand = app.add_subcommand(verb->name(), verb->summary());
    if (verb->is_internal()) subcommand->group(kHidden);
    verb->declare(*subcommand);
    everywhere.declare(*subcommand);
    require_roles(*subcommand);
  }

  std::vector<std::string> reversed = repeat_observer(arguments);
  std::reverse(reversed.begin(), reversed.end());
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    return print(json ? json_text(help_document(app), 2) + "\n" : app.help());
  } catch (const CLI::CallForVersion&) {
    return print(app.version() + "\n");
  } catch (const CLI::ParseError& error) {
    const bool chosen = !app.get_subcommands().empty();
    const std::string wrong = call_error(chosen ? *app.get_subcommands().front() : app, error);
    throw InputError(
        fmt::format("{}; see itin {}--help", wrong, chosen ? app.get_subcommands().front()->get_name() + " " : ""));
  }
  CLI::App& chosen = *app.get_subcommands().front();
  const auto verb =
      std::find_if(verbs.begin(), verbs.end(), [&](const auto& v) { return v->name() == chosen.get_name(); });
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
  } catch (const Cancelled& error) {
    return report(error.what(), kInterrupted);
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
