// The walk from triangle to triangle, against the search among all that may lie under the line.
#include "modes/lines/surface_pieces.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

using Pieces = std::vector<SurfacePieces::Piece>;

/// Without pieces of length 0, and each but once.
Pieces essential(const Pieces& pieces) {
  Pieces result;
  for (const auto& piece : pieces) {
    const double last = result.empty() ? 0 : result.back().to.distance_m;
    if (piece.to.distance_m > last) result.push_back(piece);
  }
  return result;
}

void expect_same(const Pieces& a, const Pieces& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].from.distance_m, b[i].from.distance_m);
    ASSERT_EQ(a[i].from.height_m, b[i].from.height_m);
    ASSERT_EQ(a[i].to.distance_m, b[i].to.distance_m);
    ASSERT_EQ(a[i].to.height_m, b[i].to.height_m);
  }
}

class SurfacePiecesOfLines : public testing::Test {
 protected:
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int draw_int(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  /// Returns whether the walk came to the line's end.
  static bool compare(const SurfacePieces& surface, Point2 a, Point2 b) {
    const SectionLine line(surface.grid(), a, b);
    Pieces walked, searched, along;
    const bool whole = surface.walk(line, walked);
    surface.search(line, searched);
    surface.along(line, along);
    if (whole) expect_same(essential(walked), essential(searched));
    expect_same(essential(along), essential(searched));
    return whole;
  }

  std::mt19937 random_{test::seed()};
};

TEST_F(SurfacePiecesOfLines, AreThoseThatASearchFinds) {
  const Tin tin = test::fractal_tin(65, 25, 80, 0.55, static_cast<unsigned>(random_()));
  const SurfacePieces surface(std::make_shared<const HeightPyramid>(tin));
  const Box box = tin.bounds();
  const auto place = [&] { return Point2{draw(box.xmin, box.xmax), draw(box.ymin, box.ymax)}; };
  for (int i = 0; i < 2000; ++i) EXPECT_TRUE(compare(surface, place(), place()));
}

/// From post to post, and from the middle of an edge: lines pass over vertices and along edges, also of the outline.
TEST_F(SurfacePiecesOfLines, AreSoOverVerticesAndAlongEdges) {
  const Tin tin = test::fractal_tin(17, 25, 80, 0.55, static_cast<unsigned>(random_()));
  const SurfacePieces surface(std::make_shared<const HeightPyramid>(tin));
  int whole = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto post = [&] { return 12.5 * draw_int(0, 32); };
    const Point2 a{test::kCorner.x + post(), test::kCorner.y + post()};
    const Point2 b{test::kCorner.x + post(), test::kCorner.y + post()};
    if (a == b) continue;
    whole += compare(surface, a, b) ? 1 : 0;
  }
  EXPECT_GT(whole, 3000);
}

TEST_F(SurfacePiecesOfLines, AreFoundBeyondMissingGround) {
  Tin tin = test::fractal_tin(33, 25, 80, 0.55, static_cast<unsigned>(random_()));
  std::erase_if(tin.triangles, [&](const Triangle& t) {
    const Point3 p = tin.point(t[0]);
    return std::abs(p.x - test::kCorner.x - 400) < 120 && std::abs(p.y - test::kCorner.y - 350) < 90;
  });
  const SurfacePieces surface(std::make_shared<const HeightPyramid>(tin));
  int whole = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto place = [&] { return Point2{test::kCorner.x + draw(-50, 850), test::kCorner.y + draw(-50, 850)}; };
    whole += compare(surface, place(), place()) ? 1 : 0;
  }
  EXPECT_GT(whole, 100);
  EXPECT_LT(whole, 900);
}

}  // namespace
}  // namespace itin::viewshed
