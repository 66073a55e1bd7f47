// Rasters made for a test, and a slow reading of any raster that shares no code with the import: the whole raster at
// once, every post transformed by itself.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <itin/geometry.hpp>
#include <itin/import.hpp>

#include "import/source/terrain_source.hpp"

namespace itin::test {

/// A raster by content; what is left at its default is left out of the file.
struct MadeRaster {
  std::string driver = "GTiff";
  std::string crs = "EPSG:27700";
  std::array<double, 6> transform{300000, 50, 0, 200000, 0, -50};
  int columns = 0, rows = 0;
  GDALDataType type = GDT_Float32;
  std::vector<double> posts;  ///< row by row
  double nodata = std::numeric_limits<double>::quiet_NaN();
  std::string unit;
  double scale = 1, offset = 0;
  std::vector<std::uint8_t> mask;
  int bands = 1;
};

inline GDALDriver& driver(const std::string& name) {
  GDALAllRegister();
  GDALDriver* found = GetGDALDriverManager()->GetDriverByName(name.c_str());
  if (!found) throw std::runtime_error("no GDAL driver " + name);
  return *found;
}

/// Writes through memory, since several formats can only be copied into.
inline void write_raster(const std::string& path, MadeRaster made) {
  const GDALDatasetUniquePtr memory(driver("MEM").Create("", made.columns, made.rows, made.bands, made.type, nullptr));
  if (made.transform != std::array<double, 6>{}) memory->SetGeoTransform(made.transform.data());
  if (!made.crs.empty()) {
    OGRSpatialReference crs;
    ASSERT_EQ(crs.SetFromUserInput(made.crs.c_str()), OGRERR_NONE);
    memory->SetSpatialRef(&crs);
  }
  GDALRasterBand& band = *memory->GetRasterBand(1);
  ASSERT_EQ(band.RasterIO(GF_Write, 0, 0, made.columns, made.rows, made.posts.data(), made.columns, made.rows,
                          GDT_Float64, 0, 0, nullptr),
            CE_None);
  if (!std::isnan(made.nodata)) band.SetNoDataValue(made.nodata);
  if (!made.unit.empty()) band.SetUnitType(made.unit.c_str());
  if (made.scale != 1) band.SetScale(made.scale);
  if (made.offset != 0) band.SetOffset(made.offset);
  if (!made.mask.empty()) {
    memory->CreateMaskBand(GMF_PER_DATASET);
    ASSERT_EQ(band.GetMaskBand()->RasterIO(GF_Write, 0, 0, made.columns, made.rows, made.mask.data(), made.columns,
                                           made.rows, GDT_Byte, 0, 0, nullptr),
              CE_None);
  }
  const GDALDatasetUniquePtr written(
      driver(made.driver).CreateCopy(path.c_str(), memory.get(), FALSE, nullptr, nullptr, nullptr));
  ASSERT_NE(written, nullptr) << CPLGetLastErrorMsg();
}

inline void copy_raster(const std::string& format, const std::string& from, const std::string& to,
                        const std::vector<std::string>& options = {}) {
  const GDALDatasetUniquePtr source(GDALDataset::Open(from.c_str()));
  CPLStringList list;
  for (const std::string& option : options) list.AddString(option.c_str());
  const GDALDatasetUniquePtr copy(
      driver(format).CreateCopy(to.c_str(), source.get(), FALSE, list.List(), nullptr, nullptr));
  ASSERT_NE(copy, nullptr) << CPLGetLastErrorMsg();
}

inline void add_to_zip(const std::string& zip, const std::string& name, const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  VSILFILE* out = VSIFOpenL(("/vsizip/" + zip + "/" + name).c_str(), "wb");
  ASSERT_NE(out, nullptr);
  EXPECT_EQ(VSIFWriteL(bytes.data(), 1, bytes.size(), out), bytes.size());
  VSIFCloseL(out);
}

/// The result that the import of a raster should have.
struct SlowReading {
  std::vector<GridPoint> points;  ///< sorted
  std::uint64_t voids = 0;
};

struct SlowRules {
  double metres_per_height = 1;
  std::string crs = {};                                        ///< overrides the file's
  bool (*is_void)(double raw) = [](double) { return false; };  ///< beside nodata and NaN
};

inline SlowReading read_slowly(const std::string& path, const ImportPlan& plan, const SlowRules& rules = {}) {
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str()));
  if (!dataset) throw std::runtime_error(path);
  OGRSpatialReference from, to;
  if (rules.crs.empty()) {
    from = *dataset->GetSpatialRef();
  } else {
    from.SetFromUserInput(rules.crs.c_str());
  }
  to.SetFromUserInput(plan.crs_wkt.c_str());
  for (OGRSpatialReference* crs : {&from, &to}) crs->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const bool same = from.IsSame(&to);
  const std::unique_ptr<OGRCoordinateTransformation> transformation(OGRCreateCoordinateTransformation(&from, &to));
  std::array<double, 6> t{};
  dataset->GetGeoTransform(t.data());
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  const int columns = dataset->GetRasterXSize(), rows = dataset->GetRasterYSize();
  std::vector<double> posts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<std::uint8_t> valid(posts.size());
  EXPECT_EQ(band.RasterIO(GF_Read, 0, 0, columns, rows, posts.data(), columns, rows, GDT_Float64, 0, 0, nullptr),
            CE_None);
  EXPECT_EQ(
      band.GetMaskBand()->RasterIO(GF_Read, 0, 0, columns, rows, valid.data(), columns, rows, GDT_Byte, 0, 0, nullptr),
      CE_None);
  SlowReading reading;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
      if (!valid[i] || std::isnan(posts[i]) || rules.is_void(posts[i])) {
        ++reading.voids;
        continue;
      }
      double x = t[0] + (column + 0.5) * t[1] + (row + 0.5) * t[2],
             y = t[3] + (column + 0.5) * t[4] + (row + 0.5) * t[5];
      if (!same && !transformation->Transform(1, &x, &y)) throw std::runtime_error("cannot transform");
      const double z = (posts[i] * band.GetScale() + band.GetOffset()) * rules.metres_per_height;
      reading.points.push_back({static_cast<std::int32_t>(std::lround((x - plan.grid.origin.x) / plan.grid.resolution)),
                                static_cast<std::int32_t>(std::lround((y - plan.grid.origin.y) / plan.grid.resolution)),
                                static_cast<std::int32_t>(std::lround(z / plan.grid.resolution))});
    }
  }
  std::sort(reading.points.begin(), reading.points.end());
  return reading;
}

