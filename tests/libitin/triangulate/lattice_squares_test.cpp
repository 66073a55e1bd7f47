#include "triangulate/region/lattice_squares.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "features/plan/planar.hpp"
#include "support/adjacency.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

constexpr GridBox kEverywhere{-kGridHalfSide, -kGridHalfSide, kGridHalfSide - 1, kGridHalfSide - 1};

struct Ground {
  std::vector<Position> positions;
  std::vector<Segment> segments;
  GridBox known = kEverywhere;
};

std::vector<Delaunay::Constraint> constraints(const Ground& ground) {
  std::map<Position, std::uint32_t> number;
  for (std::uint32_t i = 0; i < ground.positions.size(); ++i) number[ground.positions[i]] = i;
  std::vector<Delaunay::Constraint> result;
  for (const Segment& s : ground.segments) result.emplace_back(number.at({s.ax, s.ay}), number.at({s.bx, s.by}));
  return result;
}

void expect_squares_and_rest_make_the_whole(const Ground& ground, std::size_t given) {
  Delaunay whole;
  whole.insert(ground.positions);
  whole.constrain(constraints(ground));

  const std::span<const Position> read(ground.positions.data(), given);
  const LatticeSquares squares(read, ground.segments, ground.known);
  std::vector<std::uint32_t> rest = squares.rest();
  // Positions that turn up later have later numbers.
  for (std::size_t i = given; i < ground.positions.size(); ++i) rest.push_back(static_cast<std::uint32_t>(i));
  std::vector<Position> positions;
  for (const std::uint32_t i : rest) positions.push_back(ground.positions[i]);
  Delaunay delaunay;
  delaunay.insert(positions, rest);
  delaunay.constrain(constraints(ground));
  PlaneMesh mesh = delaunay.mesh();
  squares.fill(mesh);
  ASSERT_EQ(test::adjacency(mesh, ground.positions), test::adjacency(whole.mesh(), ground.positions));
}

class RandomGround {
 public:
  explicit RandomGround(unsigned seed) : random_(seed) {}

  /// `given` is how many come first that are read at once: all of those in the known box among them.
  Ground make(std::size_t& given) {
    const std::vector<std::int32_t> columns = axis(), rows = axis();
    const int gaps = std::array{0, 2, 30}[random_() % 3];
    std::set<Position> found;
    for (const std::int32_t x : columns) {
      for (const std::int32_t y : rows) {
        if (below(0, 99) >= gaps) found.insert({x, y});
      }
    }
    const GridBox box{columns.front(), rows.front(), columns.back(), rows.back()};
    for (int strays = std::array{0, 3, 40}[random_() % 3]; strays > 0; --strays) found.insert(anywhere(box));
    Ground ground;
    if (random_() % 2 == 0) add_lines(box, found, ground);
    if (random_() % 2 == 0) ground.known = part_of(box);
    std::set<Position> ends;
    for (const Segment& s : ground.segments) ends.insert({{s.ax, s.ay}, {s.bx, s.by}});
    ground.positions.assign(found.begin(), found.end());
    const auto late = std::stable_partition(ground.positions.begin(), ground.positions.end(), [&](Position p) {
      return ground.known.contains(p.x, p.y) || ends.contains(p) || random_() % 2 == 0;
    });
    given = static_cast<std::size_t>(late - ground.positions.begin());
    return ground;
  }

 private:
  std::int32_t below(std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(random_() % static_cast<unsigned>(high - low + 1));
  }
  Position anywhere(const GridBox& b) { return {below(b.xmin - 9, b.xmax + 9), below(b.ymin - 9, b.ymax + 9)}; }

  /// Even, rounded, or at any distances.
  std::vector<std::int32_t> axis() {
    const int kind = below(0, 2);
    const double step = below(2, 400) / 3.0 + 1;
    std::vector<std::int32_t> values{below(-1000, 1000)};
    for (int i = below(1, 25); i > 0; --i) {
      const std::int32_t next = kind == 0   ? static_cast<std::int32_t>(step)
                                : kind == 1 ? below(0, 1) + static_cast<std::int32_t>(step)
                                            : below(1, 60);
      values.push_back(values.back() + next);
    }
    return values;
  }

