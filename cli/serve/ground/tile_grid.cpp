#include "serve/ground/tile_grid.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "options/half_posting.hpp"

namespace itin::cli {

namespace {

/// The spacing that is assumed of data by need.
constexpr double kAssumedSpacing = 10;

double power_of_two(double exponent) {
  return std::exp2(exponent);
}

}  // namespace

std::optional<TileAddress> tile_address(const std::string& text) {
  TileAddress address;
  const char *at = text.data(), *const end = at + text.size();
  for (int* number : {&address.zoom, &address.column, &address.row}) {
    if (number != &address.zoom && (at == end || *at++ != '/')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, *number);
    if (error != std::errc() || *number < 0) return std::nullopt;
    at = next;
  }
  return at == end ? std::optional(address) : std::nullopt;
}

std::optional<Box> TileGrid::box(const TileAddress& tile) const {
  if (static_cast<std::size_t>(tile.zoom) >= resolutions.size()) return std::nullopt;
  const double side = kTilePixels * resolutions[static_cast<std::size_t>(tile.zoom)];
  const double west = origin.x + tile.column * side, north = origin.y - tile.row * side;
  const Box box{west, north - side, west + side, north};
  return box.meets(data) ? std::optional(box) : std::nullopt;
}

TileGrid tile_grid(const StoreMetadata& metadata) {
  TileGrid grid;
  grid.data = metadata.grid.box(metadata.bounds);
  const double finest = power_of_two(std::floor(std::log2(least_spacing(metadata).value_or(kAssumedSpacing) / 2)));
  const double widest = std::max({grid.data.width(), grid.data.height(), finest});
  double coarsest = std::max(finest, power_of_two(std::ceil(std::log2(widest / kTilePixels))));
  const double side = kTilePixels * coarsest;
  grid.origin = {std::floor(grid.data.xmin / side) * side, std::ceil(grid.data.ymax / side) * side};
  for (; coarsest >= finest; coarsest /= 2) grid.resolutions.push_back(coarsest);
  return grid;
}

}  // namespace itin::cli
