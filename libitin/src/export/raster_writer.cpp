#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <tuple>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/raster.hpp>

#include "export/pending_file.hpp"
#include "gdal/drivers.hpp"
#include "gdal/memory_raster.hpp"
#include "gdal/quiet_gdal.hpp"
#include "gdal/write_failure.hpp"

namespace itin {

namespace {

constexpr int kTileSide = 512;
/// The most bytes of a tile, which holds all bands. GDAL keeps some tiles at a time: with many bands they are smaller.
constexpr std::size_t kMostTileBytes = std::size_t{64} << 20;
constexpr int kLeastTileSide = 16;

int tile_side(std::size_t bytes_per_cell) {
  int side = kTileSide;
  while (side > kLeastTileSide &&
         static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * bytes_per_cell > kMostTileBytes)
    side /= 2;
  return side;
}

template <class T>
struct Level {
  std::vector<T> values;
  std::int64_t columns = 0;
  std::int64_t rows = 0;
};

template <class T>
T most_frequent(const std::array<T, 4>& v) {
  // Among values that occur equally often the first one wins.
  if (v[0] == v[1] || v[0] == v[2] || v[0] == v[3]) return v[0];
  if (v[1] == v[2] || v[1] == v[3]) return v[1];
  return v[2] == v[3] ? v[2] : v[0];
}

/// Makes the next overview: each value stands for two by two values, cut off at the southern and eastern edge.
template <class T>
Level<T> halve(const T* values, std::int64_t columns, std::int64_t rows, bool classes) {
  Level<T> half{{}, (columns + 1) / 2, (rows + 1) / 2};
  half.values.resize(static_cast<std::size_t>(half.columns * half.rows));
  constexpr std::int64_t kStrip = 64;
  parallel_for(static_cast<std::size_t>((half.rows + kStrip - 1) / kStrip), [&](std::size_t strip) {
    const std::int64_t first = static_cast<std::int64_t>(strip) * kStrip, last = std::min(half.rows, first + kStrip);
    for (std::int64_t r = first; r < last; ++r) {
      const T* const north = values + 2 * r * columns;
      const T* const south = values + std::min(2 * r + 1, rows - 1) * columns;
      T* const out = half.values.data() + r * half.columns;
      for (std::int64_t c = 0; c < half.columns; ++c) {
        const std::int64_t west = 2 * c, east = std::min(2 * c + 1, columns - 1);
        out[c] = classes ? most_frequent<T>({north[west], north[east], south[west], south[east]}) : north[west];
      }
    }
  });
  return half;
}

template <class T>
std::vector<Level<T>> overviews(std::span<const T> values, const RasterGrid& grid, bool classes) {
  std::vector<Level<T>> levels;
  const T* finer = values.data();
  std::int64_t columns = grid.columns(), rows = grid.rows();
  while (std::max(columns, rows) > kTileSide) {
    levels.push_back(halve(finer, columns, rows, classes));
    finer = levels.back().values.data(), columns = levels.back().columns, rows = levels.back().rows;
  }
  return levels;
}

/// Wraps the values, with a band for each raster of the grid that they hold.
template <class T>
GDALDatasetUniquePtr wrap(std::span<const T> values, const RasterGrid& grid, GDALDataType type) {
  GDALDatasetUniquePtr dataset = memory_raster(grid);
  for (std::size_t first = 0; first < values.size(); first += grid.cell_count())
    add_band(*dataset, values.subspan(first, grid.cell_count()), type);
  return dataset;
}

/// Attaches overviews to every band.
template <class T>
void attach_overviews(GDALDataset& dataset, std::span<const T> values, const RasterGrid& grid, bool classes,
                      GDALDataType type) {
  for (int band = 1; band <= dataset.GetRasterCount(); ++band) {
    const std::size_t first = static_cast<std::size_t>(band - 1) * grid.cell_count();
    std::vector<Level<T>> levels = overviews(values.subspan(first, grid.cell_count()), grid, classes);
    if (levels.empty()) return;
    std::vector<int> factors;
    for (std::size_t i = 0; i < levels.size(); ++i) factors.push_back(2 << i);
    if (band == 1)
      dataset.BuildOverviews("NONE", static_cast<int>(factors.size()), factors.data(), 0, nullptr, nullptr, nullptr);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const int columns = static_cast<int>(levels[i].columns), rows = static_cast<int>(levels[i].rows);
      GDALRasterBand* const overview = dataset.GetRasterBand(band)->GetOverview(static_cast<int>(i));
      // A failure reaches the caller through QuietGdal.
      std::ignore = overview->RasterIO(GF_Write, 0, 0, columns, rows, levels[i].values.data(), columns, rows, type, 0,
                                       0, nullptr);
    }
  }
}

void describe(GDALDataset& dataset, const RasterDescription& description) {
  if (!description.crs_wkt.empty()) dataset.SetProjection(description.crs_wkt.c_str());
  for (const auto& [name, value] : description.metadata) dataset.SetMetadataItem(name.c_str(), value.c_str());
  for (int b = 1; b <= dataset.GetRasterCount(); ++b) {
    const std::string& name =
        b == 1 ? description.band_name : description.further_bands[static_cast<std::size_t>(b - 2)];
    dataset.GetRasterBand(b)->SetDescription(name.c_str());
    if (description.nodata) dataset.GetRasterBand(b)->SetNoDataValue(*description.nodata);
  }
  if (description.classes.empty()) return;
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  GDALColorTable colours;
  for (int value = 0; value < 256; ++value) {
    const GDALColorEntry unused{0, 0, 0, 0};
    colours.SetColorEntry(value, &unused);
  }
  for (const RasterClass& c : description.classes) {
    const GDALColorEntry colour{c.colour.red, c.colour.green, c.colour.blue, c.colour.alpha};
    colours.SetColorEntry(c.value, &colour);
    // GeoTIFF has no place for category names, and GDAL would leave a side file for them.
    band.SetMetadataItem(fmt::format("class_{}", c.value).c_str(), c.name.c_str());
  }
  band.SetColorTable(&colours);
  band.SetColorInterpretation(GCI_PaletteIndex);
}

CPLStringList creation_options(bool floating, int tile_side) {
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("LEVEL", "1");
  options.SetNameValue("PREDICTOR", floating ? "YES" : "NO");
  options.SetNameValue("BLOCKSIZE", std::to_string(tile_side).c_str());
  options.SetNameValue("OVERVIEWS", "FORCE_USE_EXISTING");  // GDAL would make its own for smaller tiles
  options.SetNameValue("NUM_THREADS", std::to_string(thread_count()).c_str());
  return options;
}

/// Answers GDAL, which asks on its way through a call.
int go_on_unless_cancelled(double, const char*, void* progress) {
  return static_cast<const Progress*>(progress)->cancelled() ? FALSE : TRUE;
}

template <class T>
void write_cog(const std::string& path, const RasterGrid& grid, std::span<const T> values, GDALDataType type,
               const RasterDescription& description, const Progress& progress) {
  if (values.empty() || values.size() % grid.cell_count() != 0)
    throw InputError(fmt::format("{}: {} values are given for {} cells", path, values.size(), grid.cell_count()));
  PendingFile file(path, description.overwrite);
  const QuietGdal quiet;
  const CPLConfigOptionSetter no_side_files("GDAL_PAM_ENABLED", "NO", false);
  GDALDriver* const driver = written_driver("COG");
  if (!driver) throw FileError(path, "GDAL here cannot write cloud-optimised GeoTIFFs; install GDAL 3.1 or later");
  const GDALDatasetUniquePtr source = wrap(values, grid, type);
  progress.throw_if_cancelled();
  attach_overviews(*source, values, grid, !description.classes.empty(), type);
  describe(*source, description);
  const std::size_t bands = values.size() / grid.cell_count();
  const CPLStringList options = creation_options(std::is_floating_point_v<T>, tile_side(bands * sizeof(T)));
  GDALDatasetUniquePtr written(driver->CreateCopy(file.temporary_path().c_str(), source.get(), false, options.List(),
                                                  go_on_unless_cancelled, const_cast<Progress*>(&progress)));
  const bool created = written != nullptr;
  written.reset();  // the last bytes are written on closing
  progress.throw_if_cancelled();
  if (!created || QuietGdal::failed()) throw FileError(path, write_failure("cannot be written; GDAL gives no reason"));
  file.commit();
  // A side file would describe the raster that was replaced.
  std::error_code ignored;
  std::filesystem::remove(path + ".aux.xml", ignored);
}

}  // namespace

void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint8_t> values,
                  const RasterDescription& description, const Progress& progress) {
  write_cog(path, grid, values, GDT_Byte, description, progress);
}

void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint16_t> values,
                  const RasterDescription& description, const Progress& progress) {
  write_cog(path, grid, values, GDT_UInt16, description, progress);
}

void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint32_t> values,
                  const RasterDescription& description, const Progress& progress) {
  write_cog(path, grid, values, GDT_UInt32, description, progress);
}

void write_raster(const std::string& path, const RasterGrid& grid, std::span<const float> values,
                  const RasterDescription& description, const Progress& progress) {
  write_cog(path, grid, values, GDT_Float32, description, progress);
}

}  // namespace itin
