// Clusters of touching features in the blocks of a part: what is written is read, and damage is found.
#include "store/segments/clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>

#include "libitin/store/random_points.hpp"
#include "store/segments/block_preface.hpp"
#include "store/segments/line_codec.hpp"
#include "store/store_file.hpp"
#include "store/store_writer.hpp"
#include "support/forged_rows.hpp"
#include "support/row_bytes.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "triangulate/raised_index.hpp"

namespace itin {
namespace {

using testing::Each;
using testing::StartsWith;

constexpr Cell kLeafCell{morton(-4096, 8192), 12};

/// Boxes about random places of the cell, many of which overlap, and items that meet them.
struct RandomLeaf {
  explicit RandomLeaf(std::mt19937& random, std::size_t count) {
    const auto in = [&](int low, int high) {
      return low + static_cast<std::int32_t>(random() % static_cast<unsigned>(high - low + 1));
    };
    std::vector<GridBox> boxes;
    for (int i = in(1, 20); i > 0; --i) {
      const std::int32_t x = in(-4096, -4096 + 4000), y = in(8192, 8192 + 4000);
      boxes.push_back(box_about_cluster({x, y, x + in(0, 900), y + in(0, in(0, 1) == 1 ? 20 : 900)}));
    }
    std::vector<std::pair<std::uint32_t, GridBox>> of;
    for (std::uint32_t i = 0; i < count; ++i) {
      const GridBox& first = boxes[random() % boxes.size()];
      const std::int32_t x = in(first.xmin, first.xmax), y = in(first.ymin, first.ymax);
      extents.push_back({x, y, x + in(0, 1) * in(0, 300), y + in(0, 1) * in(0, 300)});
      of.emplace_back(i, first);
      for (const GridBox& other : boxes)
        if (other.meets(extents.back()) && in(0, 5) == 0) of.emplace_back(i, other);
    }
    const auto before = [](const GridBox& a, const GridBox& b) {
      return std::tie(a.xmin, a.ymin, a.xmax, a.ymax) < std::tie(b.xmin, b.ymin, b.xmax, b.ymax);
    };
    std::set<GridBox, decltype(before)> met(before);
    for (const auto& [item, box] : of) met.insert(box);
    clusters.boxes.assign(met.begin(), met.end());
    std::set<ItemCluster> items;
    for (const auto& [item, box] : of)
      items.insert({item, static_cast<std::uint32_t>(std::distance(met.begin(), met.find(box)))});
    clusters.items.assign(items.begin(), items.end());
  }

  std::vector<GridBox> extents;
  LeafClusters clusters;
};

TEST(Clusters, AreReadAsTheyWereWritten) {
  std::mt19937 random(test::seed());
  for (const std::size_t count : {1U, 2U, 40U, 512U}) {
    for (int round = 0; round < 20; ++round) {
      const RandomLeaf leaf(random, count);
      const std::vector<std::uint8_t> bytes = encode_clusters(kLeafCell, leaf.extents, leaf.clusters);
      const LeafClusters found = decode_clusters(kLeafCell, leaf.extents, bytes);
      EXPECT_EQ(found.boxes, leaf.clusters.boxes);
      EXPECT_EQ(found.items, leaf.clusters.items);
    }
  }
}

TEST(Clusters, ReachTheGridsCorners) {
  constexpr std::int32_t low = -kGridHalfSide, high = kGridHalfSide - 1;
  const std::vector<GridBox> extents{{low, low, low, low}, {high, high, high, high}};
  const LeafClusters all{{{low, low, high, high}}, {{0, 0}, {1, 0}}};
  EXPECT_EQ(decode_clusters(kLeafCell, extents, encode_clusters(kLeafCell, extents, all)).boxes, all.boxes);
  EXPECT_EQ(box_about_cluster({low, low, high, high}), all.boxes.front());
}

TEST(Clusters, HaveBoxesThatHoldWhatIsInThem) {
  std::mt19937 random(test::seed());
  for (int i = 0; i < 1000; ++i) {
    const auto in = [&] { return static_cast<std::int32_t>(random() % (2U * kGridHalfSide)) - kGridHalfSide; };
    GridBox box;
    box.extend(in(), in());
    box.extend(in(), in());
    const GridBox about = box_about_cluster(box);
    EXPECT_TRUE(about.contains(box));
    EXPECT_LT(box.xmin - about.xmin, 64);
    EXPECT_LT(about.ymax - box.ymax, 64);
  }
}

TEST(Clusters, ItemsBesideTheirBoxesAreRefused) {
  const std::vector<GridBox> extents{{5000, 5000, 5000, 5000}};
  const LeafClusters beside{{box_about_cluster({-4000, 8200, -3900, 8300})}, {{0, 0}}};
  EXPECT_THROW(encode_clusters(kLeafCell, extents, beside), std::invalid_argument);
  const std::vector<GridBox> within{{-3950, 8250, -3950, 8250}};
  EXPECT_THROW(decode_clusters(kLeafCell, extents, encode_clusters(kLeafCell, within, beside)), DecodeError);
}

TEST(Clusters, DamageIsFoundOrGivesOtherClusters) {
  std::mt19937 random(test::seed());
  const RandomLeaf leaf(random, 60);
  const std::vector<std::uint8_t> whole = encode_clusters(kLeafCell, leaf.extents, leaf.clusters);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(decode_clusters(kLeafCell, leaf.extents, std::span(whole).first(size)), DecodeError) << size;
  std::vector<std::uint8_t> longer = whole;
  longer.push_back(0);
  EXPECT_THROW(decode_clusters(kLeafCell, leaf.extents, longer), DecodeError);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes = whole;
    for (int flips = 1 + static_cast<int>(random() % 3); flips > 0; --flips)
      bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    try {
      const LeafClusters found = decode_clusters(kLeafCell, leaf.extents, bytes);
      std::set<std::uint32_t> items;
      for (const auto& [item, cluster] : found.items) {
        EXPECT_TRUE(found.boxes.at(cluster).meets(leaf.extents[item]));
        items.insert(item);
      }
      EXPECT_EQ(items.size(), leaf.extents.size());
    } catch (const DecodeError&) {
    }
  }
}

/// A store of 600 random points with sheds in a line, which level 1 leaves out: squares of four vertices each, every
/// other of them sharing a vertex with the next.
class ClusteredStore : public testing::Test {
 protected:
  static constexpr std::uint16_t kPart = 2;
  static constexpr int kSheds = 60;

