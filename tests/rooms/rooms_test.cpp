// The folders of each library are rooms in an order, written down in its ROOMS.md from the ground up. A source may
// include what is in its own room and in the rooms above it in that table, and nothing else: so there is no cycle.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace itin::test {

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ITIN_SOURCE_DIR;

/// The rooms of a library by their place in its table: rows "| `room/` | what it holds |".
std::map<std::string, int> order_of_rooms(const fs::path& sources) {
  std::map<std::string, int> order;
  std::ifstream table(sources / "ROOMS.md");
  const std::regex row("\\| `([a-z_/]*)/` \\|.*");
  std::smatch match;
  for (std::string line; std::getline(table, line);)
    if (std::regex_match(line, match, row)) order.emplace(match[1], static_cast<int>(order.size()));
  return order;
}

bool is_source(const fs::path& path) {
  return path.extension() == ".cpp" || path.extension() == ".hpp";
}

/// The names that a file includes in these quotes.
std::vector<std::string> includes(const fs::path& file, const std::string& pattern) {
  std::vector<std::string> result;
  std::ifstream stream(file);
  const std::regex line_pattern("#include " + pattern);
  std::smatch match;
  for (std::string line; std::getline(stream, line);)
    if (std::regex_match(line, match, line_pattern)) result.push_back(match[1]);
  return result;
}

std::vector<fs::path> sources_below(const fs::path& folder) {
  std::vector<fs::path> result;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (is_source(entry.path())) result.push_back(entry.path());
  return result;
}

/// Calls visit(file, line) for every line of the sources below these folders.
template <class Visit>
void for_each_line(std::initializer_list<const char*> folders, const Visit& visit) {
  for (const char* folder : folders) {
    for (const fs::path& file : sources_below(kRoot / folder)) {
      std::ifstream stream(file);
      for (std::string line; std::getline(stream, line);) visit(file, line);
    }
  }
}

std::string room_of(const fs::path& sources, const fs::path& file) {
  return fs::relative(file, sources).parent_path().generic_string();
}

class Rooms : public testing::TestWithParam<const char*> {};

TEST_P(Rooms, EveryFolderIsInTheTable) {
  const fs::path sources = kRoot / GetParam();
  const std::map<std::string, int> order = order_of_rooms(sources);
  ASSERT_FALSE(order.empty());
  for (const fs::path& file : sources_below(sources)) EXPECT_EQ(order.count(room_of(sources, file)), 1u) << file;
  for (const auto& [room, place] : order) EXPECT_TRUE(fs::is_directory(sources / room)) << room;
}

TEST_P(Rooms, HoldAtMostThirtyFiles) {
  constexpr std::size_t kMost = 30;
  const fs::path sources = kRoot / GetParam();
  std::map<std::string, std::size_t> files;
  for (const fs::path& file : sources_below(sources)) ++files[room_of(sources, file)];
  for (const auto& [room, count] : files) EXPECT_LE(count, kMost) << room;
}

