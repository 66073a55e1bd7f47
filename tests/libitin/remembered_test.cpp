#include "base/remembered.hpp"

#include <string>

#include <gtest/gtest.h>

#include <itin/parallel.hpp>

namespace itin {
namespace {

TEST(Remembered, AsksOnce) {
  Remembered<int> lengths;
  int asked = 0;
  const auto length = [&](const std::string& text) {
    return lengths.of(text, [&] { return ++asked, static_cast<int>(text.size()); });
  };
  EXPECT_EQ(length("one"), 3);
  EXPECT_EQ(length("three"), 5);
  EXPECT_EQ(length("one"), 3);
  EXPECT_EQ(asked, 2);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(length(std::to_string(i)), i < 10 ? 1 : i < 100 ? 2 : 3);
  EXPECT_EQ(length("one"), 3) << "forgotten, and found again";
}

TEST(Remembered, TellsManyThreadsTheSame) {
  Remembered<std::string> texts;
  parallel_for(2000, [&](std::size_t i) {
    const std::string question = std::to_string(i % 300);
    EXPECT_EQ(texts.of(question, [&] { return question + "!"; }), question + "!");
  });
}

}  // namespace
}  // namespace itin
