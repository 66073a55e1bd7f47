// Texts broken into lines, against what holds of every such text.
// By its place: viewsheds have a header of this name as well.
#include "../../profile/src/drawing/drawing.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace itin::profile {
namespace {

constexpr Lettering kPlain{.size = 8, .colour = {}};

/// The text without what parted the lines.
std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

TEST(Drawing, BreaksWordsThatAreLongerThanALine) {
  const Drawing drawing(Drawing::Format::kSvg, 100, 100);
  for (const double width : {30.0, 60.0, 100.0}) {
    const std::string word = "Llanfairpwllgwyngyllgogerychwyrndrobwllllantysiliogogogoch\xC3\xA9\xC3\xA9\xC3\xA9";
    const std::vector<std::string> lines = drawing.lines("at " + word, width, kPlain);
    ASSERT_GT(lines.size(), 2U);
    for (const std::string& line : lines) {
      EXPECT_LE(drawing.text_width(line, kPlain), width) << line;
      EXPECT_NE(static_cast<unsigned char>(line.front()) & 0xC0, 0x80) << "a character is cut in two";
    }
    EXPECT_EQ(joined(lines), "at" + word);
  }
}

TEST(Drawing, BreaksAtBlanksWhereWordsFit) {
  const Drawing drawing(Drawing::Format::kSvg, 100, 100);
  EXPECT_EQ(drawing.lines("hub  and tip", 1000, kPlain), (std::vector<std::string>{"hub and tip"}));
  EXPECT_EQ(drawing.lines("hub and tip", drawing.text_width("hub and", kPlain), kPlain),
            (std::vector<std::string>{"hub and", "tip"}));
  EXPECT_EQ(drawing.lines("", 10, kPlain), (std::vector<std::string>{""}));
}

/// Less than one character is never drawn.
TEST(Drawing, KeepsACharacterInEveryLine) {
  const Drawing drawing(Drawing::Format::kSvg, 100, 100);
  EXPECT_EQ(drawing.lines("abc", 0.1, kPlain), (std::vector<std::string>{"a", "b", "c"}));
}

/// Returns a picture with letters in all sizes of maps and charts.
std::string lettered(Drawing::Format format) {
  Drawing drawing(format, 400, 300);
  double y = 0;
  for (double size = 5; size < 20; size += 0.5)
    drawing.text({5, y += 9}, "Caerphilly ST 08 91 (m\u00b2)", {.size = size, .bold = y > 150});
  return drawing.finish();
}

TEST(Drawing, HasTheSameBytesWhateverWasDrawnBefore) {
  const std::string first = lettered(Drawing::Format::kPng);
  for (const auto format : {Drawing::Format::kSvg, Drawing::Format::kPdf, Drawing::Format::kPixels}) lettered(format);
  EXPECT_TRUE(lettered(Drawing::Format::kPng) == first);
}

}  // namespace
}  // namespace itin::profile
