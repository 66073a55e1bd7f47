// What clients have to know of the server and its store before they ask anything else.
#pragma once

#include <itin/document.hpp>

#include "serve/ground/served_store.hpp"
#include "serve/ground/tile_grid.hpp"

namespace itin::cli {

/// The document of `itin info`, and what PROTOCOL.md adds to it.
Document served_info(const ServedStore& served, const TileGrid& grid);

}  // namespace itin::cli
