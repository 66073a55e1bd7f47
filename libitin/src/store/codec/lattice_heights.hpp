// The heights of a full lattice, so written that a reader waits for none of them. See libitin/FORMAT.md, "Full
// lattices".
//
// A height is written as its residual: the height less those of its neighbours to the west and to the south, plus that
// of the one between them. Residuals are in groups of eight with one width of bits, so that each group takes whole
// bytes. Reading a row is a running sum, added to the row before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "store/codec/byte_stream.hpp"

namespace itin {

/// Writes heights, row by row. Preconditions: the first one is 0, and all are within 2^32 of it; columns >= 1, and the
/// rows are whole.
void put_lattice_heights(std::vector<std::uint8_t>& out, std::span<const std::int64_t> heights, std::size_t columns);

/// Reads what put_lattice_heights() wrote, `heights.size()` heights. Throws DecodeError for bytes that it would not
/// write. Whatever the bytes, heights are below 2^60.
void read_lattice_heights(ByteReader& in, std::span<std::int64_t> heights, std::size_t columns);

}  // namespace itin
