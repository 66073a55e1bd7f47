#include "serve/served_info.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "options/half_posting.hpp"
#include "serve/calls/job_call.hpp"
#include "serve/ground/ground_tiles.hpp"
#include "serve/http/page_answer.hpp"
#include "serve/live/live_view.hpp"
#include "store/info_document.hpp"

namespace itin::cli {

namespace {

Document tiles_document(const StoreMetadata& metadata, const TileGrid& grid) {
  return {{"origin", {grid.origin.x, grid.origin.y}},
          {"size", kTilePixels},
          {"border", kTileBorder},
          {"resolutions", grid.resolutions},
          {"themes", outlined_themes(metadata)}};
}

}  // namespace

Document served_info(const ServedStore& served, const TileGrid& grid) {
  const StoreMetadata& metadata = served.metadata();
  const std::optional<double> spacing = least_spacing(metadata);
  Document info{{"itin", ITIN_VERSION},
                {"version", fmt::format("{}-{:x}", served.version(), page_version())},
                {"store", std::filesystem::path(served.store().path()).filename().string()},
                {"crs_wkt", metadata.crs_wkt}};
  info.update(info_document(served.store(), StatedHeights(metadata)));
  info["data_spacing_m"] = number_or_null(spacing);
  info["memory_bytes"] = served.memory_bytes();
  info["most_cells"] = served.most_cells();
  info["modes"] = live_modes();
  info["verbs"] = job_verbs();
  info["tiles"] = tiles_document(metadata, grid);
  return info;
}

}  // namespace itin::cli
