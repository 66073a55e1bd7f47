// Runs the cases of tests/cli/cases; their form is described in command_case.hpp.
#include <memory>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/command_case.hpp"
#include "cli/shell.hpp"
#include "support/sanitized.hpp"

namespace itin::test {

namespace {

class CommandLine : public ::testing::TestWithParam<CommandCase> {
 protected:
  static void SetUpTestSuite() {
    hill = std::make_unique<Shell>();
    write_hill(hill->directory() / "hill.asc");
    const Outcome made = hill->run("itin import --quiet hill.itin hill.asc");
    ASSERT_EQ(made.status, 0) << made.err;
  }
  static void TearDownTestSuite() { hill.reset(); }

  static void copy_from_hill(const char* file, const Shell& shell) {
    std::filesystem::copy_file(hill->directory() / file, shell.directory() / file);
  }

 private:
  static std::unique_ptr<Shell> hill;  ///< hill.asc with its store, made once for all cases
};

std::unique_ptr<Shell> CommandLine::hill;

bool found(const std::string& pattern, const std::string& text) {
  return std::regex_search(text, std::regex(pattern, std::regex::ECMAScript | std::regex::multiline));
}

/// `value` is a JSON pointer and, after a space, a type.
std::string json_complaint(const std::string& value, const std::string& text) {
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (document.is_discarded()) return "stdout is not JSON";
  const std::size_t space = value.find(' ');
  const nlohmann::json::json_pointer pointer(value.substr(0, space));
  if (!document.contains(pointer)) return "nothing at " + value;
  const std::string type = document.at(pointer).type_name();
  if (space != std::string::npos && type != value.substr(space + 1)) return value + ": is " + type;
  return "";
}

std::string complaint(const Expectation& expected, const Outcome& outcome, const Shell& shell) {
  const std::string& value = expected.value;
  if (expected.what == "stdout") return found(value, outcome.out) ? "" : "stdout lacks " + value;
  if (expected.what == "stderr") return found(value, outcome.err) ? "" : "stderr lacks " + value;
  if (expected.what == "no-stdout") return outcome.out.empty() ? "" : "stdout is not empty";
  if (expected.what == "no-stderr") return outcome.err.empty() ? "" : "stderr is not empty";
  if (expected.what == "json") return json_complaint(value, outcome.out);
  const bool exists = std::filesystem::exists(shell.directory() / value);
  if (expected.what == "file") return exists ? "" : value + " does not exist";
  return exists ? value + " exists" : "";
}

TEST_P(CommandLine, Case) {
  const CommandCase& test = GetParam();
  if (kSanitized && test.not_sanitized) GTEST_SKIP() << "a sanitizer takes no limit and holds signals back";
  SCOPED_TRACE(test.file + ":" + std::to_string(test.line) + ": " + test.name);
  const Shell shell;
  for (const char* file : {"hill.asc", "hill.prj"}) copy_from_hill(file, shell);
  if (test.needs_store) copy_from_hill("hill.itin", shell);

  Outcome outcome;
  for (const std::string& command : test.runs) outcome = shell.run(command);
  const std::string seen = "\nstdout: " + outcome.out.substr(0, 2000) + "\nstderr: " + outcome.err.substr(0, 2000);
  EXPECT_EQ(outcome.status, test.status) << seen;
  if (test.status != 0) {
    EXPECT_TRUE(std::regex_match(outcome.err, std::regex("itin: error: [^\n]*\n"))) << seen;
  }
  for (const Expectation& expected : test.expectations) {
    const std::string wrong = complaint(expected, outcome, shell);
    EXPECT_EQ(wrong, "") << test.file << ":" << expected.line << seen;
  }
}

std::string test_name(const ::testing::TestParamInfo<CommandCase>& info) {
  std::string name = info.param.file.substr(0, info.param.file.find('.')) + "_" + info.param.name;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Cases, CommandLine, ::testing::ValuesIn(read_cases(ITIN_SOURCE_DIR "/tests/cli/cases")),
                         test_name);

}  // namespace

}  // namespace itin::test
