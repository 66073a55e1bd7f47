// Damage to what a store keeps of features: found and named, or in bytes nobody uses, with the answer unchanged.
#include <algorithm>
#include <gmock/gmock.h>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>

#include "libitin/store/random_points.hpp"
#include "store/feature_table.hpp"
#include "store/segments/segment_features.hpp"
#include "store/set_aside.hpp"
#include "store/store_file.hpp"
#include "store/store_writer.hpp"
#include "support/forged_rows.hpp"
#include "support/row_bytes.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using testing::Each;
using testing::StartsWith;

constexpr std::uint16_t kLanes = 1;
constexpr std::uint32_t kLaneCount = 300;  // two blocks of records

/// All that a store says of features.
struct Told {
  std::vector<FeatureRecord> records;
  std::vector<SegmentFeature> segments;
  std::vector<ImportedSegment> imported;
  friend bool operator==(const Told&, const Told&) = default;
};

Told read_told(const std::string& path) {
  const Store store(path);
  const StoreFile& file = file_of(store);
  Told told{stored_features(store, kLanes).records, {}, {}};
  file.segment_features(kLanes, store.points().bounds(), told.segments);
  for (std::uint32_t i = 0; i < set_aside_list(file.rows()).blocks_of(kLanes); ++i)
    for (const ImportedSegment& s : set_aside_lines(file.rows(), kLanes, i).imported) told.imported.push_back(s);
  return told;
}

class FeatureDamage : public testing::Test {
 protected:
  void SetUp() override {
    const test::GivenStore given = test::random_store(random_(), 600, 2);
    std::vector<Segment> lanes;
    std::vector<SegmentFeature> features;
    SetAsideLines aside;
    for (std::uint32_t i = 0; i < kLaneCount; ++i) {
      const GridPoint &a = given.leaves[0].points[i % given.leaves[0].points.size()], b{a.x + 70, a.y + 3, a.z};
      lanes.push_back({a.x, a.y, b.x, b.y, kLanes});
      features.push_back({lanes.back(), i});
      if (i % 7 == 0) features.push_back({lanes.back(), kLaneCount - 1});
      aside.imported.push_back({a, b, static_cast<std::uint16_t>(i % 3), i});
    }
    std::sort(features.begin(), features.end());
    features.erase(std::unique(features.begin(), features.end()), features.end());
    std::sort(lanes.begin(), lanes.end());
    lanes.erase(std::unique(lanes.begin(), lanes.end()), lanes.end());
    std::sort(aside.imported.begin(), aside.imported.end());
    ThemeFeatures told{{{"width", AttributeType::number}, {"lanes", AttributeType::whole}}, {}};
    for (std::uint32_t i = 0; i < kLaneCount; ++i)
      told.records.push_back({std::to_string(random_() % 100000), "Lôn Goed", {i / 8.0, std::int64_t{2}}});
    std::vector<ThemeInfo> themes{{"lanes", ThemeKind::Roads, kLaneCount, 0, lanes.size()}};
    StoreWriter writer(path_, "", given.grid, given.tolerances);
    given.add_leaves(writer);
    writer.add_segments(lanes, features);
    writer.set_aside(kLanes, aside);
    themes[0].fields = told.fields;
    themes[0].feature_blocks = writer.add_features(kLanes, told.records);
    writer.commit(std::vector<SourceInfo>(3), themes);
    sound_ = test::read_bytes(path_);
    expected_ = read_told(path_);
  }

  std::vector<Damage> damage() {
    NoProgress progress;
    return check(Store(path_), progress);
  }
  std::vector<std::string> damaged_places() {
    std::vector<std::string> places;
    for (const Damage& d : damage()) places.push_back(d.place);
    return places;
  }
  /// The keys of blocks in this tree.
  std::vector<std::uint64_t> keys(int tree) const {
    std::vector<std::uint64_t> keys;
    StoreRows(path_).for_each_key(BlobKind::Block, [&](std::uint64_t key) {
      if (format::tree_of(key) == tree) keys.push_back(key);
    });
    return keys;
  }
  std::vector<std::uint8_t> bytes_of(std::uint64_t key) const {
    return test::bytes_of(StoreRows(path_), BlobKind::Block, key);
  }
  void forge(std::uint64_t key, const std::vector<std::uint8_t>& bytes) {
    test::forge_row(path_, BlobKind::Block, key, bytes);
  }
  /// Calls visit(key, bytes) for a block of each kind that tells of features, and mends it.
  template <class Visit>
  void for_each_kind(const Visit& visit) {
    for (const int tree : {format::kFeatureTree, format::edge_tree(kLanes), format::kSetAsideTree}) {
      SCOPED_TRACE(tree);
      const std::uint64_t key = keys(tree).front();
      const std::vector<std::uint8_t> whole = bytes_of(key);
      visit(key, whole);
      forge(key, whole);
    }
  }
  /// Only this block is found damaged, and what reads it says so.
  void expect_found(std::uint64_t key, const std::string& trace) {
    const std::string place = format::place("block", key);
    EXPECT_THAT(damaged_places(), testing::ElementsAre(place)) << trace;
    try {
      read_told(path_);
      ADD_FAILURE() << trace;
    } catch (const CorruptStore& e) {
      EXPECT_THAT(e.what(), StartsWith(path_ + ": " + place + ": ")) << trace;
    }
  }

