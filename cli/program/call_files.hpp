// The files that a call names: the ones it reads and the ones it writes. A file that it writes may not be any of the
// others.
//
// Options state their role where they are declared, and every option of the type FILE, DIR or AREA must do so:
//
//   writes(app.add_option("--image", image_, "A map to write (.png, .jpg)"))->type_name("FILE");
//
// The program compares all of them before a verb does anything. Names that arise later, one for each link or observer,
// are compared by OutputPolicy::claim().
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace itin::cli {

/// Marks an option whose values are read. Values that are no files, such as well-known text, are passed over.
CLI::Option* reads(CLI::Option* option);
/// Marks an option for a file that is written, or a folder that files are written into.
CLI::Option* writes(CLI::Option* option);
/// Marks an option for a folder that another one replaces: nothing that is read may lie in it.
CLI::Option* replaces(CLI::Option* option);

/// Returns what becomes of the files that an option names: "reads", "writes" or "replaces"; empty where it names none.
std::string role_of(const CLI::Option& option);

/// Throws std::logic_error, which names an option that has a type of files, but does not state its role.
void require_roles(CLI::App& verb);

class CallFiles {
 public:
  /// Collects the files of `verb`, whose options must have their values. Throws InputError where a file would be
  /// written that is read as well, by whatever name, or that is written already; and where an output is a symbolic link
  /// to nothing.
  explicit CallFiles(CLI::App& verb);

  /// Adds one more file to write. Throws InputError like the constructor.
  void add_output(const std::string& path);

 private:
  struct Named {
    std::string option;
    std::string path;
    std::string text() const;
  };
  void add(const Named& output);
  void require_none_within(const Named& folder) const;

  std::map<std::string, Named> inputs_, outputs_;  ///< by what identifies the file
};

}  // namespace itin::cli
