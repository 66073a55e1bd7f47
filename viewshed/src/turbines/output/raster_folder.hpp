// The rasters of one zone in one folder, each with its QGIS style beside it.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <itin/output_file.hpp>
#include <itin/raster.hpp>
#include <itin/raster_in_parts.hpp>
#include <viewshed/zone_files.hpp>

namespace itin::viewshed {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr const char* kNoValue = "no value (beyond every turbine's radius, or no ground data)";

inline RasterDescription with_nodata(double value) {
  RasterDescription description;
  description.nodata = value;
  return description;
}

class RasterFolder {
 public:
  RasterFolder(std::string folder, const Zone& zone, const ZoneFileOptions& options)
      : folder_(std::move(folder)), zone_(zone), options_(options) {}

  template <class T>
  void write(const std::string& name, const std::string& what, const std::vector<T>& values,
             RasterDescription description, const std::string& style) {
    describe(name, what, description);
    write_raster(path(name + ".tif"), zone_.grid, std::span<const T>(values), description);
    add(name, what, style);
  }
  /// Writes the values that values_of(part), a vector of T, returns for each part of the zone, one band after the
  /// other.
  template <class T, class ValuesOf>
  void write_parts(const std::string& name, const std::string& what, const ValuesOf& values_of,
                   RasterDescription description, const std::string& style) {
    describe(name, what, description);
    write_raster_of<T>(path(name + ".tif"), zone_, values_of, description);
    add(name, what, style);
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::vector<ZoneFile> files() && { return std::move(files_); }

 private:
  void describe(const std::string& name, const std::string& what, RasterDescription& description) const {
    description.crs_wkt = options_.crs_wkt;
    description.overwrite = true;
    if (description.band_name.empty()) description.band_name = name;
    description.metadata = options_.metadata;
    description.metadata.emplace_back("what", what);
  }
  void add(const std::string& name, const std::string& what, const std::string& style) {
    if (!style.empty()) write_file(path(name + ".qml"), style, true);
    files_.push_back({name + ".tif", what});
  }

  std::string folder_;
  const Zone& zone_;
  const ZoneFileOptions& options_;
  std::vector<ZoneFile> files_;
};

}  // namespace itin::viewshed
