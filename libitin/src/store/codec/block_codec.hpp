// The bytes of a leaf's points. See libitin/FORMAT.md, "Point block".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

/// Encodes a block. Precondition: 1 <= points.size() <= kMaxBlockPoints, in strictly ascending Morton order, within
/// `cell`; as many sources as points, and as many levels, or none where all points have the leaf's level. Equal input
/// gives equal bytes.
std::vector<std::uint8_t> encode_block(const Cell& cell, std::span<const GridPoint> points,
                                       std::span<const std::uint16_t> sources,
                                       std::span<const std::uint8_t> levels = {});

/// The order of a decoded block's points: strictly ascending by Morton code, as everywhere else, or as they are coded.
enum class BlockOrder : std::uint8_t { kMorton, kAny };

/// Returns, whatever the bytes, a block of `cell` that has no position twice, or throws DecodeError. Points of levels
/// below `finest` are left out; the block may then have none.
Block decode_block(const Cell& cell, std::span<const std::uint8_t> bytes, BlockOrder order = BlockOrder::kMorton,
                   int finest = 0);

/// Returns the block's points at height 0, without sources and levels, in any order. Throws DecodeError for damage in
/// the bytes that it reads.
Block decode_plan(const Cell& cell, std::span<const std::uint8_t> bytes);

/// The number of a block's points, and the widest lattice that has them all; scattered points lie on the grid itself.
struct BlockLattice {
  std::size_t points = 0;
  PostLattice lattice;
};
/// Returns what a block's header tells of its points, from the header alone. Throws DecodeError for damage in
/// the header.
BlockLattice decode_lattice(const Cell& cell, std::span<const std::uint8_t> bytes);

/// Returns the heights of a block that is a full lattice; nothing for other blocks. Throws DecodeError for damage in
/// the bytes that it reads.
std::optional<PostHeights> decode_posts(const Cell& cell, std::span<const std::uint8_t> bytes);

inline constexpr std::uint32_t kMaxBlockPoints = 4096;

}  // namespace itin
