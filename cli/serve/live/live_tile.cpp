#include "serve/live/live_tile.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <variant>

#include <itin/error.hpp>

namespace itin::cli {

namespace {

static_assert(std::endian::native == std::endian::little, "tiles are little-endian");

constexpr std::size_t kAlignment = 4;
constexpr std::size_t kTileHeader = 32;

struct TileHeader {
  std::uint32_t bytes = 0, seq = 0;
  std::uint16_t id = 0;
  std::uint8_t step = 0, kind = 0;
  std::int32_t column = 0, row = 0;
  std::uint32_t columns = 0, rows = 0, zero = 0;
};
static_assert(sizeof(TileHeader) == kTileHeader && std::is_trivially_copyable_v<TileHeader>);

std::size_t padded(std::size_t bytes) {
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

/// Appends every cell's value, then zeros up to a multiple of four bytes.
template <class Value>
void append_cells(const std::vector<Value>& values, const RasterGrid& grid, const viewshed::DecidedCells& cells,
                  std::string& bytes) {
  const std::size_t begin = bytes.size(), count = static_cast<std::size_t>(cells.columns * cells.rows);
  bytes.resize(begin + padded(count * sizeof(Value)));
  char* at = bytes.data() + begin;
  for (std::int64_t row = 0; row < cells.rows; ++row) {
    for (std::int64_t column = 0; column < cells.columns; ++column, at += sizeof(Value))
      std::memcpy(at, &values[grid.index(cells.at(column, row))], sizeof(Value));
  }
}

/// Calls visit(values) with the values that tiles have of a mode, if any.
void with_values(const viewshed::ModeValues& values, const auto& visit) {
  if (const auto* of = std::get_if<viewshed::Counts>(&values)) visit(of->count);
  if (const auto* of = std::get_if<viewshed::Angles>(&values)) visit(of->angle_deg);
  if (const auto* of = std::get_if<viewshed::LeastHeights>(&values)) visit(of->height_m);
  if (const auto* of = std::get_if<viewshed::Probabilities>(&values)) visit(of->probability);
  if (const auto* of = std::get_if<viewshed::Losses>(&values)) visit(of->diffraction_db);
  if (const auto* of = std::get_if<viewshed::Levels>(&values)) visit(of->level_dbm);
}

std::int32_t cell_number(double number) {
  if (std::abs(number) > std::numeric_limits<std::int32_t>::max())
    throw InputError("--cell: the cells are too small to be counted; give larger ones");
  return static_cast<std::int32_t>(std::llround(number));
}

}  // namespace

Document numbered(const char* type, const LiveNumber& number) {
  return {{"type", type}, {"id", number.id}, {"seq", number.seq}};
}

CellOrigin cell_origin(const RasterGrid& grid) {
  const Point2 corner = grid.north_west();
  return {cell_number(corner.x / grid.cell_width()), cell_number(-corner.y / grid.cell_height())};
}

std::uint8_t value_kind(const viewshed::Result& result) {
  std::uint8_t kind = 0;
  with_values(result.values, [&](const auto& values) { kind = sizeof(values.front()) == sizeof(float) ? 2 : 1; });
  return kind;
}

void add_tile(const LiveNumber& number, const viewshed::Result& result, const viewshed::DecidedCells& cells,
              std::string& bytes) {
  const CellOrigin origin = cell_origin(result.grid);
  const std::size_t begin = bytes.size();
  TileHeader header{.seq = number.seq,
                    .id = number.id,
                    .step = static_cast<std::uint8_t>(cells.step),
                    .kind = value_kind(result),
                    .column = origin.column + static_cast<std::int32_t>(cells.north_west.column),
                    .row = origin.row + static_cast<std::int32_t>(cells.north_west.row),
                    .columns = static_cast<std::uint32_t>(cells.columns),
                    .rows = static_cast<std::uint32_t>(cells.rows)};
  bytes.resize(begin + sizeof header);
  append_cells(result.visible, result.grid, cells, bytes);
  with_values(result.values, [&](const auto& values) { append_cells(values, result.grid, cells, bytes); });
  header.bytes = static_cast<std::uint32_t>(bytes.size() - begin);
  std::memcpy(bytes.data() + begin, &header, sizeof header);
}

}  // namespace itin::cli
