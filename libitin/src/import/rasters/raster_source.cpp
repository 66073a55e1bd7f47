#include "import/rasters/raster_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/raster_values.hpp>

#include "gdal/files/block_cache_limit.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/raster_file.hpp"
#include "import/rasters/raster_lattice.hpp"
#include "import/rasters/raster_windows.hpp"
#include "import/source/height_band.hpp"

namespace itin {

namespace {

constexpr double kSteadySteps = 1.25;            // steps that vary more than this earn a warning
constexpr std::size_t kPostsPerBatch = 1 << 16;  // posts placed at a time
constexpr std::uint64_t kCacheShare = 8;         // number of times that GDAL's cache of blocks fits into the memory

std::vector<std::string> rasters_in_archive(const std::string& archive) {
  std::vector<std::string> found;
  const CPLStringList entries(VSIReadDirRecursive(archive.c_str()));
  for (int i = 0; i < entries.size(); ++i)
    if (const std::string path = archive + "/" + entries[i]; is_raster(path)) found.push_back(path);
  std::sort(found.begin(), found.end());
  return found;
}

/// The longest of a kind of step between posts, and how much they vary.
struct Steps {
  Point2 longest;
  double least = std::numeric_limits<double>::infinity();

  static double length(Point2 p) { return std::hypot(p.x, p.y); }
  void add(Point2 from, Point2 to) {
    const Point2 step{to.x - from.x, to.y - from.y};
    if (std::isnan(step.x) || std::isnan(step.y)) return;
    if (length(step) > length(longest)) longest = step;
    least = std::min(least, length(step));
  }
  double variation() const { return length(longest) / least; }
};

/// Posts while they are placed on the grid.
struct Batch {
  std::vector<double> x, y, z;
  std::vector<GridPoint> points;
};

/// The properties of a raster that are known before its posts are read.
struct OpenedRaster {
  std::string path;
  std::optional<int> band;  ///< as the call says
  std::uint64_t memory_bytes = 0;
  RasterLattice lattice;
  Crs crs;
  SourceHeights heights;
  std::string copyright;  ///< as the file states it
};

class RasterTerrain final : public TerrainSource {
 public:
  RasterTerrain(const OpenedRaster& raster, const SourceContext& context)
      : path_(raster.path),
        band_(raster.band),
        lattice_(raster.lattice),
        memory_bytes_(raster.memory_bytes),
        placement_(path_, raster.crs, raster.heights.axis, {context.grid, context.crs_wkt},
                   Placement::Missing::kDeclared) {
    info_.path = path_;
    info_.kind = "terrain";
    info_.source_crs = raster.heights.crs;
    info_.note = raster.copyright;
    measure_steps();
  }

  double size_hint() const override { return static_cast<double>(lattice_.columns) * lattice_.rows; }
  SourceInfo info() const override { return info_; }

  ReadCounts read(const Sink& sink, Progress& progress) override {
    const std::string stage = "reading " + path_;
    const BlockCacheLimit limit(memory_bytes_ / kCacheShare);
    const QuietGdal quiet;
    const GDALDatasetUniquePtr dataset = open_raster_file(path_);
    HeightBand band(*dataset, path_, band_);
    std::vector<double> heights;
    Batch batch;  // not a member, for thousands of sources may be planned at once
    voids_ += RasterWindows(band, memory_bytes_).for_each([&](const RasterWindow& window) {
      progress.throw_if_cancelled();
      progress.report(stage, static_cast<double>(window.row) / lattice_.rows);
      band.read(window, heights);
      place_window(window, heights, batch, sink);
    });
    hand_on(batch, sink);
    info_.sha256 = file_sha256(path_, progress);
    info_.imported = utc_now();
    return counts(band.undeclared_voids());
  }

 private:
  void measure_steps();
  void place_window(const RasterWindow& window, const std::vector<double>& heights, Batch& batch, const Sink& sink);
  void hand_on(Batch& batch, const Sink& sink);
  ReadCounts counts(std::uint64_t undeclared_voids) const;

