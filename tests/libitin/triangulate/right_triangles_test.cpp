// Right triangles on closed sets of posts, with the triangulation of the rest, are the triangulation of all positions.
#include "triangulate/region/right_triangles.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "support/adjacency.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

constexpr GridBox kNoLimits{-kGridHalfSide, -kGridHalfSide, kGridHalfSide - 1, kGridHalfSide - 1};

/// Random sets of posts that are closed, and what may spoil them.
class ClosedPosts {
 public:
  explicit ClosedPosts(unsigned seed) : random_(seed) {
    step_ = draw(1, 60);
    first_ = {step_ * draw(-100, 100) + draw(0, 5), step_ * draw(-100, 100) + draw(0, 5)};
    lattice_ = PostLattice{first_.x, first_.y, step_, step_}.from_first_place();
    columns_ = draw(40, 260), rows_ = draw(40, 260);
  }

  std::int32_t draw(std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution<std::int32_t>(low, high)(random_);
  }
  Position position(std::int32_t column, std::int32_t row) const {
    return {first_.x + column * step_, first_.y + row * step_};
  }
  Position any_post() { return position(draw(0, columns_ - 1), draw(0, rows_ - 1)); }
  GridBox bounds() const {
    const Position last = position(columns_ - 1, rows_ - 1);
    return {first_.x, first_.y, last.x, last.y};
  }

  /// Posts near a few places, denser towards them, with all corners that they need; the corners of blocks; and where
  /// the lattice ends, the posts that bound smaller and smaller squares.
  std::set<Position> closed_set() {
    std::set<Position> posts;
    for (std::int32_t row = 0; row < rows_; ++row) {
      for (std::int32_t column = 0; column < columns_; ++column) {
        const LatticePlace place = *lattice_.place_of(position(column, row));
        if (square_about(place).half == 0 || is_at_end(place)) need(posts, place);
      }
    }
    const Position focus = any_post();
    const double scale = draw(1, 40) * step_;
    for (int i = draw(0, 4000); i > 0; --i) {
      const Position p = any_post();
      const double distance = std::hypot(p.x - focus.x, p.y - focus.y);
      if (draw(0, 999) < 1000 * std::exp(-distance / scale)) need(posts, *lattice_.place_of(p));
    }
    return posts;
  }

 private:
  bool has(const LatticePlace& place) const {
    const Position p = at(place);
    return bounds().contains(p.x, p.y);
  }
  Position at(const LatticePlace& place) const {
    return {static_cast<std::int32_t>(lattice_.x + place.column * step_),
            static_cast<std::int32_t>(lattice_.y + place.row * step_)};
  }
  /// Whether the square about a post reaches beyond the lattice.
  bool is_at_end(const LatticePlace& place) const {
    const PostSquare square = square_about(place);
    for (const LatticePlace& half : halves_of(place, square))
      for (const LatticePlace& corner : corners_in_half(place, square, half))
        if (!has(corner)) return true;
    return false;
  }
  void need(std::set<Position>& posts, const LatticePlace& place) const {
    if (!has(place) || !posts.insert(at(place)).second) return;
    const PostSquare square = square_about(place);
    if (square.half == 0) return;
    for (const LatticePlace& half : halves_of(place, square))
      for (const LatticePlace& corner : corners_in_half(place, square, half)) need(posts, corner);
  }

  std::mt19937 random_;
  std::int32_t step_ = 1, columns_ = 0, rows_ = 0;
  Position first_;
  PostLattice lattice_;
};

struct TriangleInput {
  std::vector<Position> positions;  ///< in Morton order
  std::vector<Segment> segments;
  GridBox known = kNoLimits;
};

std::vector<Delaunay::Constraint> constraints_of(const TriangleInput& input) {
  std::map<Position, std::uint32_t> number;
  for (std::uint32_t i = 0; i < input.positions.size(); ++i) number[input.positions[i]] = i;
  std::vector<Delaunay::Constraint> result;
  for (const Segment& s : input.segments) result.emplace_back(number.at(s.a()), number.at(s.b()));
  return result;
}

