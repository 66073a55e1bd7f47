#include "tin/surface_raster.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <viewshed/documents.hpp>

#include "output/output_path.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

/// Throws InputError where the raster does not fit beside what is read for it.
void require_memory_for(const RasterGrid& grid, std::optional<std::uint64_t> memory) {
  constexpr std::uint64_t kBytesOfCell = 8;  // at the peak, measured: heights, overviews, and what GDAL has of them
  constexpr std::uint64_t kReading = std::uint64_t{80} << 20;
  const std::uint64_t needed = grid.cell_count() * kBytesOfCell + kReading;
  if (!memory || needed <= *memory) return;
  throw InputError(
      fmt::format("--memory: a raster of {} takes some {}M; give as much, larger cells, or a smaller window",
                  counted(grid.cell_count(), "cell"), (needed >> 20) + 1));
}

}  // namespace

void SurfaceRaster::declare(CLI::App& app) {
  begin_group(app, kOutputs);
  app.add_option("--cell", cell_text_, "With -o FILE.tif: the size of the raster's cells")->type_name("METRES");
  reads(app.add_option("--like", like_, "With -o FILE.tif: take the cells of this raster")->type_name("FILE"));
}

void SurfaceRaster::validate(const std::string& output) {
  const bool given = !cell_text_.empty() || !like_.empty();
  if (!cell_text_.empty() && !like_.empty()) throw InputError("--cell and --like exclude each other");
  if (!cell_text_.empty()) cell_ = parse_number("--cell", cell_text_, Range::kPositive);
  if (given && !names_geotiff(output))
    throw InputError(fmt::format("{}: only a raster has cells; give --output FILE.tif with it",
                                 cell_text_.empty() ? "--like" : "--cell"));
  if (!given && names_geotiff(output))
    throw InputError(fmt::format("--output '{}': a raster needs cells; give --cell METRES or --like FILE", output));
}

Document SurfaceRaster::parameters() const {
  Document parameters = Document::object();
  if (cell_) parameters["cell_m"] = *cell_;
  if (!like_.empty()) parameters["like"] = like_;
  return parameters;
}

RasterGrid SurfaceRaster::grid(const StoreMetadata& metadata, const Window& window, const std::string& no_ground,
                               std::optional<std::uint64_t> memory) const {
  const Box data = metadata.grid.box(metadata.bounds);
  const Box box = window.is_all() ? data : intersection(window.bounds(), data);
  if (box.empty()) throw InputError(no_ground);
  const RasterGrid grid = like_.empty() ? RasterGrid::aligned(box, *cell_) : raster_grid_like(like_, metadata.crs_wkt);
  require_memory_for(grid, memory);
  return grid;
}

std::string describe(const RasterGrid& grid, const CellHeights& heights, Document& document) {
  const auto ground = static_cast<std::uint64_t>(
      std::count_if(heights.metres.begin(), heights.metres.end(), [](float height) { return !std::isnan(height); }));
  document["grid"] = viewshed::grid_document(grid);
  document["cells"] = {{"ground", ground}, {"no_data", grid.cell_count() - ground}};
  return fmt::format("{} x {} cells of {:g} m, {} on ground", grid.columns(), grid.rows(), grid.cell_width(),
                     counted(ground, "cell"));
}

}  // namespace itin::cli
