
#include <itin/source_files.hpp>

#include "gdal/files/drivers.hpp"
#include "gdal/files/quiet_gdal.hpp"

namespace itin {

std::vector<std::string> source_files(const std::string& path) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_dataset(path, GDAL_OF_RASTER | GDAL_OF_VECTOR);
  if (!dataset) return {};
  const CPLStringList files(dataset->GetFileList());
  return {files.List(), files.List() + files.size()};
}

}  // namespace itin
