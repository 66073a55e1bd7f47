// Cells that were decided, as the bytes that clients read; PROTOCOL.md has their layout.
#pragma once

#include <cstdint>
#include <string>

#include <itin/document.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::cli {

/// What an answer repeats, so that the client knows what it answers.
struct LiveNumber {
  std::uint16_t id = 0;   ///< the number of a view or a line
  std::uint32_t seq = 0;  ///< the number of the message
};
/// Begins an answer of a type.
Document numbered(const char* type, const LiveNumber& number);

/// The place of a grid's north-west cell in the grid of all cells of that size, whose edges are multiples of the size
/// and whose rows run southwards from northing 0. Throws InputError where its numbers are too large.
struct CellOrigin {
  std::int32_t column = 0, row = 0;
};
CellOrigin cell_origin(const RasterGrid& grid);

/// The type of the values that a mode has besides verdicts: 0 none, 1 uint16, 2 float32.
std::uint8_t value_kind(const viewshed::Result& result);

/// Appends a tile.
void add_tile(const LiveNumber& number, const viewshed::Result& result, const viewshed::DecidedCells& cells,
              std::string& bytes);

}  // namespace itin::cli
