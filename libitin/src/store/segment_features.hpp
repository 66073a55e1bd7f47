// Which features the segments of a theme's lines are of. See libitin/FORMAT.md, "Features of segments".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "store/point_index.hpp"

namespace itin {

/// In place of a feature's number: it is not known.
inline constexpr std::uint32_t kNoFeature = 0xffffffff;

struct SegmentFeature {
  Segment segment;
  std::uint32_t feature = 0;  ///< its number from 0, of its theme in the order of import
  friend auto operator<=>(const SegmentFeature&, const SegmentFeature&) = default;
};

/// The features of one segment. `features` ascending.
std::span<const SegmentFeature> of_segment(std::span<const SegmentFeature> features, const Segment& segment);

/// `segments` as in encode_lines(); `features` ascending, of these and perhaps others.
std::vector<std::uint8_t> encode_segment_features(std::span<const Segment> segments,
                                                  std::span<const SegmentFeature> features);
/// Ascending. Throws DecodeError unless the bytes tell of just these segments.
std::vector<SegmentFeature> decode_segment_features(std::span<const Segment> segments,
                                                    std::span<const std::uint8_t> bytes);

}  // namespace itin
