#include "import/footprints/height_raster.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/height_limit.hpp>

#include "features/cell_patches.hpp"
#include "gdal/crs.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/raster_file.hpp"
#include "import/rasters/raster_lattice.hpp"
#include "import/rasters/raster_source.hpp"
#include "import/rasters/raster_windows.hpp"
#include "import/source/crs_doubts.hpp"
#include "import/source/source_context.hpp"

namespace itin {

namespace {

constexpr double kMillimetresInMetre = 1000;
constexpr double kHighestStep = 1000;         ///< metres
constexpr double kHighestAboveGround = 1000;  ///< metres: a greater height is an elevation
constexpr std::uint64_t kBytesPerCell = 16;   ///< while a raster is read, and afterwards in features

std::int32_t whole_millimetres(double metres, double least, const char* field) {
  const double millimetres = metres * kMillimetresInMetre, whole = std::round(millimetres);
  if (!(metres >= least && metres <= kHighestStep) || std::abs(millimetres - whole) > 1e-6)
    throw InputError(
        fmt::format("`{}` {:g}: give {:g} to {:g} metres, in whole millimetres", field, metres, least, kHighestStep));
  return static_cast<std::int32_t>(whole);
}

class HeightRasterReading {
 public:
  HeightRasterReading(const HeightRasterQuery& query, const StoreMetadata& store)
      : query_(query), dataset_(open_raster_file(query.path)), band_(*dataset_, query.path, query.band) {
    rule_.absolute = query.absolute;
    rule_.rounding = query.rounding;
    rule_.step = whole_millimetres(query.step, std::max(0.01, store.grid.resolution), "height_step");
    rule_.threshold = whole_millimetres(query.threshold, 0, "height_threshold");
    understand(store);
    place(store);
  }

  HeightRaster read(Progress& progress) {
    const RasterWindows windows(band_, query_.memory_bytes);
    windows.require_small_blocks(*dataset_);
    heights_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNoHeight);
    std::vector<double> values;
    result_.voids += windows.for_each([&](const RasterWindow& window) {
      progress.throw_if_cancelled();
      progress.report("reading " + query_.path, static_cast<double>(window.row) / rows_);
      band_.read(window, values);
      take(window, values);
    });
    if (result_.cells == 0) throw FileError(query_.path, "holds no height; all of its cells are without data");
    if (result_.low == result_.cells)
      throw InputError(fmt::format("{}: no cell is as high as `height_threshold`, {:g} m; the highest has {:g} m",
                                   query_.path, query_.threshold, highest_),
                       "height_threshold");
    cut_into_parts();
    add_warnings();
    return std::move(result_);
  }

 private:
  void understand(const StoreMetadata& store) {
    const Crs crs = source_crs(query_.path, query_.crs, crs_text(*dataset_),
                               query_.absolute ? Elevations::in_coordinates : Elevations::none);
    const RasterLattice lattice = lattice_of(*dataset_, query_.path);
    result_.footprints.warnings = crs_doubts(query_.path, crs, lattice.box({0, 0, lattice.columns, lattice.rows}));
    if (!PointTransform(crs.wkt, store.crs_wkt, query_.path).identity())
      throw InputError(
          fmt::format("{}: is in {}, and the store in {}; bring it into the store's CRS first, with gdalwarp -t_srs",
                      query_.path, crs.name, parse_crs(store.crs_wkt, "the store's CRS").name));
    SourceHeights heights = source_heights(query_.path, crs.heights_given ? std::nullopt : band_.stated_unit(), crs);
    if (query_.absolute && query_.datums != nullptr) query_.datums->add(crs, query_.path);
    metres_ = query_.absolute ? heights.axis.factor() : heights.axis.metres;
    result_.footprints.crs = std::move(heights.crs);
    if (!heights.warning.empty()) result_.footprints.warnings.push_back(std::move(heights.warning));
  }

