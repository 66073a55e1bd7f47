// The features that the segments of a theme's lines belong to. See libitin/FORMAT.md, "Features of segments".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "store/codec/point_index.hpp"

namespace itin {

/// Stands for a feature's number that is not known.
inline constexpr std::uint32_t kNoFeature = 0xffffffff;

struct SegmentFeature {
  Segment segment;
  std::uint32_t feature = 0;  ///< the feature's number in its theme, from 0, in the order of its sources
  friend auto operator<=>(const SegmentFeature&, const SegmentFeature&) = default;
};

/// Returns the features of one segment. Precondition: `features` are ascending.
std::span<const SegmentFeature> of_segment(std::span<const SegmentFeature> features, const Segment& segment);

/// Encodes features. `segments` are as in encode_lines(); `features` are ascending, of these segments and perhaps
/// others.
std::vector<std::uint8_t> encode_segment_features(std::span<const Segment> segments,
                                                  std::span<const SegmentFeature> features);
/// Returns the features, ascending. Throws DecodeError unless the bytes tell of just these segments.
std::vector<SegmentFeature> decode_segment_features(std::span<const Segment> segments,
                                                    std::span<const std::uint8_t> bytes);

}  // namespace itin
