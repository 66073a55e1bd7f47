#include "import/rasters/raster_lattice.hpp"

#include <array>

#include <gdal_priv.h>

#include <itin/error.hpp>

namespace itin {

RasterLattice lattice_of(GDALDataset& dataset, const std::string& path) {
  std::array<double, 6> t{};
  if (dataset.GetGeoTransform(t.data()) != CE_None || t[1] * t[5] - t[2] * t[4] == 0)
    throw InputError(path + ": has no georeference; give it one, with gdal_translate -a_ullr or gdalwarp");
  return {dataset.GetRasterXSize(),
          dataset.GetRasterYSize(),
          {t[0] + (t[1] + t[2]) / 2, t[3] + (t[4] + t[5]) / 2},
          {t[1], t[4]},
          {t[2], t[5]}};
}

}  // namespace itin
