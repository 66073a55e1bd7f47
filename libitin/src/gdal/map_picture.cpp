#include <array>
#include <memory>

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_utils.h>

#include <itin/error.hpp>
#include <itin/map_picture.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/raster_file.hpp"

namespace itin {

namespace {

struct FreeTranslate {
  void operator()(GDALTranslateOptions* options) const { GDALTranslateOptionsFree(options); }
};
struct FreeWarp {
  void operator()(GDALWarpAppOptions* options) const { GDALWarpAppOptionsFree(options); }
};

/// Returns the arguments of a GDAL program.
CPLStringList arguments(const std::vector<std::string>& texts) {
  CPLStringList list;
  for (const std::string& text : texts) list.AddString(text.c_str());
  return list;
}

/// Replaces a palette's numbers by red, green and blue.
GDALDatasetUniquePtr without_palette(const std::string& path, GDALDatasetUniquePtr picture) {
  if (picture->GetRasterCount() != 1 || picture->GetRasterBand(1)->GetColorTable() == nullptr) return picture;
  CPLStringList list = arguments({"-of", "MEM", "-expand", "rgba"});
  const std::unique_ptr<GDALTranslateOptions, FreeTranslate> options(GDALTranslateOptionsNew(list.List(), nullptr));
  GDALDatasetUniquePtr expanded(
      GDALDataset::FromHandle(GDALTranslate("", GDALDataset::ToHandle(picture.get()), options.get(), nullptr)));
  if (!expanded) throw FileError(path, QuietGdal::message("its palette cannot be read"));
  return expanded;
}

bool has_alpha(GDALDataset& picture) {
  return picture.GetRasterBand(picture.GetRasterCount())->GetColorInterpretation() == GCI_AlphaBand;
}

void require_colours(const std::string& path, GDALDataset& picture) {
  const int bands = picture.GetRasterCount(), colours = bands - (bands > 0 && has_alpha(picture) ? 1 : 0);
  bool bytes = true;
  for (int b = 1; b <= bands; ++b) bytes = bytes && picture.GetRasterBand(b)->GetRasterDataType() == GDT_Byte;
  if (!bytes || (colours != 1 && colours != 3))
    throw FileError(path, "is no picture of 8 bits in grey, with a palette, or in red, green and blue");
  if (picture.GetSpatialRef() == nullptr) throw FileError(path, "states no CRS, so it cannot be placed on a map");
}

/// Warps the picture to the pixels, with an alpha band.
GDALDatasetUniquePtr warped(const std::string& path, GDALDataset& picture, const RasterGrid& pixels,
                            const std::string& crs_wkt) {
  const Box box = pixels.bounds();
  std::vector<std::string> texts{"-of", "MEM", "-r", "average", "-t_srs", crs_wkt, "-te"};
  for (const double v : {box.xmin, box.ymin, box.xmax, box.ymax}) texts.push_back(fmt::format("{:.17g}", v));
  for (const std::string& text :
       {std::string("-ts"), fmt::format("{}", pixels.columns()), fmt::format("{}", pixels.rows())})
    texts.push_back(text);
  if (!has_alpha(picture)) texts.emplace_back("-dstalpha");
  CPLStringList list = arguments(texts);
  const std::unique_ptr<GDALWarpAppOptions, FreeWarp> options(GDALWarpAppOptionsNew(list.List(), nullptr));
  GDALDatasetH source = GDALDataset::ToHandle(&picture);
  GDALDatasetUniquePtr result(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options.get(), nullptr)));
  if (!result) throw FileError(path, QuietGdal::message("cannot be brought into the store's CRS"));
  return result;
}

}  // namespace

std::vector<Rgba> picture_at(const std::string& path, const RasterGrid& pixels, const std::string& crs_wkt) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr picture = without_palette(path, open_raster_file(path));
  require_colours(path, *picture);
  const GDALDatasetUniquePtr placed = warped(path, *picture, pixels, crs_wkt);
  const int bands = placed->GetRasterCount(), columns = placed->GetRasterXSize(), rows = placed->GetRasterYSize();
  // A grey band is read three times.
  const std::array<int, 4> channels = bands == 2 ? std::array{1, 1, 1, 2} : std::array{1, 2, 3, 4};
  std::vector<Rgba> colours(pixels.cell_count());
  static_assert(sizeof(Rgba) == 4);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    auto* first = reinterpret_cast<std::uint8_t*>(colours.data()) + c;
    if (placed->GetRasterBand(channels[c])
            ->RasterIO(GF_Read, 0, 0, columns, rows, first, columns, rows, GDT_Byte, 4, GSpacing{4} * columns,
                       nullptr) != CE_None)
      throw FileError(path, QuietGdal::message("cannot be read"));
  }
  return colours;
}

}  // namespace itin
