// The files that a call names: those it reads and those it writes. None that it writes may be another of them.
//
// Options say which they name where they are declared, and every option of the type FILE, DIR or AREA has to:
//
//   writes(app.add_option("--image", image_, "A map to write (.png, .jpg)"))->type_name("FILE");
//
// The program compares all of them before a verb does anything. Names that come about later, one for each link or
// observer, are compared by OutputPolicy::claim().
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace itin::cli {

/// The option's values are read. Values that are no files, such as well-known text, are passed over.
CLI::Option* reads(CLI::Option* option);
/// A file that is written, or a folder that files are written into.
CLI::Option* writes(CLI::Option* option);
/// A folder that another one takes the place of: nothing that is read may lie in it.
CLI::Option* replaces(CLI::Option* option);

/// Throws std::logic_error, naming an option that has the type of one that names files, but does not say what for.
void require_roles(CLI::App& verb);

class CallFiles {
 public:
  /// `verb`: its options must have their values. Throws InputError where a file would be written that is read as well,
  /// by whatever name, or that is written already; and where an output is a symbolic link to nothing.
  explicit CallFiles(CLI::App& verb);

  /// One more file to write. Throws likewise.
  void add_output(const std::string& path);

 private:
  struct Named {
    std::string option;
    std::string path;
    std::string text() const;
  };
  void add(const Named& output);
  void require_none_within(const Named& folder) const;

  std::map<std::string, Named> inputs_, outputs_;  ///< each under what identifies its file
};

}  // namespace itin::cli