  std::mt19937 random_{test::seed()};
  const test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("lanes.itin");
  std::string sound_;
  Told expected_;
};

TEST_F(FeatureDamage, IsNotThereInASoundStore) {
  EXPECT_TRUE(damage().empty());
  EXPECT_EQ(expected_.records.size(), kLaneCount);
  EXPECT_EQ(keys(format::kFeatureTree).size(), 2U);
  EXPECT_FALSE(expected_.segments.empty());
  EXPECT_EQ(expected_.imported.size(), kLaneCount);
}

TEST_F(FeatureDamage, OfAnyByte) {
  for (int i = 0; i < 600; ++i) {
    const std::size_t place = random_() % sound_.size();
    std::string bytes = sound_;
    bytes[place] = static_cast<char>(bytes[place] ^ static_cast<char>(1 + random_() % 255));
    test::write_bytes(path_, bytes);
    try {
      EXPECT_EQ(read_told(path_) == expected_, true) << place;
    } catch (const FileError& e) {
      EXPECT_THAT(e.what(), StartsWith(path_ + ": ")) << place;
    }
  }
}

TEST_F(FeatureDamage, OfBlocksThatEndEarlyOrLate) {
  for_each_kind([&](std::uint64_t key, const std::vector<std::uint8_t>& whole) {
    for (int i = 0; i < 8; ++i) {
      std::vector<std::uint8_t> bytes = whole;
      bytes.resize(i == 0 ? 0 : i == 1 ? whole.size() + 1 : random_() % whole.size());
      forge(key, bytes);
      expect_found(key, std::to_string(bytes.size()) + " bytes of " + std::to_string(whole.size()));
    }
  });
}

TEST_F(FeatureDamage, OfBitsUnderAFittingSeal) {
  for_each_kind([&](std::uint64_t key, const std::vector<std::uint8_t>& whole) {
    for (int i = 0; i < 60; ++i) {
      std::vector<std::uint8_t> bytes = whole;
      bytes[random_() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random_() % 8);
      forge(key, bytes);
      // A change may give another store that is sound; what may not be is a crash, or an error that names no place.
      EXPECT_THAT(damaged_places(), Each(testing::AnyOf(StartsWith("block "), StartsWith("metadata"))));
      try {
        read_told(path_);
      } catch (const CorruptStore& e) {
        EXPECT_EQ(e.place(), format::place("block", key));
      }
    }
  });
}

TEST_F(FeatureDamage, OfTheNumberOfRecords) {
  const std::vector<std::uint64_t> blocks = keys(format::kFeatureTree);
  const std::vector<FeatureRecord>& all = expected_.records;
  forge(blocks[0], encode_features(std::span(all).first(255)));
  expect_found(blocks[0], "a block before the last has less than 256");
  forge(blocks[0], encode_features(std::span(all).first(256)));
  // The last feature has no record: what names it is damaged, at least the first lane.
  forge(blocks[1], encode_features(std::span(all).subspan(256, 43)));
  const std::vector<Damage> found = damage();
  EXPECT_GE(found.size(), 2U);
  for (const Damage& d : found) EXPECT_EQ(d.what, "names a feature that the store does not have") << d.place;
  FeatureRecord more = all[299];
  more.values.emplace_back(std::string("clay"));
  std::vector<FeatureRecord> last(all.begin() + 256, all.end());
  last.back() = more;
  forge(blocks[1], encode_features(last));
  expect_found(blocks[1], "a record has more values than the theme has fields");
}

TEST_F(FeatureDamage, OfMissingAndStrayBlocks) {
  const std::vector<std::uint64_t> blocks = keys(format::kFeatureTree);
  test::execute_sql(path_, "DELETE FROM block WHERE key = ?", {static_cast<std::int64_t>(blocks[1])});
  expect_found(blocks[1], "a block is missing");
  test::write_bytes(path_, sound_);
  forge(blocks[1] + 1, bytes_of(blocks[1]));
  EXPECT_THAT(damaged_places(), testing::ElementsAre(format::place("block", blocks[1] + 1)));
}

TEST_F(FeatureDamage, OfTheMetadata) {
  StoreMetadata metadata = Store(path_).metadata();
  metadata.themes[0].segments_have_features = false;
  test::forge_metadata(path_, metadata);
  EXPECT_THAT(damaged_places(), Each(StartsWith("block 1025/")));
  EXPECT_FALSE(damaged_places().empty());
  test::write_bytes(path_, sound_);
  metadata = Store(path_).metadata();
  metadata.themes[0].feature_blocks = 1;
  test::forge_metadata(path_, metadata);
  EXPECT_THAT(damaged_places(), Each(StartsWith("block ")));
  EXPECT_FALSE(damaged_places().empty());
  test::write_bytes(path_, sound_);
  metadata = Store(path_).metadata();
  metadata.themes[0].fields.clear();
  test::forge_metadata(path_, metadata);
  EXPECT_EQ(damaged_places().size(), 2U);
}

}  // namespace
}  // namespace itin
