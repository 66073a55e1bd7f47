// Runs shell commands in a directory of their own, with the program under test in the path as `itin`
// and the bundled terrain's folder as $DEMO.
#pragma once

#include <filesystem>
#include <string>

namespace itin::test {

struct Outcome {
  int status = 0;
  std::string out;
  std::string err;  ///< without lines of progress
};

std::string tested_program();

class Shell {
 public:
  /// `program` is what `itin` runs: that of this build, unless the environment names another one in ITIN_PROGRAM.
  explicit Shell(const std::string& program = tested_program());
  ~Shell();
  Shell(const Shell&) = delete;
  Shell& operator=(const Shell&) = delete;

  const std::filesystem::path& directory() const { return directory_; }
  /// Ends the command after two minutes, half an hour under a sanitizer, with status 124.
  Outcome run(const std::string& command) const;
  std::string read(const std::string& file) const;

 private:
  std::filesystem::path directory_;
  std::filesystem::path beside_;  ///< files that the tests need and the command must not see
};

/// A conical hill of 41 x 41 posts, 50 m apart, as ESRI ASCII grid; x 300000-302050, y 170000-172050, EPSG:27700 by a
/// .prj beside it. The two posts in the north-west corner have no data.
void write_hill(const std::filesystem::path& path);

}  // namespace itin::test
