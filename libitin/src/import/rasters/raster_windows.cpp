#include "import/rasters/raster_windows.hpp"

#include <algorithm>

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <itin/error.hpp>

#include "gdal/files/drivers.hpp"
#include "gdal/files/quiet_gdal.hpp"

namespace itin {

namespace {

constexpr std::uint64_t kBytesPerPost = 64;                       // while posts are read and placed
constexpr int kFewestPosts = 1 << 14, kMostPosts = 1 << 22;       // in a window
constexpr std::uint64_t kNominalMemory = std::uint64_t{1} << 22;  // for small windows, which tell where posts are
constexpr std::uint64_t kVast = std::uint64_t{1} << 36;           // posts; larger rasters are searched for their posts
constexpr std::uint64_t kPostsOfStore = std::uint64_t{1} << 40;   // a store's tree has no more leaves
constexpr std::uint64_t kBlockShare = 4;                          // the memory holds the current block this many times
constexpr int kMostNested = 8;                                    // virtual rasters of virtual rasters

/// The memory that GDAL takes to read a single post.
std::uint64_t block_bytes(GDALDataset& dataset, GDALRasterBand& band) {
  int columns = 0, rows = 0;
  band.GetBlockSize(&columns, &rows);
  const char* interleave = dataset.GetMetadataItem("INTERLEAVE", "IMAGE_STRUCTURE");
  const int bands = interleave != nullptr && EQUAL(interleave, "PIXEL") ? dataset.GetRasterCount() : 1;
  return static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(bands) *
         static_cast<std::uint64_t>(GDALGetDataTypeSizeBytes(band.GetRasterDataType()));
}

bool is_virtual(GDALDataset& dataset) {
  return dataset.GetDriver() != nullptr && EQUAL(dataset.GetDriver()->GetDescription(), "VRT");
}

/// Null for a file that cannot be opened, which is reported when it is read.
GDALDatasetUniquePtr open_part(const std::string& path) {
  try {
    return open_dataset(path, GDAL_OF_RASTER);
  } catch (const FileError&) {
    return nullptr;
  }
}

/// Checks a dataset at `path`.
void require_small_blocks(GDALDataset& dataset, const std::string& path, std::uint64_t memory_bytes, int depth) {
  if (is_virtual(dataset) && depth < kMostNested) {
    const CPLStringList files(dataset.GetFileList());
    for (int i = 0; i < files.size(); ++i) {
      if (path == files[i]) continue;
      const GDALDatasetUniquePtr part = open_part(files[i]);
      if (part) require_small_blocks(*part, files[i], memory_bytes, depth + 1);
    }
    return;
  }
  if (dataset.GetRasterCount() == 0) return;
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  const std::uint64_t bytes = block_bytes(dataset, band);
  if (bytes <= memory_bytes / kBlockShare) return;
  int columns = 0, rows = 0;
  band.GetBlockSize(&columns, &rows);
  throw InputError(fmt::format(
      "{}: is stored in blocks of {} by {} posts, {:.4g} MB each, which is too much for {:.4g} MB of memory; "
      "rewrite it with gdal_translate -co TILED=YES, or give more memory",
      path, columns, rows, static_cast<double>(bytes) / (1 << 20), static_cast<double>(memory_bytes) / (1 << 20)));
}

[[noreturn]] void refuse_vast(const HeightBand& band) {
  throw InputError(fmt::format(
      "{}: has {} by {} posts, and more than {} of them may hold heights, which is beyond any store; cut out what you "
      "need with gdal_translate -projwin{}",
      band.path(), band.columns(), band.rows(), kPostsOfStore,
      band.declares_nodata() ? "" : ", or, where most of them are absent, declare a nodata value"));
}

}  // namespace

RasterWindows::RasterWindows(const HeightBand& band, std::uint64_t memory_bytes)
    : band_(band),
      memory_bytes_(memory_bytes),
      tells_absence_(band.declares_nodata()) {  // else absent posts would be heights of 0
  int block_columns = 0, block_rows = 0;
  band.band().GetBlockSize(&block_columns, &block_rows);
  const int most =
      static_cast<int>(std::clamp<std::uint64_t>(memory_bytes / 8 / kBytesPerPost, kFewestPosts, kMostPosts));
  columns_ = std::min(std::max(1, block_columns), most);
  rows_ = std::clamp(block_rows, 1, std::max(1, most / columns_));
  columns_ = std::min(band.columns(), columns_ * std::max(1, most / rows_ / columns_));
}

RasterWindow RasterWindows::posts_of(const Places& p) const {
  const auto end = [](int first, int count, int size, int all) {
    return static_cast<int>(std::min<std::int64_t>((std::int64_t{first} + count) * size, all));
  };
  RasterWindow window{p.column * columns_, p.row * rows_, 0, 0};
  window.columns = end(p.column, p.columns, columns_, band_.columns()) - window.column;
  window.rows = end(p.row, p.rows, rows_, band_.rows()) - window.row;
  return window;
}

bool RasterWindows::absent(const Places& places) const {
  if (!tells_absence_) return false;
  const RasterWindow w = posts_of(places);
  const int status =
      band_.band().GetDataCoverageStatus(w.column, w.row, w.columns, w.rows, GDAL_DATA_COVERAGE_STATUS_DATA, nullptr);
  return status == GDAL_DATA_COVERAGE_STATUS_EMPTY;
}

std::uint64_t RasterWindows::for_each(const std::function<void(const RasterWindow&)>& visit) const {
  const auto count = [](int all, int size) { return static_cast<int>((std::int64_t{all} + size - 1) / size); };
  return visit_rows({0, 0, count(band_.columns(), columns_), count(band_.rows(), rows_)}, visit);
}

std::uint64_t RasterWindows::visit_rows(const Places& p, const std::function<void(const RasterWindow&)>& visit) const {
  if (absent(p)) return posts_of(p).posts();
  if (p.rows == 1) return visit_columns(p, visit);
  const int half = p.rows / 2;
  const std::uint64_t above = visit_rows({p.column, p.row, p.columns, half}, visit);
  return above + visit_rows({p.column, p.row + half, p.columns, p.rows - half}, visit);
}

std::uint64_t RasterWindows::visit_columns(const Places& p,
                                           const std::function<void(const RasterWindow&)>& visit) const {
  if (p.columns == 1) {
    visit(posts_of(p));
    return 0;
  }
  const int half = p.columns / 2;
  std::uint64_t left_out = 0;
  for (const Places& part : {Places{p.column, p.row, half, 1}, Places{p.column + half, p.row, p.columns - half, 1}})
    left_out += absent(part) ? posts_of(part).posts() : visit_columns(part, visit);
  return left_out;
}

void RasterWindows::require_small_blocks(GDALDataset& dataset) const {
  const QuietGdal quiet;
  itin::require_small_blocks(dataset, band_.path(), memory_bytes_, 0);
}

RasterWindow RasterWindows::present(const HeightBand& band) {
  const RasterWindow all{0, 0, band.columns(), band.rows()};
  if (all.posts() <= kVast) return all;
  const QuietGdal quiet;
  std::uint64_t posts = 0;
  int left = all.columns, top = all.rows, right = 0, bottom = 0;
  // The result must not depend on the memory, for the grid's origin is about the middle.
  RasterWindows(band, kNominalMemory).for_each([&](const RasterWindow& w) {
    posts += w.posts();
    if (posts > kPostsOfStore) refuse_vast(band);
    left = std::min(left, w.column), top = std::min(top, w.row);
    right = std::max(right, w.column + w.columns), bottom = std::max(bottom, w.row + w.rows);
  });
  return posts == 0 ? all : RasterWindow{left, top, right - left, bottom - top};
}

}  // namespace itin
