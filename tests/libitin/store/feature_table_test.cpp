// Records of features, and which features segments are of, as blocks.
#include "store/feature_table.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "store/codec/byte_stream.hpp"
#include "store/codec/zstd_frame.hpp"
#include "store/segments/block_preface.hpp"
#include "store/segments/segment_features.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

AttributeValue random_value(std::mt19937& random) {
  switch (random() % 5) {
    case 0:
      return {};
    case 1:
      return std::ldexp(static_cast<double>(random()) - 2e9, static_cast<int>(random() % 40) - 20);
    case 2:
      return static_cast<std::int64_t>(std::uint64_t{random()} << 32 | random());
    case 3:
      return std::numeric_limits<std::int64_t>::min();
    default:
      return std::string(random() % 30, static_cast<char>(random() % 256));
  }
}

TEST(FeatureTable, BlocksGiveBackTheirRecords) {
  std::mt19937 random(test::seed());
  for (const std::size_t count : {1u, 7u, 256u}) {
    std::vector<FeatureRecord> records(count);
    for (FeatureRecord& record : records) {
      record.id = std::to_string(random());
      if (random() % 2 == 0) record.name = "Y Garth \xc5\xb4";
      for (std::size_t i = random() % 6; i > 0; --i) record.values.push_back(random_value(random));
    }
    const std::vector<std::uint8_t> bytes = encode_features(records);
    EXPECT_EQ(decode_features(bytes, 5), records);
  }
}

TEST(FeatureTable, RefusesBlocksThatAreNone) {
  const std::vector<FeatureRecord> records(3, {"12", "a hedge", {1.5, std::int64_t{-3}, std::string("beech")}});
  const std::vector<std::uint8_t> bytes = encode_features(records);
  EXPECT_THROW(decode_features(bytes, 2), DecodeError);
  std::vector<std::uint8_t> content = decompress(bytes, 1000);
  const std::size_t of_one = content.size() / 3;
  for (std::size_t cut = 1; cut < content.size(); ++cut) {
    if (cut % of_one == 0) continue;
    const std::vector<std::uint8_t> part(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(cut));
    EXPECT_THROW(decode_features(compress(part), 3), DecodeError) << cut;
  }
  content.resize(of_one);
  EXPECT_EQ(decode_features(compress(content), 3).size(), 1U);
  EXPECT_THROW(decode_features(encode_features({}), 3), DecodeError);
  EXPECT_THROW(decode_features(encode_features(std::vector<FeatureRecord>(257)), 3), DecodeError);
}

TEST(SegmentFeatures, BlocksGiveBackTheFeaturesOfTheirSegmentsAlone) {
  std::mt19937 random(test::seed());
  for (int round = 0; round < 50; ++round) {
    std::vector<Segment> segments;
    for (int i = 0; i < 40; ++i) segments.push_back({i, static_cast<int>(random() % 9), i + 3, 7, 2});
    std::vector<SegmentFeature> features, expected;
    for (const Segment& s : segments)
      for (std::size_t i = random() % 3; i > 0; --i)
        features.push_back(
            {s, static_cast<std::uint32_t>(random() % 2 == 0 ? random() % 5 : kNoFeature - 1 - random() % 3)});
    for (int i = 0; i < 9; ++i) features.push_back({{500 + i, 0, 600, 7, 2}, 3});
    std::sort(features.begin(), features.end());
    features.erase(std::unique(features.begin(), features.end()), features.end());
    std::copy_if(features.begin(), features.end(), std::back_inserter(expected),
                 [](const SegmentFeature& f) { return f.segment.ax < 500; });
    const std::vector<std::uint8_t> bytes = encode_segment_features(segments, features);
    EXPECT_EQ(decode_segment_features(segments, bytes), expected);
    EXPECT_THROW(decode_segment_features(std::span(segments).first(39), bytes), DecodeError);
    const std::vector<std::uint8_t> lines{1, 2, 3}, block = joined({bytes, lines});
    EXPECT_TRUE(std::ranges::equal(split(block).preface, bytes));
    EXPECT_TRUE(std::ranges::equal(split(block).items, lines));
    EXPECT_THROW(split(std::span(block).first(bytes.size())), DecodeError);
  }
}

}  // namespace
}  // namespace itin
