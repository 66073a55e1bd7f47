// A verb of the command line, in three steps: declare options, validate, execute.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/document.hpp>
#include <itin/progress.hpp>

namespace itin::viewshed {
class Tasks;
}

namespace itin::cli {

/// The answer of a verb, for machines and for people; the program prints one of the two on stdout.
struct Result {
  Document document =
      Document::object();  ///< without `itin`, `command` and the process's statistics, which the program adds
  std::string text;        ///< ends with a newline
  std::vector<std::string> warnings;  ///< one line each, for stderr and the document
  std::string failure;  ///< not empty: the result is printed all the same, then this error, and the status is 1
};

class Verb {
 public:
  virtual ~Verb() = default;
  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;
  /// Whether the program alone calls it, so that help and messages leave it out.
  virtual bool is_internal() const { return false; }
  virtual void declare(CLI::App& app) = 0;
  /// Takes options that a file holds, as if they were given. Throws InputError, FileError.
  virtual void complete() {}
  /// Understands every option, touching no file. Throws InputError.
  virtual void validate() = 0;
  /// The parameters as understood, defaults included, without parameters that cannot change the result. To be called
  /// after execute().
  virtual Document parameters() const = 0;
  /// Runs the verb. Throws itin::Error.
  virtual Result execute(Progress& progress) = 0;

  /// Divides the verb's question into tasks of no more than about so many cells, or sites, in place of execute(). The
  /// tasks refer to the verb. Throws InputError for calls that nobody else can work on.
  virtual std::unique_ptr<viewshed::Tasks> divide(std::uint64_t most_cells, Progress& progress);
  /// Whether execute() writes nothing that needs all cells of the answer in memory, where it takes it from tasks.
  virtual bool writes_by_parts() const { return true; }
  /// Makes execute() take its answer from these tasks of divide(), to which all answers have been added.
  virtual void take_answers(viewshed::Tasks& answered);

  /// Whether the arguments end with the call of another verb, which take_call() takes, its name first.
  virtual bool takes_call() const { return false; }
  virtual void take_call(const std::vector<std::string>&) {}
};

/// The head of every document: `itin`, and `command` with the verb and its parameters. To be called after execute().
Document call_document(const Verb& verb);
/// Returns the text of the document that stays in a folder of outputs: the call and the result without times, so that
/// equal runs write equal files. Puts the warnings into the words of options, as the program does, but after this. To
/// be called at the end of execute().
std::string folder_document(const Verb& verb, Result& result);

std::unique_ptr<Verb> make_import_verb();
std::unique_ptr<Verb> make_info_verb();
std::unique_ptr<Verb> make_check_verb();
std::unique_ptr<Verb> make_tin_verb();
std::unique_ptr<Verb> make_viewshed_verb();
std::unique_ptr<Verb> make_visibility_verb();
std::unique_ptr<Verb> make_ztv_verb();
std::unique_ptr<Verb> make_profile_verb();
std::unique_ptr<Verb> make_los_verb();
std::unique_ptr<Verb> make_site_verb();
std::unique_ptr<Verb> make_premises_verb();
std::unique_ptr<Verb> make_dwellings_verb();
std::unique_ptr<Verb> make_job_verb();
std::unique_ptr<Verb> make_serve_verb();
std::unique_ptr<Verb> make_read_upload_verb();

}  // namespace itin::cli
