// The commands of the README and of the guides that it lists, run as they stand there. A guide that begins with an
// import stands alone and is run by itself. The others go on from one another, in the order of the README's list.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/shell.hpp"

namespace itin::test {

namespace {

const std::filesystem::path kSource = ITIN_SOURCE_DIR;

std::string text_of(const std::filesystem::path& page) {
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  return text.str();
}

/// Returns what the links and pictures of a page lead to, in their order; without the places within pages.
std::vector<std::string> links_of(const std::filesystem::path& page) {
  const std::string text = text_of(page);
  const std::regex link(R"(\]\(([^)#]+)[^)]*\))");
  std::vector<std::string> links;
  for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) links.push_back((*at)[1]);
  return links;
}

/// The README, and then the guides in the order in which it lists them.
std::vector<std::filesystem::path> pages() {
  std::vector<std::filesystem::path> pages{kSource / "README.md"};
  for (const std::string& link : links_of(pages.front())) {
    const std::filesystem::path page = kSource / link;
    const bool listed = std::find(pages.begin(), pages.end(), page) != pages.end();
    if (link.starts_with("docs/") && !listed) pages.push_back(page);
  }
  return pages;
}

/// The lines of all blocks marked `sh`.
std::vector<std::string> commands_of(const std::filesystem::path& page) {
  std::vector<std::string> commands;
  std::istringstream text(text_of(page));
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = line == "```sh";
    } else if (inside) {
      commands.push_back(line);
    }
  }
  return commands;
}

bool stands_alone(const std::filesystem::path& page) {
  const std::vector<std::string> commands = commands_of(page);
  return page.filename() != "README.md" && !commands.empty() && commands.front().starts_with("itin import ");
}

/// Runs the commands of a page, and returns how many they are.
std::size_t run_commands(const std::filesystem::path& page, const Shell& shell) {
  const std::vector<std::string> commands = commands_of(page);
  for (const std::string& command : commands) {
    const Outcome outcome = shell.run(command);
    EXPECT_EQ(outcome.status, 0) << page << ": " << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.find("keep no candidate away"), std::string::npos) << command << "\n" << outcome.err;
  }
  return commands.size();
}

TEST(Readme, CommandsDoWhatTheySay) {
  const Shell shell;
  std::filesystem::create_directory_symlink(kSource / "scripts", shell.directory() / "scripts");
  std::size_t count = 0;
  for (const std::filesystem::path& page : pages())
    if (!stands_alone(page)) count += run_commands(page, shell);
  EXPECT_GT(count, 40u);
  for (const char* made :
       {"cardiff.itin", "garth.glb", "bay.gpkg", "summit.json", "fine.tif", "fine.png", "hills.tif"}) {
    EXPECT_TRUE(std::filesystem::exists(shell.directory() / made)) << made;
  }
}

class PageByItself : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(PageByItself, CommandsDoWhatTheySay) {
  const Shell shell;
  std::filesystem::create_directory_symlink(kSource / "scripts", shell.directory() / "scripts");
  EXPECT_GT(run_commands(GetParam(), shell), 0u);
}

std::vector<std::filesystem::path> pages_by_themselves() {
  std::vector<std::filesystem::path> result = pages();
  std::erase_if(result, [](const auto& page) { return !stands_alone(page); });
  return result;
}

INSTANTIATE_TEST_SUITE_P(Guides, PageByItself, testing::ValuesIn(pages_by_themselves()), [](const auto& page) {
  return std::regex_replace(page.param.stem().string(), std::regex("[^a-z]"), "_");
});

TEST(Readme, ListsAllGuides) {
  const std::vector<std::filesystem::path> listed = pages();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "docs")) {
    if (entry.path().extension() != ".md") continue;
    EXPECT_NE(std::find(listed.begin(), listed.end(), entry.path()), listed.end()) << entry.path();
  }
}

TEST(Readme, LinksLeadToFiles) {
  for (const std::filesystem::path& page : pages()) {
    const std::vector<std::string> links = links_of(page);
    EXPECT_FALSE(links.empty()) << page;
    for (const std::string& link : links)
      EXPECT_TRUE(std::filesystem::exists(page.parent_path() / link)) << page << ": " << link;
  }
}

}  // namespace

}  // namespace itin::test