/// The result that the import of a plan's source has.
struct Reading {
  std::vector<GridPoint> points;  ///< sorted
  ReadCounts counts;
  SourceInfo info;
};

inline Reading read(TerrainSource& source) {
  Reading reading;
  NoProgress progress;
  reading.counts = source.read(
      [&](std::span<const GridPoint> points) {
        reading.points.insert(reading.points.end(), points.begin(), points.end());
      },
      progress);
  reading.info = source.info();
  std::sort(reading.points.begin(), reading.points.end());
  return reading;
}

/// Expects both to be equal. One post in a hundred thousand may fall on the other side of a half and differ by one grid
/// step, since both sides compute positions in their own order.
inline void expect_same(const Reading& reading, const SlowReading& truth) {
  EXPECT_EQ(reading.counts.read, truth.points.size());
  EXPECT_EQ(reading.counts.voids, truth.voids);
  std::vector<GridPoint> extra, missing;
  std::set_difference(reading.points.begin(), reading.points.end(), truth.points.begin(), truth.points.end(),
                      std::back_inserter(extra));
  std::set_difference(truth.points.begin(), truth.points.end(), reading.points.begin(), reading.points.end(),
                      std::back_inserter(missing));
  ASSERT_EQ(extra.size(), missing.size());
  ASSERT_LE(extra.size(), truth.points.size() / 100000);
  for (std::size_t i = 0; i < extra.size(); ++i) {
    EXPECT_LE(std::abs(extra[i].x - missing[i].x), 1);
    EXPECT_LE(std::abs(extra[i].y - missing[i].y), 1);
    EXPECT_LE(std::abs(extra[i].z - missing[i].z), 1);
  }
}

}  // namespace itin::test
