#include "drawing/plain_text.hpp"

#include <gtest/gtest.h>

namespace itin::viewshed {
namespace {

TEST(PlainText, KeepsAscii) {
  EXPECT_EQ(plain_text("Garth Hill, 2 m ~ {x}"), "Garth Hill, 2 m ~ {x}");
}

TEST(PlainText, TakesAccentsOff) {
  EXPECT_EQ(plain_text("Zürich ©"), "Zurich (c)");
  EXPECT_EQ(plain_text("Łódź, Århus, Plzeň, façade"), "Lodz, Arhus, Plzen, facade");
  EXPECT_EQ(plain_text("5° ± 1 m"), "5 deg +/- 1 m");
}

TEST(PlainText, SaysWhatItCannotDrawAndSurvivesBrokenText) {
  EXPECT_EQ(plain_text("富士山"), "???");
  EXPECT_EQ(plain_text("a\xC3"), "a?");
  EXPECT_EQ(plain_text("\xFF\xFF"), "??");
}

TEST(PlainText, RaisesTheTwoOfSquares) {
  using Pieces = std::vector<PlainPiece>;
  EXPECT_EQ(plain_pieces("5° ± 1"), (Pieces{{"5 deg +/- 1", false}}));
  EXPECT_EQ(plain_pieces("1 m² (5 %)"), (Pieces{{"1 m", false}, {"2", true}, {" (5 %)", false}}));
  EXPECT_EQ(plain_pieces("²"), (Pieces{{"2", true}}));
  EXPECT_EQ(plain_pieces(""), Pieces{});
}

}  // namespace
}  // namespace itin::viewshed