  void SetUp() override {
    write(true);
    sound_ = test::read_bytes(path_);
  }

  void write(bool clustered) const {
    const test::GivenStore given = test::random_store(test::seed(), 600, 2);
    PartClusters clusters;
    std::vector<GridPoint> points;
    std::vector<Segment> segments;
    for (std::int32_t i = 0; i < kSheds; ++i) {
      const std::int32_t x = 900 * i, y = i % 2 == 0 ? 0 : 400;
      const std::array<GridPoint, 4> corners{{{x, y, 1}, {x + 400, y, 1}, {x + 400, y + 400, 1}, {x, y + 400, 1}}};
      GridBox box;
      for (std::size_t c = 0; c < 4; ++c) {
        const GridPoint &a = corners[c], &b = corners[(c + 1) % 4];
        points.push_back(a);
        box.extend(a.x, a.y);
        const auto [from, to] = std::minmax({std::pair(a.x, a.y), std::pair(b.x, b.y)});
        segments.push_back({from.first, from.second, to.first, to.second, kPart});
        clusters.of_segments.push_back({segments.back(), static_cast<std::uint32_t>(i)});
        clusters.of_places.emplace_back(code_of(a), static_cast<std::uint32_t>(i));
      }
      clusters.boxes.push_back(box_about_cluster(box));
    }
    std::sort(clusters.of_places.begin(), clusters.of_places.end());
    std::sort(clusters.of_segments.begin(), clusters.of_segments.end());
    points = test::in_curve_order(points);
    std::vector<ThemeInfo> themes{{"sheds", ThemeKind::Buildings, kSheds, points.size(), segments.size()}};
    StoreWriter writer(path_, "", given.grid, given.tolerances);
    given.add_leaves(writer);
    const std::vector<std::uint16_t> sources(points.size(), 0);
    writer.add_part_vertices(kPart, points, sources, {}, clustered ? clusters : PartClusters());
    std::map<std::uint16_t, PartClusters> of_parts;
    if (clustered) of_parts[kPart] = clusters;
    writer.add_segments(segments, {}, of_parts);
    StoredFootprint shed;
    shed.feature.name = "shed";
    themes[0].footprint_blocks = writer.add_footprints(1, std::vector{shed});
    writer.commit(std::vector<SourceInfo>(3), themes, {{1, 0}});
  }

  std::vector<std::string> damaged_places() const {
    NoProgress progress;
    std::vector<std::string> places;
    for (const Damage& d : check(Store(path_), progress)) places.push_back(d.place);
    return places;
  }

  /// The sheds of which a query with these rings about the first one has vertices, and has segments.
  std::pair<std::set<int>, std::set<int>> sheds(double radius) const {
    const Store store(path_);
    const double coarse = store.metadata().levels.back().tolerance;
    const Point2 centre = store.metadata().grid.position(200, 200);
    const Selection selection =
        selection_of(store.metadata(), Detail::rings(centre, {{radius, 0}, {2 * radius, coarse}}), ThemeChoice::all());
    const RaisedIndex index(store, selection);
    std::pair<std::set<int>, std::set<int>> found;
    std::vector<Leaf> leaves;
    selected_leaves(index, selection, index.bounds(), leaves);
    for (const Leaf& leaf : leaves)
      if (leaf.theme == kPart)
        for (const GridPoint& p : index.block(leaf)->points) found.first.insert(p.x / 900);
    std::vector<Segment> segments;
    index.segments(index.bounds(), segments);
    for (const Segment& s : segments)
      if (s.theme == kPart) found.second.insert(s.ax / 900);
    return found;
  }

