// Regions of a raster as polygons: areas of cells of equal value, dissolved.
//
//   RegionDescription description;
//   description.crs_wkt = store.metadata().crs_wkt;
//   description.layer = "viewshed";
//   description.classes = {{1, "visible"}};                  // cells of other values belong to no region
//   write_regions("visible.gpkg", grid, std::span<const std::uint8_t>(values), description);
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <itin/raster.hpp>

namespace itin {

struct RegionClass {
  std::uint32_t value = 0;
  std::string name;
  Rgba colour{0, 114, 178};  ///< QGIS draws the class in this colour
};

/// The regions of a raster as one of several layers of a file; vector_export.hpp writes it.
struct RegionLayer {
  std::string name;
  RasterGrid grid;
  std::vector<std::uint8_t> values;  ///< one for each cell
  std::vector<RegionClass> classes;
};

struct RegionDescription {
  std::string crs_wkt;
  std::string layer = "regions";
  std::vector<RegionClass> classes;
  bool overwrite = false;
};

/// Writes a GeoPackage, or GeoJSON where the name ends in .geojson, with one multipolygon per class that has cells, in
/// the order of the classes. Its fields are `value`, `class` (the class's name) and `area_m2` (the area of its cells).
/// Outlines follow the cells' edges; cells that meet only at a corner are apart. A second table of a GeoPackage,
/// `layer_styles`, has QGIS open the layer in the classes' colours. Precondition: values.size() == grid.cell_count().
/// Equal calls write equal bytes. Throws FileError if the file exists and may not be replaced, or cannot be written,
/// and InputError for GeoJSON in a CRS without EPSG code.
void write_regions(const std::string& path, const RasterGrid& grid, std::span<const std::uint8_t> values,
                   const RegionDescription& description);
void write_regions(const std::string& path, const RasterGrid& grid, std::span<const std::uint16_t> values,
                   const RegionDescription& description);
void write_regions(const std::string& path, const RasterGrid& grid, std::span<const std::uint32_t> values,
                   const RegionDescription& description);

}  // namespace itin
