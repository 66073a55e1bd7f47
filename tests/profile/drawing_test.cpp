// Texts broken into lines, against what holds of every such text; areas, and equal bytes of equal pictures.
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
  EXPECT_EQ(drawing.lines("eyes 2 m (25.5 %) up", drawing.text_width("eyes 2 m (25.5", kPlain), kPlain),
            (std::vector<std::string>{"eyes 2 m", "(25.5 %) up"}));
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

/// Whatever way the rings run.
TEST(Drawing, LeavesHolesOfAreasOpen) {
  const std::vector<Point2> shell{{10, 10}, {90, 10}, {90, 90}, {10, 90}, {10, 10}};
  const std::vector<Point2> hole{{40, 40}, {60, 40}, {60, 60}, {40, 60}, {40, 40}};
  for (const auto& inner : {hole, std::vector<Point2>(hole.rbegin(), hole.rend())}) {
    Drawing drawing(Drawing::Format::kPixels, 100, 100, 1);
    drawing.area(std::vector{shell, inner}, {0, 0, 0});
    const std::string pixels = drawing.finish();
    const auto is_black = [&](std::size_t x, std::size_t y) { return pixels[3 * (100 * y + x)] == '\0'; };
    EXPECT_TRUE(is_black(25, 50));
    EXPECT_FALSE(is_black(50, 50));
    EXPECT_FALSE(is_black(5, 50));
  }
}

TEST(Drawing, HasTheSameBytesWhateverWasDrawnBefore) {
  const std::string first = lettered(Drawing::Format::kPng);
  for (const auto format : {Drawing::Format::kSvg, Drawing::Format::kPdf, Drawing::Format::kPixels}) lettered(format);
  EXPECT_TRUE(lettered(Drawing::Format::kPng) == first);
}

}  // namespace
}  // namespace itin::profile
