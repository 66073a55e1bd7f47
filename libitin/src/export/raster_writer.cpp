#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <tuple>
#include <type_traits>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/raster.hpp>
#include <itin/raster_in_parts.hpp>

#include "export/pending_file.hpp"
#include "gdal/files/block_cache_limit.hpp"
#include "gdal/files/drivers.hpp"
#include "gdal/files/memory_raster.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/write_failure.hpp"

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
T most_frequent(const std::array<T, 4>& v) {
  // Among values that occur equally often the first one wins.
  if (v[0] == v[1] || v[0] == v[2] || v[0] == v[3]) return v[0];
  if (v[1] == v[2] || v[1] == v[3]) return v[1];
  return v[2] == v[3] ? v[2] : v[0];
}

/// A strip of rows as wide as a band.
template <class T>
struct Strip {
  std::int64_t columns = 0, rows = 0;
  std::vector<T> values = {};

  Strip(std::int64_t of_columns, std::int64_t of_rows)
      : columns(of_columns), rows(of_rows), values(static_cast<std::size_t>(columns * rows)) {}
};

/// Halves a strip: each value stands for two by two values, cut off at the southern and eastern edge.
template <class T>
Strip<T> halve(const Strip<T>& strip, bool classes) {
  Strip<T> half((strip.columns + 1) / 2, (strip.rows + 1) / 2);
  parallel_for(static_cast<std::size_t>(half.rows), [&](std::size_t i) {
    const auto r = static_cast<std::int64_t>(i);
    const T* const north = strip.values.data() + 2 * r * strip.columns;
    const T* const south = strip.values.data() + std::min(2 * r + 1, strip.rows - 1) * strip.columns;
    T* const out = half.values.data() + r * half.columns;
    for (std::int64_t c = 0; c < half.columns; ++c) {
      const std::int64_t west = 2 * c, east = std::min(2 * c + 1, strip.columns - 1);
      out[c] = classes ? most_frequent<T>({north[west], north[east], south[west], south[east]}) : north[west];
    }
  });
  return half;
}

template <class T>
constexpr GDALDataType gdal_type() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return GDT_Byte;
  if constexpr (std::is_same_v<T, std::uint16_t>) return GDT_UInt16;
  if constexpr (std::is_same_v<T, std::uint32_t>) return GDT_UInt32;
  return GDT_Float32;
}

/// Reads or writes whole rows. A failure reaches the caller through QuietGdal.
template <class T>
void exchange_rows(GDALRasterBand& band, GDALRWFlag direction, std::int64_t first_row, Strip<T>& strip) {
  const int columns = static_cast<int>(strip.columns), rows = static_cast<int>(strip.rows);
  std::ignore = band.RasterIO(direction, 0, static_cast<int>(first_row), columns, rows, strip.values.data(), columns,
                              rows, gdal_type<T>(), 0, 0, nullptr);
}

/// How many rows an overview is made of at a time; an even number.
constexpr std::int64_t kStripRows = 256;

/// Makes an overview from the next finer one, or from the band itself.
template <class T>
void fill_overview(GDALRasterBand& finer, GDALRasterBand& coarser, bool classes, const Progress& progress) {
  for (std::int64_t row = 0; row < finer.GetYSize(); row += kStripRows) {
    progress.throw_if_cancelled();
    Strip<T> strip(finer.GetXSize(), std::min(kStripRows, finer.GetYSize() - row));
    exchange_rows(finer, GF_Read, row, strip);
    Strip<T> half = halve(strip, classes);
    exchange_rows(coarser, GF_Write, row / 2, half);
  }
}

/// Gives all bands their overviews.
template <class T>
void make_overviews(GDALDataset& raster, bool classes, const Progress& progress) {
  std::vector<int> factors;
  for (int side = std::max(raster.GetRasterXSize(), raster.GetRasterYSize()); side > kTileSide; side = (side + 1) / 2)
    factors.push_back(2 << factors.size());
  if (factors.empty()) return;
  raster.BuildOverviews("NONE", static_cast<int>(factors.size()), factors.data(), 0, nullptr, nullptr, nullptr);
  for (GDALRasterBand* const band : raster.GetBands()) {
    GDALRasterBand* finer = band;
    for (int i = 0; i < band->GetOverviewCount(); ++i) {
      fill_overview<T>(*finer, *band->GetOverview(i), classes, progress);
      finer = band->GetOverview(i);
    }
  }
}

