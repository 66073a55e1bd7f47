// `itin tin -o FILE.tif`: the surface as a raster of heights.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <itin/cell_heights.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class SurfaceRaster {
 public:
  void declare(CLI::App& app);
  /// Throws InputError where `output` is a raster without a size of cells, or where there is one without a raster.
  void validate(const std::string& output);
  Document parameters() const;

  /// Returns the cells over a window, as far as there is data. Throws InputError (no ground there: `no_ground`; more
  /// cells than `memory` holds), FileError.
  RasterGrid grid(const StoreMetadata& metadata, const Window& window, const std::string& no_ground,
                  std::optional<std::uint64_t> memory) const;

 private:
  std::string cell_text_, like_;
  std::optional<double> cell_;
};

/// Adds `grid` and `cells` to the document of a raster of heights, and returns their text.
std::string describe(const RasterGrid& grid, const CellHeights& heights, Document& document);

}  // namespace itin::cli
