// What is told of a lattice's posts is what its triangles say.
#include "pyramid/difference/lattice_difference.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include <itin/detail.hpp>

#include "pyramid/points/working_index.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {
namespace {

constexpr int kLatticeLevels = 3;
const std::vector<double> kTolerances{0, 1, 2};

Selection level(int k) {
  return {Detail::tolerance(kTolerances[static_cast<std::size_t>(k)]), kTolerances, Grid{}};
}

using HeightAt = std::function<std::int32_t(std::int32_t, std::int32_t)>;

/// Posts with levels, and what makes them other than whole.
struct Lattice {
  std::int32_t columns = 60, rows = 50, west = -12345, south = 777, step_x = 10, step_y = 10;
  HeightAt height;
  std::function<int(std::int32_t, std::int32_t)> level;
  std::vector<RawPoint> more;

  Position post(std::int32_t c, std::int32_t r) const { return {west + c * step_x, south + r * step_y}; }
  /// The four corners have all levels, so that every level covers the lattice.
  bool is_corner(std::int32_t c, std::int32_t r) const {
    return (c == 0 || c == columns - 1) && (r == 0 || r == rows - 1);
  }
  std::vector<Segment> outline() const {
    const Position a = post(0, 0), b = post(columns - 1, 0), c = post(columns - 1, rows - 1), d = post(0, rows - 1);
    return {{a.x, a.y, b.x, b.y}, {b.x, b.y, c.x, c.y}, {c.x, c.y, d.x, d.y}, {d.x, d.y, a.x, a.y}};
  }
};

class Given {
 public:
  explicit Given(const Lattice& lattice, const std::function<bool(std::int32_t, std::int32_t)>& is_void = {})
      : points_(sorted(lattice, is_void)), index_(points_, kLatticeLevels, kLeafCapacity) {
    for (const CurveRange& range : index_.ranges()) index_.write(range, index_.read(range));
    index_.set_segments(lattice.outline());
  }
  const WorkingIndex& index() const { return index_; }
  WorkingIndex& index() { return index_; }

 private:
  static constexpr std::uint32_t kLeafCapacity = 64;

  static SortedPoints sorted(const Lattice& lattice, const std::function<bool(std::int32_t, std::int32_t)>& is_void) {
    PointSorter sorter("/tmp", 1 << 24);
    for (std::int32_t r = 0; r < lattice.rows; ++r) {
      for (std::int32_t c = 0; c < lattice.columns; ++c) {
        if (is_void && is_void(c, r)) continue;
        const Position p = lattice.post(c, r);
        const int k = lattice.is_corner(c, r) ? kLatticeLevels - 1 : lattice.level(c, r);
        sorter.add({morton(p.x, p.y), lattice.height(c, r), 0, static_cast<std::uint16_t>(k)});
      }
    }
    for (const RawPoint& p : lattice.more) sorter.add(p);
    NoProgress progress;
    return sorter.finish(std::array{SourceRank{1.0}}, progress);
  }

  SortedPoints points_;
  WorkingIndex index_;
};

class LatticeDifferences : public testing::Test {
 protected:
  std::int32_t draw(std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution<std::int32_t>(low, high)(random_);
  }

  /// A box about some of the lattice, perhaps over its sides.
  GridBox box_about(const Lattice& l) {
    const Position p = l.post(draw(-2, l.columns), draw(-2, l.rows));
    const std::int32_t x = p.x + draw(-1, 1) * draw(0, l.step_x), y = p.y + draw(-1, 1) * draw(0, l.step_y);
    return {x, y, x + draw(0, l.columns * l.step_x), y + draw(0, l.rows * l.step_y)};
  }

