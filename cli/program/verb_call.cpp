#include "program/verb_call.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/network.hpp>
#include <itin/parallel.hpp>

#include "program/call_error.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

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

}  // namespace

void Everywhere::declare(CLI::App& app) {
  begin_group(app, kRunning);
  app.add_flag("--json", json, "Print the result as one JSON document");
  app.add_flag("--quiet", quiet, "No progress; the result and warnings are still told");
  app.add_option("--progress", progress,
                 "lines: a line of JSON every 200 ms on stderr, with stage, share and seconds_left, for programs that "
                 "run this one")
      ->type_name("lines");
  app.add_option("--threads", threads, "Threads to use; the result never depends on it (default: all cores)")
      ->type_name("N");
  app.add_flag("--allow-network", network,
               "Let sources send the requests that they name; none leaves this machine else");
  app.add_flag("--uploads", uploads, "Files were sent by strangers, to itin serve")->group(kHidden);
}

StderrProgress::Style Everywhere::style() const {
  return progress.empty() ? StderrProgress::style_for(quiet) : StderrProgress::Style::kJson;
}

void Everywhere::apply() const {
  if (network) allow_network();
  if (uploads) read_tables_alone();
  if (!progress.empty()) parse_choice("--progress", progress, {"lines"});
  if (!progress.empty() && quiet) throw InputError("--progress and --quiet exclude each other; give one of them");
  if (!threads.empty()) set_thread_count(parse_whole("--threads", threads, 1, 4096));
}

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
  verbs.push_back(make_job_verb());
  verbs.push_back(make_serve_verb());
  verbs.push_back(make_read_upload_verb());
  return verbs;
}

CLI::App& declare_verb(CLI::App& program, Verb& verb, Everywhere& everywhere) {
  CLI::App* options = program.add_subcommand(verb.name(), verb.summary());
  if (verb.is_internal()) options->group(kHidden);
  verb.declare(*options);
  everywhere.declare(*options);
  require_roles(*options);
  return *options;
}

void parse_arguments(CLI::App& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> reversed = repeat_observer(arguments);
  std::reverse(reversed.begin(), reversed.end());
  try {
    program.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    throw;
  } catch (const CLI::CallForVersion&) {
    throw;
  } catch (const CLI::ParseError& error) {
    const bool chosen = !program.get_subcommands().empty();
    const std::string wrong = call_error(chosen ? *program.get_subcommands().front() : program, error);
    throw InputError(
        fmt::format("{}; see itin {}--help", wrong, chosen ? program.get_subcommands().front()->get_name() + " " : ""));
  }
}

void complete_call(Verb& verb, CLI::App& options, const Everywhere& everywhere) {
  verb.complete();
  require_values(options);
  everywhere.apply();
  static_cast<void>(CallFiles(options));  // throws where a file would be lost
  verb.validate();
}

VerbCall::VerbCall(std::vector<std::string> arguments) : arguments_(std::move(arguments)), program_("", "itin") {
  for (std::unique_ptr<Verb>& verb : make_verbs())
    if (!arguments_.empty() && verb->name() == arguments_.front() && !verb->is_internal()) verb_ = std::move(verb);
  if (!verb_ || verb_->takes_call())
    throw InputError(fmt::format("'{}': is no verb that a job can have", arguments_.empty() ? "" : arguments_.front()));
  options_ = &declare_verb(program_, *verb_, everywhere_);
  try {
    parse_arguments(program_, arguments_);
  } catch (const CLI::Success&) {
    throw InputError(fmt::format("a job cannot ask for help; see itin {} --help", arguments_.front()));
  }
}

std::string VerbCall::store() const {
  const CLI::Option* store = options_->get_option_no_throw("STORE");
  return store == nullptr || store->count() == 0 ? "" : store->results().front();
}

std::vector<std::string> VerbCall::inputs() const {
  std::vector<std::string> inputs;
  for (const CLI::Option* option : options_->get_options())
    if (!option->get_positional() && option->count() > 0 && role_of(*option) == "reads")
      inputs.insert(inputs.end(), option->results().begin(), option->results().end());
  return inputs;
}

Verb& VerbCall::complete() {
  complete_call(*verb_, *options_, {});
  return *verb_;
}

}  // namespace itin::cli
