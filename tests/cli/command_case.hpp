// Command-line tests as data: cases in plain text, one file per verb, run by command_line_test.cpp.
//
//   # a comment
//   case missing store                  starts a case; each runs in a directory of its own
//   needs store                         there is hill.itin, made from hill.asc, which is always there
//   not sanitized                       a sanitizer's own memory is beyond a limit, or it holds back a signal
//   run itin info none.itin             through sh, with `itin` in the path; several run lines follow one another
//   status 1                            of the last run; 0 where nothing is said
//   stdout REGEX, stderr REGEX          searched for in the last run's output; no-stdout, no-stderr: empty
//   json /vertices number               stdout is JSON, with a number (string, array, object, boolean) at this pointer
//   file out.tif, no-file out.tif       exists afterwards, or not
//
// Every run that ends with status 1, 2 or 130 must write one line to stderr, which begins with "itin: error: ".
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace itin::test {

struct Expectation {
  std::string what;   ///< the first word of its line
  std::string value;  ///< the rest
  int line = 0;
};

struct CommandCase {
  std::string file;
  int line = 0;
  std::string name;
  bool needs_store = false;
  bool not_sanitized = false;
  std::vector<std::string> runs;
  int status = 0;
  std::vector<Expectation> expectations;

  friend void PrintTo(const CommandCase& c, std::ostream* stream) { *stream << c.file << ":" << c.line; }
};

/// Every case of every `.cases` file in a directory, files in alphabetical order. Throws std::runtime_error, naming
/// file and line, for a line that is not understood.
std::vector<CommandCase> read_cases(const std::string& directory);

}  // namespace itin::test
