// The PMR quadtree of a theme's segments: each leaf lists every segment that crosses it, with both ends.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

/// The most segments in a leaf: a leaf with more is split, unless its side is 2^kMinEdgeLeafLog2Side.
inline constexpr std::size_t kEdgeLeafCapacity = 256;
inline constexpr int kMinEdgeLeafLog2Side = 8;

/// Tells whether the segment meets the cell, its border included. A cell reaches up to its neighbours' first positions,
/// so that every part of a segment, also between grid positions, is in some cell.
bool crosses(const Segment& segment, const Cell& cell);

/// Calls visit(cell, segments) for every non-empty leaf along the curve, its segments in ascending order, each once.
/// The tree depends on the set of segments alone. Needs about twice the memory of the segments.
void for_each_edge_leaf(std::vector<Segment> segments,
                        const std::function<void(const Cell&, const std::vector<Segment>&)>& visit);

/// Does what for_each_edge_leaf() does, but stops when visit(cell, segments) returns false.
void visit_edge_leaves(std::vector<Segment> segments,
                       const std::function<bool(const Cell&, const std::vector<Segment>&)>& visit);

/// Encodes a block of the coverage outline; blocks of themes are in line_codec.hpp. Precondition: in ascending order.
std::vector<std::uint8_t> encode_outline(const Cell& cell, const std::vector<Segment>& segments);
/// Decodes a block of the coverage outline. Throws DecodeError unless the bytes are `count` segments in ascending
/// order, each crossing the cell.
std::vector<Segment> decode_outline(const Cell& cell, std::size_t count, std::span<const std::uint8_t> bytes);

}  // namespace itin