  void expect_as_triangles(const Lattice& lattice) {
    const Given given(lattice);
    int asked = 0;
    for (int i = 0; i < 40; ++i) {
      const GridBox box = box_about(lattice);
      const RegionMesh fine = triangulate_region(given.index(), level(0), box);
      auto posts = WholeLattice::about(given.index(), box);
      if (!posts) continue;  // too few posts are near to tell their steps
      ASSERT_FALSE(fine.mesh.triangles.empty());
      GridBox own;
      for (const SelectedVertex& v : fine.vertices) own.extend(v.point.x, v.point.y);
      ASSERT_EQ(posts->bounds(), own);
      LatticeDifference difference(std::move(*posts));
      const FineEdges edges(fine);
      for (int k = 1; k < kLatticeLevels; ++k) {
        const RegionMesh coarse = triangulate_region(given.index(), level(k), own);
        ASSERT_TRUE(difference.compare(coarse, 0));
        const std::int32_t allowed = draw(0, difference.over(difference.posts().bounds()).size());
        ASSERT_TRUE(difference.compare(coarse, allowed));
        const Difference by_edges = itin::difference(fine, edges, coarse, allowed);
        expect_same_failures(fine, coarse, by_edges.failures, difference.failures(), allowed);
        failing_ += by_edges.failures.crossings.size();
        const auto by_triangle = over_triangles(fine, edges, by_edges);
        expect_as_triangles(fine, by_triangle, difference, own);
        for (int s = 0; s < 20; ++s) expect_as_triangles(fine, by_triangle, difference, box_about(lattice));
        ++asked;
      }
    }
    EXPECT_GT(asked, 20);
  }

  std::mt19937 random_{test::seed()};
  std::size_t failing_ = 0;  ///< crossings that failed

 private:
  /// Both say so of each crossing. Of vertices on coarse edges triangles may say which face has them as they like.
  static void expect_same_failures(const RegionMesh& fine, const RegionMesh& coarse, const Failures& of_triangles,
                                   const Failures& of_posts, std::int32_t allowed) {
    const auto sorted = [](const Failures& failures) {
      std::vector<std::tuple<std::uint32_t, std::uint32_t, std::int32_t, std::array<std::uint64_t, 4>>> all;
      for (const FailingCrossing& c : failures.crossings)
        all.emplace_back(c.coarse_from, c.coarse_to, c.size, c.vertices);
      std::sort(all.begin(), all.end());
      return all;
    };
    ASSERT_EQ(sorted(of_triangles), sorted(of_posts));
    const std::set<std::uint64_t> worst_of_all = worst_of_faces(fine, coarse, allowed);
    const auto& posts = of_posts.worst_of_faces;
    ASSERT_EQ(std::set<std::uint64_t>(posts.begin(), posts.end()), worst_of_all);
    ASSERT_EQ(of_triangles.worst_of_faces.empty(), worst_of_all.empty());
  }

  /// Of each coarse triangle the fine vertex in it, or on its sides, that is farthest from it, if by more than allowed.
  static std::set<std::uint64_t> worst_of_faces(const RegionMesh& fine, const RegionMesh& coarse,
                                                std::int32_t allowed) {
    std::set<std::uint64_t> result;
    for (const auto& t : coarse.mesh.triangles) {
      const GridPoint &a = coarse.vertices[t[0]].point, &b = coarse.vertices[t[1]].point,
                      &c = coarse.vertices[t[2]].point;
      std::pair<Int128, std::uint64_t> worst{0, 0};  // size, and the code counted down
      for (const SelectedVertex& v : fine.vertices) {
        const Int128 wa = doubled_area(v.point, b, c), wb = doubled_area(a, v.point, c),
                     wc = doubled_area(a, b, v.point);
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const Int128 weight = wa + wb + wc, above = v.point.z * weight - (wa * a.z + wb * b.z + wc * c.z);
        const Int128 size = ((above < 0 ? -above : above) + weight - 1) / weight;
        if (size > allowed) worst = std::max(worst, {size, ~code_of(v)});
      }
      if (worst.first > 0) result.insert(~worst.second);
    }
    return result;
  }

