// The bytes of a leaf's points. See libitin/FORMAT.md, "Point block".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cell.hpp"
#include "store/point_index.hpp"

namespace itin {

/// Precondition: 1 <= points.size() <= kMaxBlockPoints, in strictly ascending Morton order, within `cell`; as many
/// sources as points. Equal input gives equal bytes.
std::vector<std::uint8_t> encode_block(const Cell& cell, std::span<const GridPoint> points,
                                       std::span<const std::uint16_t> sources);

/// The order of a decoded block's points: strictly ascending by Morton code, as everywhere, or as they are coded.
enum class BlockOrder : std::uint8_t { kMorton, kAny };

/// Whatever the bytes, returns a block of `cell`, no position twice, or throws DecodeError. A point of a full lattice
/// takes about 20 ns and others 35, and 13 more where they are sorted.
Block decode_block(const Cell& cell, std::span<const std::uint8_t> bytes, BlockOrder order = BlockOrder::kMorton);

/// Its points at height 0, without sources, in any order. Throws DecodeError as far as that needs them. About 6 ns a
/// point.
Block decode_plan(const Cell& cell, std::span<const std::uint8_t> bytes);

/// Its header alone: what all of its points lie on. Throws DecodeError as far as that needs it.
BlockLattice decode_lattice(const Cell& cell, std::span<const std::uint8_t> bytes);

inline constexpr std::uint32_t kMaxBlockPoints = 4096;

}  // namespace itin