  const test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("sheds.itin");
  std::string sound_;
  std::mt19937 random_{test::seed()};
};

TEST_F(ClusteredStore, HasWhatTheFinestLevelAboutEachBoxHas) {
  EXPECT_THAT(damaged_places(), testing::IsEmpty());
  EXPECT_TRUE(Store(path_).metadata().parts.at(0).has_clusters);
  for (const double radius : {1.0, 30.0, 200.0, 1000.0}) {
    std::set<int> expected;
    for (int i = 0; i < kSheds; ++i) {
      const GridBox box = box_about_cluster({900 * i, i % 2 * 400, 900 * i + 400, i % 2 * 400 + 400});
      const double x = std::max(0, box.xmin - 200), y = std::max(0, box.ymin - 200);
      if (std::hypot(x, y) <= 100 * radius) expected.insert(i);
    }
    EXPECT_EQ(sheds(radius), std::pair(expected, expected)) << radius;
  }
}

TEST_F(ClusteredStore, WithoutClustersHasAllOfItsShedsWithEveryRing) {
  write(false);
  EXPECT_EQ(sheds(1).first.size(), std::size_t{kSheds});
  EXPECT_EQ(sheds(1).second.size(), std::size_t{kSheds});
}

TEST_F(ClusteredStore, DamageOfAnyByteIsFoundOrChangesNothing) {
  const auto expected = sheds(100);
  for (int i = 0; i < 300; ++i) {
    const std::size_t place = random_() % sound_.size();
    std::string bytes = sound_;
    bytes[place] = static_cast<char>(bytes[place] ^ static_cast<char>(1 + random_() % 255));
    test::write_bytes(path_, bytes);
    try {
      EXPECT_EQ(sheds(100), expected) << place;
    } catch (const FileError& e) {
      EXPECT_THAT(e.what(), StartsWith(path_ + ": ")) << place;
    }
  }
}

TEST_F(ClusteredStore, BitsUnderAFittingSealNameTheirPlace) {
  const StoreRows rows(path_);
  std::vector<std::uint64_t> keys;
  rows.for_each_key(BlobKind::Block, [&](std::uint64_t key) {
    if (format::theme_of(format::tree_of(key)) == kPart) keys.push_back(key);
  });
  ASSERT_GE(keys.size(), 2U);
  for (const std::uint64_t key : keys) {
    const std::vector<std::uint8_t> whole = test::bytes_of(rows, BlobKind::Block, key);
    for (int i = 0; i < 60; ++i) {
      std::vector<std::uint8_t> bytes = whole;
      bytes[i % 2 == 0 ? random_() % 40 : random_() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random_() % 8);
      test::forge_row(path_, BlobKind::Block, key, bytes);
      EXPECT_THAT(damaged_places(), Each(testing::AnyOf(StartsWith("block "), StartsWith("metadata"))));
      try {
        sheds(100);
      } catch (const CorruptStore& e) {
        EXPECT_EQ(e.place(), format::place("block", key));
      }
    }
    test::write_bytes(path_, sound_);
  }
}

/// The box of one leaf's clusters is another than that of the same clusters elsewhere.
TEST_F(ClusteredStore, SegmentsOfOtherClustersThanTheirEndsAreFound) {
  std::vector<Leaf> leaves;
  {
    const Store store(path_);
    file_of(store).leaves_of(format::edge_tree(kPart), store.points().bounds(), leaves);
    const std::vector<Segment> segments = file_of(store).read_edges(leaves.front());
    LeafClusters clusters = file_of(store).read_clusters(leaves.front(), extents_of(segments));
    clusters.boxes.front().xmax += 64;
    test::forge_row(path_, BlobKind::Block, leaves.front().key,
                    joined({encode_clusters(leaves.front().cell, extents_of(segments), clusters),
                            encode_lines(leaves.front().cell, segments)}));
  }
  EXPECT_THAT(damaged_places(), testing::ElementsAre(format::place("block", leaves.front().key)));
}

TEST_F(ClusteredStore, ThatSaysItHasNoneIsDamaged) {
  StoreMetadata metadata = Store(path_).metadata();
  metadata.parts[0].has_clusters = false;
  test::forge_metadata(path_, metadata);
  EXPECT_THAT(damaged_places(), Each(StartsWith("block ")));
  EXPECT_FALSE(damaged_places().empty());
}

}  // namespace
}  // namespace itin