/// Wraps the values, with a band for each raster of the grid that they hold.
template <class T>
GDALDatasetUniquePtr wrap(std::span<const T> values, const RasterGrid& grid) {
  GDALDatasetUniquePtr dataset = memory_raster(grid);
  for (std::size_t first = 0; first < values.size(); first += grid.cell_count())
    add_band(*dataset, values.subspan(first, grid.cell_count()), gdal_type<T>());
  return dataset;
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

/// Writes a raster that GDAL has, with its overviews and its description, as a cloud-optimised GeoTIFF.
template <class T>
void write_cog(GDALDataset& raster, PendingFile& file, const Progress& progress) {
  GDALDriver* const driver = written_driver("COG");
  if (!driver)
    throw FileError(file.path(), "GDAL here cannot write cloud-optimised GeoTIFFs; install GDAL 3.1 or later");
  const auto bands = static_cast<std::size_t>(raster.GetRasterCount());
  const CPLStringList options = creation_options(std::is_floating_point_v<T>, tile_side(bands * sizeof(T)));
  GDALDatasetUniquePtr written(driver->CreateCopy(file.temporary_path().c_str(), &raster, false, options.List(),
                                                  go_on_unless_cancelled, const_cast<Progress*>(&progress)));
  const bool created = written != nullptr;
  written.reset();  // the last bytes are written on closing
  progress.throw_if_cancelled();
  if (!created || QuietGdal::failed())
    throw FileError(file.path(), write_failure("cannot be written; GDAL gives no reason"));
  file.commit();
  // A side file would describe the raster that was replaced.
  std::error_code ignored;
  std::filesystem::remove(file.path() + ".aux.xml", ignored);
}

template <class T>
void write_values(const std::string& path, const RasterGrid& grid, std::span<const T> values,
                  const RasterDescription& description, const Progress& progress) {
  if (values.empty() || values.size() % grid.cell_count() != 0)
    throw InputError(fmt::format("{}: {} values are given for {} cells", path, values.size(), grid.cell_count()));
  PendingFile file(path, description.overwrite);
  const QuietGdal quiet;
  const CPLConfigOptionSetter no_side_files("GDAL_PAM_ENABLED", "NO", false);
  const GDALDatasetUniquePtr raster = wrap(values, grid);
  progress.throw_if_cancelled();
  make_overviews<T>(*raster, !description.classes.empty(), progress);
  describe(*raster, description);
  write_cog<T>(*raster, file, progress);
}

}  // namespace

void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint8_t> values,
                  const RasterDescription& description, const Progress& progress) {
  write_values(path, grid, values, description, progress);
}

void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint16_t> values,
                  const RasterDescription& description, const Progress& progress) {
  write_values(path, grid, values, description, progress);
}

void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint32_t> values,
                  const RasterDescription& description, const Progress& progress) {
  write_values(path, grid, values, description, progress);
}

void write_raster(const std::string& path, const RasterGrid& grid, std::span<const float> values,
                  const RasterDescription& description, const Progress& progress) {
  write_values(path, grid, values, description, progress);
}

/// The parts that have come, as a raster without compression. A place that no part has takes no room there.
template <class T>
struct RasterInParts<T>::Scratch {
  Scratch(const std::string& path, const RasterGrid& grid, const RasterDescription& description)
      : classes(!description.classes.empty()), file(path, description.overwrite), values(path, true) {
    const Call call;
    const auto bands = 1 + description.further_bands.size();
    const std::string side = std::to_string(std::min(kSide, tile_side(bands * sizeof(T))));
    CPLStringList options;
    options.SetNameValue("TILED", "YES");
    options.SetNameValue("BLOCKXSIZE", side.c_str());
    options.SetNameValue("BLOCKYSIZE", side.c_str());
    options.SetNameValue("INTERLEAVE", "BAND");
    options.SetNameValue("BIGTIFF", "YES");
    options.SetNameValue("SPARSE_OK", "TRUE");
    if (classes) options.SetNameValue("PHOTOMETRIC", "PALETTE");
    raster.reset(written_driver("GTiff")->Create(values.temporary_path().c_str(), static_cast<int>(grid.columns()),
                                                 static_cast<int>(grid.rows()), static_cast<int>(bands), gdal_type<T>(),
                                                 options.List()));
    if (!raster) throw FileError(path, write_failure("cannot be written; GDAL gives no reason"));
    place_on(grid, *raster);
    describe(*raster, description);
  }

  void write(RasterGrid::Cell north_west, std::int64_t columns, std::int64_t rows, std::span<const T> part) {
    const Call call;
    const int across = static_cast<int>(columns), down = static_cast<int>(rows);
    std::ignore = raster->RasterIO(GF_Write, static_cast<int>(north_west.column), static_cast<int>(north_west.row),
                                   across, down, const_cast<T*>(part.data()), across, down, gdal_type<T>(),
                                   raster->GetRasterCount(), nullptr, 0, 0, 0, nullptr);
    if (QuietGdal::failed()) throw FileError(file.path(), write_failure("cannot be written; GDAL gives no reason"));
  }

  void finish(const Progress& progress) {
    const Call call;
    make_overviews<T>(*raster, classes, progress);
    write_cog<T>(*raster, file, progress);
  }

  ~Scratch() {
    const Call call;
    if (raster) raster->MarkSuppressOnClose();
    raster.reset();
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// What holds while GDAL is called.
  struct Call {
    const QuietGdal quiet;
    const CPLConfigOptionSetter no_side_files{"GDAL_PAM_ENABLED", "NO", false};
    const BlockCacheLimit limit{std::uint64_t{64} << 20};
  };
  static constexpr int kSide = 256;

  bool classes;
  PendingFile file, values;
  GDALDatasetUniquePtr raster;
};

template <class T>
RasterInParts<T>::RasterInParts(const std::string& path, const RasterGrid& grid, const RasterDescription& description)
    : scratch_(std::make_unique<Scratch>(path, grid, description)) {}
template <class T>
RasterInParts<T>::~RasterInParts() = default;

template <class T>
void RasterInParts<T>::write(RasterGrid::Cell north_west, std::int64_t columns, std::int64_t rows,
                             std::span<const T> values) {
  scratch_->write(north_west, columns, rows, values);
}

template <class T>
void RasterInParts<T>::finish(const Progress& progress) {
  scratch_->finish(progress);
  scratch_.reset();
}

template class RasterInParts<std::uint8_t>;
template class RasterInParts<std::uint16_t>;
template class RasterInParts<std::uint32_t>;
template class RasterInParts<float>;

}  // namespace itin
