// Small rasters for tests: written by GDAL from a function, or cut out of real ones.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogr_spatialref.h>

namespace itin::test {

inline constexpr double kNoData = -9999;

struct RasterShape {
  double xmin = 300000;
  double ymax = 200000;
  double step = 50;
  int columns = 40;
  int rows = 40;
  int epsg = 27700;
};

/// Writes heights height(column, row) at cell centres as a Float32 GeoTIFF; NaN becomes nodata.
inline void write_raster(const std::string& path, const RasterShape& shape,
                         const std::function<double(int, int)>& height) {
  GDALAllRegister();
  auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  auto* dataset = driver->Create(path.c_str(), shape.columns, shape.rows, 1, GDT_Float32, nullptr);
  double transform[6] = {shape.xmin, shape.step, 0, shape.ymax, 0, -shape.step};
  dataset->SetGeoTransform(transform);
  OGRSpatialReference crs;
  crs.importFromEPSG(shape.epsg);
  dataset->SetSpatialRef(&crs);
  dataset->GetRasterBand(1)->SetNoDataValue(kNoData);
  std::vector<float> row(static_cast<std::size_t>(shape.columns));
  for (int r = 0; r < shape.rows; ++r) {
    for (int c = 0; c < shape.columns; ++c) {
      const double h = height(c, r);
      row[static_cast<std::size_t>(c)] = static_cast<float>(std::isnan(h) ? kNoData : h);
    }
    if (dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, r, shape.columns, 1, row.data(), shape.columns, 1, GDT_Float32,
                                            0, 0) != CE_None) {
      throw std::runtime_error("cannot write " + path);
    }
  }
  GDALClose(dataset);
}

/// The bundled real terrain about Cardiff, as a function of column and row of its 50 m lattice.
class CardiffTerrain {
 public:
  CardiffTerrain() {
    GDALAllRegister();
    auto* dataset = GDALDataset::Open((std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/cardiff.tif").c_str());
    columns_ = dataset->GetRasterXSize();
    heights_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(dataset->GetRasterYSize()));
    if (dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns_, dataset->GetRasterYSize(), heights_.data(),
                                            columns_, dataset->GetRasterYSize(), GDT_Float64, 0, 0) != CE_None) {
      throw std::runtime_error("cannot read the bundled terrain");
    }
    scale_ = dataset->GetRasterBand(1)->GetScale();
    GDALClose(dataset);
  }
  double operator()(int column, int row) const {
    return heights_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)] *
           scale_;
  }

 private:
  int columns_ = 0;
  double scale_ = 1;
  std::vector<double> heights_;
};

}  // namespace itin::test