  void place(const StoreMetadata& store) {
    const RasterLattice lattice = lattice_of(*dataset_, query_.path);
    columns_ = lattice.columns, rows_ = lattice.rows;
    rule_.corner = lattice.post(-0.5, -0.5), rule_.across = lattice.u, rule_.down = lattice.v;
    const std::uint64_t cells = static_cast<std::uint64_t>(columns_) * static_cast<std::uint64_t>(rows_);
    if (cells > query_.memory_bytes / kBytesPerCell)
      throw InputError(fmt::format("{}: has {} cells, for which {} MB of memory are too little; give more "
                                   "`memory_bytes`, or cut it into parts",
                                   query_.path, cells, query_.memory_bytes >> 20),
                       "memory_bytes");
    Box box;
    for (const double column : {0, columns_})
      for (const double row : {0, rows_}) box.extend(rule_.corner_at(column, row));
    const Box ground = store.grid.box(store.bounds);
    if (box.xmin > ground.xmax || box.xmax < ground.xmin || box.ymin > ground.ymax || box.ymax < ground.ymin)
      result_.footprints.warnings.push_back(query_.path +
                                            ": lies wholly beyond the ground of the store; import terrain there "
                                            "first");
  }

  void take(const RasterWindow& window, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) {
        ++result_.voids;
        continue;
      }
      const int column = window.column + static_cast<int>(i) % window.columns,
                row = window.row + static_cast<int>(i) / window.columns;
      const double metres = values[i] * metres_;
      if (!is_height(metres) || (!query_.absolute && metres > kHighestAboveGround)) refuse(metres, column, row);
      ++result_.cells;
      highest_ = std::max(highest_, metres);
      if (!query_.absolute && metres < 0) ++negative_, lowest_ = std::min(lowest_, metres);
      const auto height = static_cast<std::int32_t>(std::llround(metres * kMillimetresInMetre));
      if (!query_.absolute && steps_of(height, rule_) == 0)
        ++result_.low;
      else
        heights_[index(column, row)] = height;
    }
  }

  [[noreturn]] void refuse(double metres, int column, int row) const {
    const std::string place = fmt::format("{}: column {}, row {}", query_.path, column, row);
    require_height(metres, place);
    throw InputError(fmt::format("{} has {:g} m above the ground; heights above sea level are those of a surface, "
                                 "which `kind` surface imports",
                                 place, metres),
                     "kind");
  }

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  void cut_into_parts() {
    for (int row = 0; row < rows_; row += kHeightPartSide)
      for (int column = 0; column < columns_; column += kHeightPartSide) add_part(column, row);
  }

  void add_part(int column, int row) {
    HeightCells part = rule_;
    part.first_column = column, part.first_row = row;
    part.columns = std::min(kHeightPartSide, columns_ - column), part.rows = std::min(kHeightPartSide, rows_ - row);
    for (int r = 0; r < part.rows; ++r) {
      const auto first = heights_.begin() + static_cast<std::ptrdiff_t>(index(column, row + r));
      part.heights.insert(part.heights.end(), first, first + part.columns);
    }
    if (std::all_of(part.heights.begin(), part.heights.end(), [](std::int32_t h) { return h == kNoHeight; })) return;
    FootprintFeature& feature = result_.footprints.features.emplace_back();
    feature.name = std::filesystem::path(query_.path).filename().string();
    feature.kind = FeatureKind::cells;
    feature.rings = {{part.corner_at(0, 0), part.corner_at(part.columns, 0), part.corner_at(part.columns, part.rows),
                      part.corner_at(0, part.rows)}};
    feature.cells = std::move(part);
  }

  void add_warnings() {
    if (negative_ > 0)
      result_.footprints.warnings.push_back(fmt::format("{}: {} below zero, by up to {:g} m, left out", query_.path,
                                                        counted(negative_, "cell"), -lowest_));
    if (band_.undeclared_voids() > 0)
      result_.footprints.warnings.push_back(
          fmt::format("{}: {} of -9999, -32767 or -32768 taken as missing, though the file does not declare these as "
                      "nodata",
                      query_.path, counted(band_.undeclared_voids(), "cell")));
  }

  const HeightRasterQuery& query_;
  GDALDatasetUniquePtr dataset_;
  HeightBand band_;
  HeightCells rule_;  ///< the same in all parts
  int columns_ = 0, rows_ = 0;
  double metres_ = 1;  ///< number of metres in the unit of heights
  double highest_ = -std::numeric_limits<double>::infinity(), lowest_ = 0;
  std::uint64_t negative_ = 0;
  std::vector<std::int32_t> heights_;
  HeightRaster result_;
};

}  // namespace

HeightRaster read_height_raster(const HeightRasterQuery& query, const StoreMetadata& store, Progress& progress) {
  // Files of GeoTIFF 1.0 state their vertical part only when asked to.
  const CPLConfigOptionSetter whole_crs("GTIFF_REPORT_COMPD_CS", "YES", true);
  const QuietGdal quiet;
  return HeightRasterReading(query, store).read(progress);
}

}  // namespace itin
