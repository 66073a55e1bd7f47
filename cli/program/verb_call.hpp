// The call of a verb: from arguments to a verb that has understood its options.
//
//   VerbCall call({"viewshed", "wales.itin", "--observer", "280000,240000,30", "-o", "out.tif"});
//   Result result = call.verb().execute(progress);
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "program/stderr_progress.hpp"
#include "program/verb.hpp"

namespace itin::cli {

/// The options that every verb has.
struct Everywhere {
  bool json = false;
  bool quiet = false;
  bool network = false;
  bool uploads = false;
  std::string threads, progress;

  void declare(CLI::App& app);
  StderrProgress::Style style() const;
  /// Throws InputError.
  void apply() const;
};

/// All verbs of the program.
std::vector<std::unique_ptr<Verb>> make_verbs();

/// Declares a verb's options and those that every verb has. Returns the verb's part of the program.
CLI::App& declare_verb(CLI::App& program, Verb& verb, Everywhere& everywhere);

/// Parses the arguments of a program whose verbs are declared. Throws InputError for a wrong call, and what CLI11
/// throws where help or the version are asked for.
void parse_arguments(CLI::App& program, const std::vector<std::string>& arguments);

/// Makes a verb understand what was parsed. Throws InputError, FileError.
void complete_call(Verb& verb, CLI::App& options, const Everywhere& everywhere);

/// The call of one verb by itself, as a file may hold it. What it says of threads and progress is passed over.
class VerbCall {
 public:
  /// Parses the arguments, the verb's name first. Throws InputError.
  explicit VerbCall(std::vector<std::string> arguments);

  const std::vector<std::string>& arguments() const { return arguments_; }
  /// The store that the verb is about; empty where it has none.
  std::string store() const;
  /// The files that its options read, besides the store.
  std::vector<std::string> inputs() const;
  /// Understands the options, and returns the verb. To be called once. Throws InputError, FileError.
  Verb& complete();

 private:
  std::vector<std::string> arguments_;
  std::unique_ptr<Verb> verb_;
  Everywhere everywhere_;
  CLI::App program_;
  CLI::App* options_ = nullptr;
};

}  // namespace itin::cli
