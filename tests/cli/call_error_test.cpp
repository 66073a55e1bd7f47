#include "program/call_error.hpp"

#include <gtest/gtest.h>

namespace itin::cli {

namespace {

TEST(OutOfMemory, AdvisesOptionsOfTheVerb) {
  CLI::App line, viewshed, import;
  std::string text;
  EXPECT_EQ(out_of_memory(line), "out of memory; free some");
  for (const char* option : {"--memory", "--cell", "--radius", "--target-height"}) viewshed.add_option(option, text);
  EXPECT_EQ(out_of_memory(viewshed),
            "out of memory; free some, or give a smaller --radius or a larger --cell or less --memory");
  for (const char* option : {"STORE", "SOURCE", "--memory"}) import.add_option(option, text);
  EXPECT_EQ(out_of_memory(import), "out of memory; free some, or give less --memory or fewer sources at once");
}

}  // namespace

}  // namespace itin::cli
