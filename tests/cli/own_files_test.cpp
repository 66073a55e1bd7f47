// Whatever two options of a verb name the same file: it is never written over. Goes by what --help shows, so that it
// knows of every option there is.
#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cli/shell.hpp"

namespace itin::test {

namespace {

/// Options that name what a call reads. Another one that names files is taken to be an output: add a new one here.
const std::set<std::string> kInputs = {
    "STORE",          "SOURCE",          "--profile-csv", "--links",      "--observers",   "--horizon-targets",
    "--path",         "--route",         "--params",      "--candidates", "--search-area", "--demand",
    "--existing",     "--radius-preset", "--like",        "--turbines",   "--viewpoints",  "--forbidden",
    "--polygon",      "--sea-area",      "--basemap",     "--dwellings",  "--masts",       "--months",
    "--from-antenna", "--to-antenna",    "--height-from", "--store"};

struct FileOption {
  std::string name;
  bool repeated = false;
};

/// Entries of the help: lines that begin two columns in, with those that go on.
std::vector<std::string> entries(const std::string& help) {
  std::vector<std::string> found;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    const bool begins = line.size() > 2 && line.starts_with("  ") && line[2] != ' ';
    if (begins)
      found.push_back(line.substr(2));
    else if (!found.empty())
      found.back() += " " + line;
  }
  return found;
}

std::vector<FileOption> file_options(const std::string& help) {
  static const std::regex kOption(R"(^(?:-\w,)?(--[a-z-]+) \S*(FILE|DIR|AREA))"), kPlace(R"(^(STORE|SOURCE)\b)");
  std::vector<FileOption> options;
  for (const std::string& entry : entries(help)) {
    std::smatch match;
    if (std::regex_search(entry, match, kOption) || std::regex_search(entry, match, kPlace))
      options.push_back({match[1], std::regex_search(entry, std::regex("may be\\s+given\\s+again"))});
  }
  return options;
}

/// Further options that a verb requires.
std::string required(const std::string& verb) {
  return verb == "visibility" ? " --cell 10 --radius 100" : "";
}
std::map<std::string, std::string> required_files(const std::string& verb) {
  if (verb == "import") return {{"STORE", "fresh.itin"}, {"SOURCE", "hill.asc"}};
  std::map<std::string, std::string> files{{"STORE", "hill.asc"}};
  if (verb == "ztv" || verb == "site" || verb == "visibility" || verb == "premises" || verb == "dwellings")
    files["--output"] = "fresh";
  if (verb == "ztv" || verb == "dwellings") files["--turbines"] = "hill.prj";
  if (verb == "premises") files["--masts"] = "hill.prj";
  return files;
}

bool is_input(const std::string& verb, const std::string& option) {
  return kInputs.contains(option) && !(verb == "import" && option == "STORE");
}

class OwnFiles : public ::testing::TestWithParam<std::string> {
 protected:
  void require_kept(const FileOption& a, const FileOption& b, const std::string& second_name) {
    const std::string& verb = GetParam();
    auto files = required_files(verb);
    std::string call = "itin " + verb + required(verb) + " --overwrite";
    if (verb == "import") call = "itin import";
    files.erase(a.name), files.erase(b.name);
    const auto add = [&](const std::string& option, const std::string& name) {
      call += (option.starts_with('-') ? " " + option : std::string()) + " " + name;
    };
    // Places are told by their order.
    std::vector<std::pair<std::string, std::string>> named{{a.name, "given"}, {b.name, second_name}};
    named.insert(named.end(), files.begin(), files.end());
    std::stable_sort(named.begin(), named.end(), [](const auto& x, const auto& y) {
      return (x.first == "STORE" ? 0 : 1) < (y.first == "STORE" ? 0 : 1);
    });
    for (const auto& [option, name] : named) add(option, name);
    const Outcome outcome = shell_.run(call);
    SCOPED_TRACE(call + "\n" + outcome.err);
    EXPECT_EQ(shell_.read("given"), "{}\n");
    if (is_input(verb, a.name) && is_input(verb, b.name)) return;
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(std::regex_search(outcome.err, std::regex("the same file|are one file")));
    EXPECT_TRUE(outcome.out.empty());
  }

  Shell shell_;
};

TEST_P(OwnFiles, AreNeverWrittenOver) {
  write_hill(shell_.directory() / "hill.asc");
  shell_.run("echo '{}' > given; ln given hard; ln -s given soft; mkdir -p sub");
  const std::vector<FileOption> options = file_options(shell_.run("itin " + GetParam() + " --help").out);
  ASSERT_FALSE(options.empty());
  for (std::size_t i = 0; i < options.size(); ++i) {
    for (std::size_t k = i; k < options.size(); ++k) {
      if (i == k && !options[i].repeated) continue;
      for (const char* name : {"given", "sub/../given", "hard", "soft"}) require_kept(options[i], options[k], name);
    }
  }
}

std::vector<std::string> verbs() {
  return {"import",  "info", "check", "tin",      "viewshed",  "visibility", "ztv",
          "profile", "los",  "site",  "premises", "dwellings", "job",        "serve"};
}

INSTANTIATE_TEST_SUITE_P(Verbs, OwnFiles, ::testing::ValuesIn(verbs()), [](const auto& verb) { return verb.param; });

TEST(OwnFiles, KnowAllVerbs) {
  const std::string help = Shell().run("itin --help").out;
  const std::string list = help.substr(help.find("Subcommands:"));
  EXPECT_EQ(entries(list).size(), verbs().size()) << list;
}

}  // namespace

}  // namespace itin::test
