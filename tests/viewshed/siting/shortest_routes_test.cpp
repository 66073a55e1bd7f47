// Routes against those that relaxing every link again and again finds.
#include "workflows/siting/shortest_routes.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "support/seed.hpp"

namespace itin::viewshed {

namespace {

struct Way {
  double hops = std::numeric_limits<double>::infinity(), length = 0;
  friend auto operator<=>(const Way&, const Way&) = default;
};

/// Bellman and Ford's.
std::vector<Way> least_ways(std::size_t root, std::size_t places, const std::vector<RouteLink>& links) {
  std::vector<Way> ways(places);
  ways[root] = {0, 0};
  for (std::size_t round = 0; round < places; ++round)
    for (const RouteLink& link : links)
      for (const auto& [near, far] : {std::pair{link.from, link.to}, std::pair{link.to, link.from}})
        ways[far] = std::min(ways[far], Way{ways[near].hops + 1, ways[near].length + link.length});
  return ways;
}

TEST(ShortestRoutes, HaveTheFewestHopsAndThenTheLeastLength) {
  std::mt19937 random(test::seed());
  std::size_t unreached = 0, long_routes = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const std::size_t places = 2 + random() % 14, root = random() % places;
    std::vector<RouteLink> links;
    for (std::size_t i = 0; i < places; ++i)
      for (std::size_t j = i + 1; j < places; ++j)
        // Lengths from a few whole numbers, so that many routes are equally long.
        if (random() % places < 2) links.push_back({i, j, static_cast<double>(1 + random() % 5)});
    const auto leaves_by = shortest_routes(root, places, links);
    const std::vector<Way> least = least_ways(root, places, links);
    ASSERT_FALSE(leaves_by[root]);
    for (std::size_t site = 0; site < places; ++site) {
      Way way{0, 0};
      std::size_t at = site;
      for (; leaves_by[at]; at = links[*leaves_by[at]].other_end(at)) {
        ++way.hops, way.length += links[*leaves_by[at]].length;
        ASSERT_LE(way.hops, static_cast<double>(places));
      }
      if (at != root) {
        EXPECT_EQ(at, site);
        EXPECT_TRUE(std::isinf(least[site].hops));
        ++unreached;
      } else {
        EXPECT_EQ(way, least[site]);
        long_routes += way.hops > 2;
      }
    }
  }
  EXPECT_GT(unreached, 50U);
  EXPECT_GT(long_routes, 50U);
}

TEST(ShortestRoutes, TakesTheLinkThatComesFirstAmongEquals) {
  const std::vector<RouteLink> links{{1, 2, 7}, {0, 1, 5}, {0, 2, 5}, {3, 2, 4}, {1, 3, 4}};
  const auto leaves_by = shortest_routes(0, 4, links);
  EXPECT_EQ(leaves_by[1], 1U);
  EXPECT_EQ(leaves_by[2], 2U);
  EXPECT_EQ(leaves_by[3], 3U);
}

}  // namespace

}  // namespace itin::viewshed