/// Returns how many triangles were known.
std::uint32_t expect_known_and_rest_make_the_whole(const TriangleInput& input) {
  Delaunay whole;
  whole.insert(input.positions);
  whole.constrain(constraints_of(input));
  const RightTriangles triangles(input.positions, input.segments, input.known);
  std::vector<Position> rest;
  for (const std::uint32_t i : triangles.rest()) rest.push_back(input.positions[i]);
  Delaunay delaunay;
  delaunay.insert(rest, triangles.rest());
  delaunay.constrain(constraints_of(input));
  PlaneMesh mesh = delaunay.mesh();
  triangles.fill(mesh);
  EXPECT_EQ(test::adjacency(mesh, input.positions), test::adjacency(whole.mesh(), input.positions));
  return triangles.triangle_count();
}

TriangleInput in_order(const std::set<Position>& positions) {
  TriangleInput input;
  input.positions.assign(positions.begin(), positions.end());
  std::sort(input.positions.begin(), input.positions.end(),
            [](Position p, Position q) { return code_of(p) < code_of(q); });
  return input;
}

TEST(RightTriangle, MakeTheTriangulationOfClosedPostsWithTheRest) {
  std::uint64_t known = 0, all = 0;
  for (unsigned round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    ClosedPosts ground(test::seed() + round);
    const TriangleInput input = in_order(ground.closed_set());
    if (input.positions.size() < 3) continue;
    known += expect_known_and_rest_make_the_whole(input);
    all += 2 * input.positions.size();
  }
  // Those at the lattice's ends, and those of small sets, are left to the triangulation.
  EXPECT_GT(known * 4, all);
}

TEST(RightTriangle, LeaveWhatIsNotClosedToTheRest) {
  for (unsigned round = 0; round < 120; ++round) {
    SCOPED_TRACE(round);
    ClosedPosts ground(test::seed() + 1000 + round);
    std::set<Position> positions = ground.closed_set();
    const int spoilt = ground.draw(1, 20);
    for (int i = 0; i < spoilt; ++i) {
      const Position p = ground.any_post();
      switch (round % 3) {
        case 0:
          positions.erase(p);
          break;
        case 1:
          positions.insert(p);
          break;
        default:
          positions.insert({p.x + ground.draw(-20, 20), p.y + ground.draw(-20, 20)});
      }
    }
    expect_known_and_rest_make_the_whole(in_order(positions));
  }
}

TEST(RightTriangle, StayClearOfSegmentsAndOfUnknownGround) {
  for (unsigned round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    ClosedPosts ground(test::seed() + 2000 + round);
    std::set<Position> positions = ground.closed_set();
    const Position a = ground.any_post(), b = ground.any_post();
    positions.insert(a), positions.insert(b);
    TriangleInput input = in_order(positions);
    if (round % 2 == 0 && a != b) {
      // The segment passes between posts, or its pieces lead from post to post.
      std::vector<Position> on{a, b};
      for (const Position& p : input.positions)
        if (p != a && p != b && orientation(a, b, p) == 0 && lies_ahead(a, b, p) && lies_ahead(b, a, p))
          on.push_back(p);
      std::sort(on.begin(), on.end());
      for (std::size_t i = 1; i < on.size(); ++i)
        input.segments.push_back({on[i - 1].x, on[i - 1].y, on[i].x, on[i].y, 1});
    } else {
      // Vertices outside the known box may be missing, so none of its triangles may reach out of it.
      input.known = {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
      std::set<Position> beyond(input.positions.begin(), input.positions.end());
      for (int i = 0; i < 30; ++i) {
        const Position p{ground.any_post().x + 1, ground.any_post().y};
        if (!input.known.contains(p.x, p.y)) beyond.insert(p);
      }
      std::erase_if(beyond, [&](Position p) { return !input.known.contains(p.x, p.y) && ground.draw(0, 1) == 0; });
      TriangleInput changed = in_order(beyond);
      changed.known = input.known;
      expect_known_and_rest_make_the_whole(changed);
    }
    expect_known_and_rest_make_the_whole(input);
  }
}

}  // namespace
}  // namespace itin