TEST_P(Rooms, IncludeOnlyWhatStandsAboveThemInTheTable) {
  const fs::path sources = kRoot / GetParam();
  const std::map<std::string, int> order = order_of_rooms(sources);
  for (const fs::path& file : sources_below(sources)) {
    const auto own = order.find(room_of(sources, file));
    if (own == order.end()) continue;
    for (const std::string& included : includes(file, "\"(.*)\".*")) {
      ASSERT_TRUE(fs::exists(sources / included)) << file << " includes " << included << ", not named from " << sources;
      const auto other = order.find(fs::path(included).parent_path().generic_string());
      ASSERT_NE(other, order.end()) << file << " includes " << included;
      EXPECT_LE(other->second, own->second) << file << " includes " << included;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Libraries, Rooms, testing::Values("libitin/src", "viewshed/src", "profile/src", "cli"));

/// cli -> viewshed -> profile -> libitin.
TEST(Libraries, IncludeOnlyThoseBelowThem) {
  const std::map<std::string, std::vector<std::string>> forbidden = {{"libitin", {"viewshed/", "profile/"}},
                                                                     {"profile", {"viewshed/"}}};
  for (const auto& [library, above] : forbidden) {
    for (const fs::path& file : sources_below(kRoot / library)) {
      for (const std::string& included : includes(file, "<(.*)>.*")) {
        for (const std::string& other : above) EXPECT_FALSE(included.starts_with(other)) << file << " " << included;
      }
    }
  }
}

/// A message of a library names a field of the request, `to_crs`; cli/program/field_names.cpp makes it an option.
TEST(Libraries, NameNoOptionOfTheCommandLine) {
  const std::regex option("\"[^\"]*--[a-z][^\"]*\"");
  for_each_line({"libitin", "viewshed", "profile"}, [&](const fs::path& file, const std::string& line) {
    const std::string code = line.substr(0, line.find("//"));
    EXPECT_FALSE(std::regex_search(code, option)) << file << ": " << line;
  });
}

/// GDAL's drivers may be registered beside other work. Two threads that register them at once destroy GDAL's tables,
/// and what opens a file by itself may find them not registered.
TEST(Libraries, RegisterDriversOfGdalInOnePlace) {
  const std::regex registration(
      "GDALAllRegister|OGRRegisterAll|GDALRegister_|RegisterOGR|GDALDataset::Open|GDALOpen(Ex|Shared)?\\(|"
      "GDALIdentifyDriver");
  const fs::path place = kRoot / "libitin/src/gdal/files/drivers.cpp";
  int calls = 0;
  for_each_line({"libitin", "viewshed", "profile", "cli"}, [&](const fs::path& file, const std::string& line) {
    if (!std::regex_search(line, registration)) return;
    EXPECT_EQ(file, place) << line;
    ++calls;
  });
  EXPECT_EQ(calls, 8);
}

/// What a source declares in an unnamed namespace: functions, classes and constants.
std::vector<std::string> names_of_its_own(const fs::path& source) {
  const std::regex declaration(
      "(?:class|struct|enum class) (\\w+) .*"                                     // a class
      "|(?:inline )?constexpr [^(]*?\\b(k[A-Z]\\w*)\\b.*"                         // a constant
      "|(?!template|using|static_assert|return)[A-Za-z][^(=]*[ &*](\\w+)\\(.*");  // a function
  std::vector<std::string> names;
  std::ifstream stream(source);
  bool within = false;
  std::smatch match;
  for (std::string line; std::getline(stream, line);) {
    if (line == "namespace {") within = true;
    if (line == "}  // namespace") within = false;
    if (within && std::regex_match(line, match, declaration)) {
      for (std::size_t i = 1; i < match.size(); ++i)
        if (match[i].matched) names.push_back(match[i]);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Sources are compiled together (itin_compile_together() in CMakeLists.txt): two functions of one name would be
/// overloads there, of which the compiler chooses without a word.
TEST(Names, AreGivenOnceAmongSourcesThatAreCompiledTogether) {
  std::map<fs::path, std::map<std::string, std::vector<fs::path>>> declared;
  std::size_t count = 0;
  for (const char* folder : {"libitin/src", "viewshed/src", "profile/src", "cli"}) {
    for (const fs::path& file : sources_below(kRoot / folder)) {
      fs::path together = kRoot / folder;
      if (std::string(folder) == "libitin/src") together /= *fs::relative(file, together).begin();
      for (const std::string& name : names_of_its_own(file)) declared[together][name].push_back(file), ++count;
    }
  }
  EXPECT_GT(count, 1500u);
  for (const auto& [together, names] : declared)
    for (const auto& [name, files] : names)
      EXPECT_EQ(files.size(), 1u) << name << " of " << files.front() << " is of " << files.back() << ", too";
}

/// The types that a header defines, but not within other types, with their namespaces.
std::vector<std::string> types_of(const fs::path& header) {
  const std::regex opens("namespace ([\\w:]+) \\{"), closes("\\}  // namespace.*"),
      defines("(?:struct|class|enum class|enum) (?:alignas\\(\\d+\\) )?(\\w+)\\b.*\\{.*");
  std::vector<std::string> types, spaces;
  std::smatch match;
  std::ifstream stream(header);
  for (std::string line; std::getline(stream, line);) {
    if (std::regex_match(line, match, opens)) spaces.push_back(match[1]);
    if (std::regex_match(line, closes) && !spaces.empty()) spaces.pop_back();
    if (!std::regex_match(line, match, defines)) continue;
    std::string name;
    for (const std::string& space : spaces) name += space + "::";
    types.push_back(name + match[1].str());
  }
  return types;
}

/// Two types of one name in one namespace are one type to the linker, whatever they hold.
TEST(Names, OfTypesInHeadersAreGivenOnce) {
  std::map<std::string, std::set<fs::path>> headers;
  for (const char* folder : {"libitin", "viewshed", "profile", "cli"})
    for (const fs::path& file : sources_below(kRoot / folder))
      if (file.extension() == ".hpp")
        for (const std::string& type : types_of(file)) headers[type].insert(file);
  EXPECT_GT(headers.size(), 500u);
  for (const auto& [type, files] : headers)
    EXPECT_EQ(files.size(), 1u) << type << " is in " << *files.begin() << " and in " << *files.rbegin();
}

/// A comment is a sentence: its subject is not to be looked for in the line before.
TEST(Comments, BeginWithTheirSubject) {
  const std::regex opening(
      "\\s*//[/!]? *(Of|The same|So many|So few|Likewise|That of|Those|As above|Each \\w+'s\\.)(?!\\w).*");
  for (const char* folder : {"libitin", "viewshed", "profile", "cli"}) {
    for (const fs::path& file : sources_below(kRoot / folder)) {
      std::ifstream stream(file);
      std::string before;
      for (std::string line; std::getline(stream, line); before = line) {
        const bool begins = before.find("//") == std::string::npos;
        EXPECT_FALSE(begins && std::regex_match(line, opening)) << file << ": " << line;
      }
    }
  }
}

/// So is each sentence of a page.
TEST(Pages, HaveSentencesThatBeginWithTheirSubject) {
  const std::regex opening("(.*[.:|] )?(Of|The same|So many|So few|Likewise|That of|Those|As above) .*");
  std::vector<fs::path> pages{"README.md", "CHANGELOG.md", "CONTRIBUTING.md", "libitin/FORMAT.md",
                              "benchmarks/README.md"};
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  EXPECT_GT(pages.size(), 12u);
  for (const fs::path& page : pages) {
    std::ifstream stream(kRoot / page);
    ASSERT_TRUE(stream) << page;
    for (std::string line; std::getline(stream, line);)
      EXPECT_FALSE(std::regex_match(line, opening)) << page << ": " << line;
  }
}

/// A page that leads through the code names files and folders that are there.
TEST(Pages, NameFilesThatAreThere) {
  const std::regex named("`((?:libitin|viewshed|profile|cli|tests|benchmarks|scripts|docs|examples)/[\\w./-]+)`");
  int count = 0;
  for (const char* page : {"CONTRIBUTING.md", "docs/code.md"}) {
    std::ifstream stream(kRoot / page);
    ASSERT_TRUE(stream) << page;
    for (std::string line; std::getline(stream, line);) {
      for (std::sregex_iterator name(line.begin(), line.end(), named), end; name != end; ++name, ++count)
        EXPECT_TRUE(fs::exists(kRoot / (*name)[1].str())) << page << ": " << (*name)[1];
    }
  }
  EXPECT_GT(count, 40);
}

/// A comment behind code, or behind a line of a header's example, says what a thing is: `///< the side of a cell`. One
/// that begins with "of" has to be completed from the name.
TEST(Comments, BehindCodeSayWhatTheyDescribe) {
  const std::regex fragment("(\\s*[^\\s/]|//   ).*(//[/!]?<?|/\\*) *of\\b.*");
  for_each_line({"libitin", "viewshed", "profile", "cli", "tests", "benchmarks", "examples"},
                [&](const fs::path& file, const std::string& line) {
                  EXPECT_FALSE(std::regex_match(line, fragment)) << file << ": " << line;
                });
}

}  // namespace

}  // namespace itin::test