  /// Along columns and diagonals, and from anywhere to anywhere.
  void add_lines(const GridBox& box, std::set<Position>& found, Ground& ground) {
    const std::vector<Position> posts(found.begin(), found.end());
    std::vector<OwnedSegment> lines;
    for (int i = below(1, 8); i > 0 && !posts.empty(); --i) {
      const Position a = posts[random_() % posts.size()],
                     b = random_() % 3 == 0 ? anywhere(box) : posts[random_() % posts.size()];
      const Position end = random_() % 2 == 0 ? b : random_() % 2 == 0 ? Position{a.x, b.y} : Position{b.x, a.y};
      lines.push_back({{a.x, a.y, 0}, {end.x, end.y, 0}, 0});
    }
    const PlanarLines planar = make_planar(lines);
    for (const GridPoint& p : planar.vertices) found.insert({p.x, p.y});
    for (const PlanarEdge& e : planar.edges) {
      const GridPoint &a = planar.vertices[e.from], &b = planar.vertices[e.to];
      ground.segments.push_back({a.x, a.y, b.x, b.y});
    }
  }

  GridBox part_of(const GridBox& b) {
    const Position p = anywhere(b), q = anywhere(b);
    return {std::min(p.x, q.x), std::min(p.y, q.y), std::max(p.x, q.x), std::max(p.y, q.y)};
  }

  std::mt19937 random_;
};

TEST(LatticeSquares, WithTheRestAreTheWholeTriangulation) {
  RandomGround random(test::seed());
  for (int run = 0; run < 200; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    std::size_t given = 0;
    const Ground ground = random.make(given);
    ASSERT_NO_FATAL_FAILURE(expect_squares_and_rest_make_the_whole(ground, given));
  }
}

std::vector<Position> lattice(int columns, int rows, std::int32_t width, std::int32_t height) {
  std::vector<Position> positions;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) positions.push_back({c * width, r * height});
  return positions;
}

TEST(LatticeSquares, OfAFullLatticeAreAllButThePostsAtItsBorder) {
  const std::vector<Position> positions = lattice(7, 5, 50, 20);
  const LatticeSquares squares(positions, {}, kEverywhere);
  EXPECT_EQ(squares.triangle_count(), 2U * 6 * 4);
  EXPECT_EQ(squares.rest().size(), 7U * 5 - 5 * 3);
}

TEST(LatticeSquares, AreOnlyWhereTheirCirclesAreKnown) {
  const std::vector<Position> positions = lattice(9, 9, 50, 50);
  const LatticeSquares squares(positions, {}, {0, 0, 400, 400});
  EXPECT_EQ(squares.triangle_count(), 2U * 6 * 6);
}

TEST(LatticeSquares, LieAlongLinesButNotUnderThem) {
  const std::vector<Position> positions = lattice(7, 5, 50, 50);
  const Segment along{50, 100, 250, 100}, across{50, 50, 100, 100};
  EXPECT_EQ(LatticeSquares(positions, std::array{along}, kEverywhere).triangle_count(), 2U * 24);
  EXPECT_EQ(LatticeSquares(positions, std::array{across}, kEverywhere).triangle_count(), 2U * 23);
}

TEST(LatticeSquares, AreNoneAmongScatteredPoints) {
  std::vector<Position> positions;
  for (std::int32_t i = 0; i < 1000; ++i) positions.push_back({i * 7919 % 10007, i * 6007 % 10009});
  EXPECT_EQ(LatticeSquares(positions, {}, kEverywhere).triangle_count(), 0U);
  EXPECT_EQ(LatticeSquares(positions, {}, kEverywhere).rest().size(), positions.size());
  EXPECT_EQ(LatticeSquares({}, {}, kEverywhere).triangle_count(), 0U);
}

}  // namespace
}  // namespace itin
