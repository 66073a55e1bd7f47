// Blocks of a theme's segments: each end once, and which ends are joined. FORMAT.md describes the bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

/// Encodes segments. Precondition: in ascending order, different, all of one theme, at least one, none without length;
/// segments whose finest level is 0 have no reach.
std::vector<std::uint8_t> encode_lines(const Cell& cell, const std::vector<Segment>& segments);
/// Decodes segments. Throws DecodeError unless the bytes are `count` segments in ascending order, each crossing the
/// cell.
std::vector<Segment> decode_lines(const Cell& cell, std::uint16_t theme, std::size_t count,
                                  std::span<const std::uint8_t> bytes);

}  // namespace itin
