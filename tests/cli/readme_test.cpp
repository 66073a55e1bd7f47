// The commands of the README, run as they stand there and in their order.
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/shell.hpp"

namespace itin::test {

namespace {

/// The lines of all blocks marked `sh`.
std::vector<std::string> readme_commands() {
  std::vector<std::string> commands;
  std::ifstream readme(ITIN_SOURCE_DIR "/README.md");
  bool inside = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("```")) {
      inside = line == "```sh";
    } else if (inside) {
      commands.push_back(line);
    }
  }
  return commands;
}

TEST(Readme, CommandsDoWhatTheySay) {
  const Shell shell;
  std::filesystem::create_directory_symlink(ITIN_SOURCE_DIR "/scripts", shell.directory() / "scripts");
  const std::vector<std::string> commands = readme_commands();
  EXPECT_GT(commands.size(), 6u);
  for (const std::string& command : commands) {
    const Outcome outcome = shell.run(command);
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.find("keep no candidate away"), std::string::npos) << command << "\n" << outcome.err;
  }
  for (const char* made :
       {"cardiff.itin", "garth.glb", "bay.gpkg", "summit.json", "fine.tif", "fine.png", "hills.tif"}) {
    EXPECT_TRUE(std::filesystem::exists(shell.directory() / made)) << made;
  }
}

TEST(Readme, PictureIsThere) {
  std::ifstream readme(ITIN_SOURCE_DIR "/README.md");
  std::string line;
  while (std::getline(readme, line) && !line.starts_with("![")) {
  }
  const std::size_t begin = line.find('(') + 1;
  EXPECT_TRUE(std::filesystem::exists(ITIN_SOURCE_DIR "/" + line.substr(begin, line.find(')') - begin))) << line;
}

}  // namespace

}  // namespace itin::test
