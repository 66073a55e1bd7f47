#include "cli/shell.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "support/sanitized.hpp"

namespace itin::test {

namespace fs = std::filesystem;

namespace {

std::string contents(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

fs::path fresh_directory() {
  std::string pattern = (fs::temp_directory_path() / "itin-cli-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary directory: " + pattern);
  return pattern;
}

/// Progress is shown once a command has taken seconds, which is the machine's affair.
std::string without_progress(const std::string& text) {
  static const std::regex line("^(?!itin: )[^\\n]* \\d+ %(, [^\\n]* left)?\\n",
                               std::regex::ECMAScript | std::regex::multiline);
  return std::regex_replace(text, line, "");
}

}  // namespace

std::string tested_program() {
  const char* const named = std::getenv("ITIN_PROGRAM");
  return named != nullptr ? named : ITIN_PROGRAM;
}

Shell::Shell(const std::string& program) : directory_(fresh_directory()), beside_(fresh_directory()) {
  fs::create_directory(beside_ / "bin");
  fs::create_symlink(program, beside_ / "bin" / "itin");
}

Shell::~Shell() {
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
  fs::remove_all(beside_, ignored);
}

Outcome Shell::run(const std::string& command) const {
  const fs::path script = beside_ / "command";
  std::ofstream(script) << command << "\n";
  const std::string line =
      fmt::format("cd '{}' && DEMO='{}' PATH='{}':\"$PATH\" timeout {} sh '{}' >'{}' 2>'{}' </dev/null",
                  directory_.string(), ITIN_SOURCE_DIR "/scripts/demo-data", (beside_ / "bin").string(),
                  kSanitized ? 1800 : 120, script.string(), (beside_ / "out").string(), (beside_ / "err").string());
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(beside_ / "out"),
          without_progress(contents(beside_ / "err"))};
}

std::string Shell::read(const std::string& file) const {
  return contents(directory_ / file);
}

void write_hill(const fs::path& path) {
  constexpr int kPosts = 41;
  std::ofstream grid(path);
  grid << "ncols 41\nnrows 41\nxllcorner 300000\nyllcorner 170000\ncellsize 50\nNODATA_value -9999\n";
  for (int row = 0; row < kPosts; ++row) {
    for (int column = 0; column < kPosts; ++column) {
      const double distance = std::hypot(row - kPosts / 2, column - kPosts / 2);
      const bool is_void = row == 0 && column < 2;
      grid << (is_void ? -9999.0 : std::round(10 * std::max(20.0, 200 - 9 * distance)) / 10) << ' ';
    }
    grid << '\n';
  }
  std::ofstream(fs::path(path).replace_extension(".prj"))
      << R"(PROJCS["OSGB36 / British National Grid",GEOGCS["OSGB36",DATUM["Ordnance_Survey_of_Great_Britain_1936",)"
      << R"(SPHEROID["Airy 1830",6377563.396,299.3249646,AUTHORITY["EPSG","7001"]],AUTHORITY["EPSG","6277"]],)"
      << R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4277"]],)"
      << R"(PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",49],PARAMETER["central_meridian",-2],)"
      << R"(PARAMETER["scale_factor",0.9996012717],PARAMETER["false_easting",400000],)"
      << R"(PARAMETER["false_northing",-100000],UNIT["metre",1],AUTHORITY["EPSG","27700"]])" << '\n';
}

}  // namespace itin::test
