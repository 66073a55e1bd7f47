#include "store/segments/segment_features.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include <itin/sort_unique.hpp>

#include "store/codec/zstd_frame.hpp"
#include "store/segments/content_stream.hpp"

namespace itin {

namespace {

constexpr std::size_t kMostSegmentFeatureBytes = std::size_t{1} << 28;
constexpr std::uint64_t kMostFeature = kNoFeature - 1;

using Features = std::vector<std::uint32_t>;

/// Guesses the features of a segment: those of the latest earlier segment that it shares an end with.
class LikelyFeatures {
 public:
  const Features& of(const Segment& s) const {
    const Told* latest = &none_;
    for (const End& end : {End{s.ax, s.ay}, End{s.bx, s.by}})
      if (const auto told = told_.find(end); told != told_.end() && told->second.number > latest->number)
        latest = &told->second;
    return latest->features;
  }
  void tell(const Segment& s, const Features& features) {
    ++count_;
    for (const End& end : {End{s.ax, s.ay}, End{s.bx, s.by}}) told_[end] = {count_, features};
  }

 private:
  using End = std::pair<std::int32_t, std::int32_t>;
  struct Told {
    std::size_t number = 0;
    Features features;
  };
  std::size_t count_ = 0;
  Told none_;
  std::map<End, Told> told_;
};

}  // namespace

std::span<const SegmentFeature> of_segment(std::span<const SegmentFeature> features, const Segment& s) {
  const auto first = std::lower_bound(features.begin(), features.end(), SegmentFeature{s, 0});
  const auto last = std::find_if(first, features.end(), [&](const SegmentFeature& f) { return f.segment != s; });
  return {first, last};
}

std::vector<std::uint8_t> encode_segment_features(std::span<const Segment> segments,
                                                  std::span<const SegmentFeature> features) {
  std::vector<Features> own;
  Features present;
  for (const Segment& s : segments) {
    own.emplace_back();
    for (const SegmentFeature& f : of_segment(features, s)) own.back().push_back(f.feature);
    present.insert(present.end(), own.back().begin(), own.back().end());
  }
  sort_unique(present);
  ContentWriter out;
  out.whole(present.size());
  for (std::size_t i = 0; i < present.size(); ++i) out.whole(i == 0 ? present[0] : present[i] - present[i - 1] - 1);
  LikelyFeatures likely;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const bool as_likely = own[i] == likely.of(segments[i]);
    likely.tell(segments[i], own[i]);
    out.whole(as_likely ? 0 : own[i].size() + 1);
    if (as_likely) continue;
    for (const std::uint32_t feature : own[i])
      out.whole(
          static_cast<std::uint64_t>(std::lower_bound(present.begin(), present.end(), feature) - present.begin()));
  }
  return compress(out.bytes());
}

std::vector<SegmentFeature> decode_segment_features(std::span<const Segment> segments,
                                                    std::span<const std::uint8_t> bytes) {
  const std::vector<std::uint8_t> content = decompress(bytes, kMostSegmentFeatureBytes);
  ContentReader in(content);
  Features present(in.count());
  std::uint64_t next = 0;
  for (std::uint32_t& feature : present) {
    if (next > kMostFeature) throw DecodeError("a feature is out of range");
    feature = static_cast<std::uint32_t>(next + in.whole(kMostFeature - next));
    next = std::uint64_t{feature} + 1;
  }
  LikelyFeatures likely;
  std::vector<SegmentFeature> features;
  for (const Segment& s : segments) {
    const std::uint64_t told = in.whole(present.size() + 1);
    Features own = told == 0 ? likely.of(s) : Features(told - 1);
    if (told > 0) {
      for (std::uint32_t& feature : own) {
        const std::uint64_t i = in.whole(kMostFeature);
        if (i >= present.size()) throw DecodeError("a segment is of no feature");
        feature = present[i];
      }
    }
    if (std::adjacent_find(own.begin(), own.end(), std::greater_equal<>()) != own.end())
      throw DecodeError("features of a segment are out of order");
    for (const std::uint32_t feature : own) features.push_back({s, feature});
    likely.tell(s, own);
  }
  if (!in.at_end()) throw DecodeError("has too many bytes");
  return features;
}

}  // namespace itin