  std::string path_;
  std::optional<int> band_;
  RasterLattice lattice_;
  std::uint64_t memory_bytes_;
  Placement placement_;
  SourceInfo info_;
  std::vector<std::string> warnings_;
  std::uint64_t voids_ = 0;
};

void RasterTerrain::measure_steps() {
  const double right = std::max(0, lattice_.columns - 2), bottom = std::max(0, lattice_.rows - 2);
  const auto in_store = [&](double column, double row) {
    Point2 p = lattice_.post(column, row);
    placement_.transform(std::span(&p.x, 1), std::span(&p.y, 1));
    return p;
  };
  Steps across, down;
  for (const Point2 at : {Point2{0, 0}, Point2{right, 0}, Point2{0, bottom}, Point2{right, bottom},
                          Point2{std::floor(right / 2), std::floor(bottom / 2)}}) {
    const Point2 from = in_store(at.x, at.y);
    across.add(from, in_store(at.x + 1, at.y));
    down.add(from, in_store(at.x, at.y + 1));
  }
  const Point2 u = across.longest, v = down.longest;
  const double cell = std::abs(u.x * v.y - u.y * v.x);
  if (!(cell > 0))
    throw InputError(fmt::format("{}: lies where the store's CRS is not defined; choose another with `to_crs`", path_),
                     "to_crs");
  info_.gap_basis = {kGapSteps * u.x, kGapSteps * u.y, kGapSteps * v.x, kGapSteps * v.y};
  info_.spacing = std::sqrt(cell);
  if (const double variation = std::max(across.variation(), down.variation()); variation > kSteadySteps)
    warnings_.push_back(fmt::format(
        "{}: steps between posts vary {:.2f} fold in the store's CRS, so that narrow voids may be bridged where posts "
        "are dense; import smaller pieces, or choose a nearer CRS with `to_crs`",
        path_, variation));
}

void RasterTerrain::place_window(const RasterWindow& window, const std::vector<double>& heights, Batch& batch,
                                 const Sink& sink) {
  const auto columns = static_cast<std::size_t>(window.columns);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (std::isnan(heights[i])) {
      ++voids_;
      continue;
    }
    const std::size_t row = i / columns;
    const Point2 p =
        lattice_.post(window.column + static_cast<double>(i - row * columns), window.row + static_cast<double>(row));
    batch.x.push_back(p.x), batch.y.push_back(p.y), batch.z.push_back(heights[i]);
    if (batch.x.size() == kPostsPerBatch) hand_on(batch, sink);
  }
}

void RasterTerrain::hand_on(Batch& batch, const Sink& sink) {
  placement_.place(batch.x, batch.y, batch.z, batch.points);
  batch.x.clear(), batch.y.clear(), batch.z.clear();
  if (!batch.points.empty()) sink(batch.points);
}

ReadCounts RasterTerrain::counts(std::uint64_t undeclared_voids) const {
  ReadCounts counts = placement_.counts();
  counts.voids += voids_;
  counts.warnings.insert(counts.warnings.begin(), warnings_.begin(), warnings_.end());
  if (undeclared_voids > 0)
    counts.warnings.push_back(
        fmt::format("{}: {} of -9999, -32767 or -32768 taken as missing, though the file does not declare these as "
                    "nodata",
                    path_, counted(undeclared_voids, "post")));
  return counts;
}

class RasterFile final : public SourceFile {
 public:
  RasterFile(const std::string& path, const ImportOptions& options) {
    // Files of GeoTIFF 1.0 state their vertical part only when asked to.
    const CPLConfigOptionSetter whole_crs("GTIFF_REPORT_COMPD_CS", "YES", true);
    const QuietGdal quiet;
    const GDALDatasetUniquePtr dataset = open_raster_file(path);
    const HeightBand band(*dataset, path, options.band);
    RasterWindows(band, options.memory_bytes).require_small_blocks(*dataset);
    present_ = RasterWindows::present(band);
    raster_ = {path, options.band, options.memory_bytes, lattice_of(*dataset, path), {}, {}, {}};
    raster_.crs = source_crs(path, options.crs, crs_text(*dataset), Elevations::in_coordinates);
    raster_.heights = source_heights(path, raster_.crs.heights_given ? std::nullopt : band.stated_unit(), raster_.crs);
    if (const char* copyright = dataset->GetMetadataItem("TIFFTAG_COPYRIGHT")) raster_.copyright = copyright;
    if (!raster_.heights.warning.empty()) warnings_.push_back(raster_.heights.warning);
  }

  Crs crs() const override { return raster_.crs; }
  const std::string& path() const override { return raster_.path; }
  Point2 centre() const override {
    return raster_.lattice.post(present_.column + (present_.columns - 1) / 2.0,
                                present_.row + (present_.rows - 1) / 2.0);
  }
  /// Only large windows tell where the posts of a vast raster lie; the posts themselves tell how far they reach.
  Box extent() const override {
    const bool all = present_.columns == raster_.lattice.columns && present_.rows == raster_.lattice.rows;
    return all ? raster_.lattice.box(present_) : SourceFile::extent();
  }
  std::vector<std::string> warnings() const override { return warnings_; }
  std::unique_ptr<TerrainSource> bind(const SourceContext& context) override {
    return std::make_unique<RasterTerrain>(raster_, context);
  }

 private:
  OpenedRaster raster_;
  RasterWindow present_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> find_rasters(const std::string& path) {
  const QuietGdal quiet;
  if (ending_of(path) == ".zip") return rasters_in_archive(path.starts_with("/vsizip/") ? path : "/vsizip/" + path);
  return is_raster(path) ? std::vector{path} : std::vector<std::string>{};
}

std::string crs_text(const GDALDataset& dataset) {
  const OGRSpatialReference* reference = dataset.GetSpatialRef();
  // A local system is how some formats say "none".
  return reference && !reference->IsLocal() ? wkt_of(*reference) : std::string();
}

std::unique_ptr<SourceFile> open_raster_source(const std::string& path, const ImportOptions& options) {
  return std::make_unique<RasterFile>(path, options);
}

}  // namespace itin