  static void expect_as_triangles(const RegionMesh& fine, const std::vector<DifferenceRange>& by_triangle,
                                  const LatticeDifference& difference, const GridBox& square) {
    DifferenceRange expected;
    for (std::size_t t = 0; t < by_triangle.size(); ++t) {
      GridBox own;
      for (const std::uint32_t v : fine.mesh.triangles[t])
        own.extend(fine.vertices[v].point.x, fine.vertices[v].point.y);
      if (own.meets(square)) expected.add(by_triangle[t]);
    }
    const DifferenceRange found = difference.over(square);
    ASSERT_EQ(found.empty(), expected.empty());
    if (expected.empty()) return;
    ASSERT_EQ(found.lo, expected.lo);
    ASSERT_EQ(found.hi, expected.hi);
  }
};

TEST_F(LatticeDifferences, AreThoseOfTrianglesOnRoughGround) {
  for (const std::int32_t greatest : {3, 1000, 1 << 20}) {
    Lattice lattice;
    lattice.step_y = draw(1, 25);
    lattice.height = [&](auto, auto) { return draw(-greatest, greatest); };
    lattice.level = [&](auto, auto) { return draw(0, 9) < 7 ? 0 : draw(1, 2); };
    expect_as_triangles(lattice);
  }
  EXPECT_GT(failing_, 0U);
}

/// Coarse edges run along rows, columns and diagonals, and pass through posts.
TEST_F(LatticeDifferences, AreThoseOfTrianglesUnderRegularCoarseSurfaces) {
  const test::CardiffTerrain terrain;
  for (const int stride : {2, 3, 7}) {
    Lattice lattice;
    lattice.height = [&](std::int32_t c, std::int32_t r) {
      return static_cast<std::int32_t>(100 * terrain(c + 100, r + 200));
    };
    lattice.level = [&](std::int32_t c, std::int32_t r) { return c % stride == 0 && r % stride == 0 ? c % 2 + 1 : 0; };
    expect_as_triangles(lattice);
  }
  EXPECT_GT(failing_, 0U);
}

TEST_F(LatticeDifferences, AreNothingOnPlanesAndFlats) {
  for (const std::int32_t slope : {0, 3}) {
    Lattice lattice;
    lattice.height = [&](std::int32_t c, std::int32_t r) { return slope * (5 * c - 7 * r); };
    lattice.level = [&](auto, auto) { return draw(0, 30) / 29; };
    const Given given(lattice);
    LatticeDifference difference(*WholeLattice::about(given.index(), given.index().bounds()));
    ASSERT_TRUE(difference.compare(triangulate_region(given.index(), level(1), given.index().bounds()), 0));
    EXPECT_LE(difference.over(difference.posts().bounds()).size(), 1);  // crossings are rounded outwards
    expect_as_triangles(lattice);
  }
}

/// Whatever makes other triangles is seen, at whatever distance it does, and nothing else is.
TEST_F(LatticeDifferences, AreNotToldWhereOtherThingsAreNear) {
  Lattice lattice;
  lattice.height = [](auto, auto) { return 0; };
  lattice.level = [](auto, auto) { return 0; };
  const auto box_at = [&](std::int32_t c, std::int32_t r) {
    const Position p = lattice.post(c, r);
    return GridBox{p.x + 1, p.y + 1, p.x + 2 * lattice.step_x - 1, p.y + 2 * lattice.step_y - 1};
  };
  const auto is_told = [&](const Given& given, std::int32_t c, std::int32_t r) {
    return WholeLattice::about(given.index(), box_at(c, r)).has_value();
  };
  const Given gap(lattice, [](std::int32_t c, std::int32_t r) { return c == 30 && r == 30; });
  EXPECT_FALSE(is_told(gap, 29, 29));
  EXPECT_FALSE(is_told(gap, 28, 30));
  EXPECT_TRUE(is_told(gap, 20, 30));
  const Position at = lattice.post(30, 30);
  lattice.more = {{morton(at.x + 3, at.y + 4), 5, 0, 0}};
  const Given other(lattice);
  EXPECT_FALSE(is_told(other, 29, 29));
  EXPECT_FALSE(is_told(other, 28, 30));
  EXPECT_TRUE(is_told(other, 20, 30));
  lattice.more.clear();
  Given line(lattice);
  std::vector<Segment> segments = lattice.outline();
  const Position a = lattice.post(30, 30), b = lattice.post(33, 31);
  segments.push_back({a.x, a.y, b.x, b.y, 1});
  line.index().set_segments(segments);
  EXPECT_FALSE(is_told(line, 30, 30));
  EXPECT_TRUE(is_told(line, 20, 30));
}

TEST_F(LatticeDifferences, AreNotToldUnderVerticesOffTheLattice) {
  Lattice lattice;
  lattice.height = [](auto, auto) { return 0; };
  lattice.level = [](auto, auto) { return 0; };
  const Position at = lattice.post(30, 30);
  lattice.more = {{morton(at.x + 3, at.y + 4), 5, 0, 2}};
  const Given given(lattice);
  const Position p = lattice.post(5, 5);
  auto posts = WholeLattice::about(given.index(), {p.x, p.y, p.x + 50, p.y + 50});
  ASSERT_TRUE(posts);
  LatticeDifference difference(std::move(*posts));
  EXPECT_FALSE(difference.compare(triangulate_region(given.index(), level(2), difference.posts().bounds()), 0));
}

}  // namespace
}  // namespace itin
