#include <algorithm>
#include <map>
#include <memory>

#include <gdal_alg.h>
#include <gdal_priv.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/precondition.hpp>
#include <itin/raster_regions.hpp>

#include "export/buffered_file.hpp"
#include "export/export_metadata.hpp"
#include "export/geopackage.hpp"
#include "export/polygon_style.hpp"
#include "export/region_layer.hpp"
#include "gdal/files/drivers.hpp"
#include "gdal/files/memory_raster.hpp"

namespace itin {

namespace {

void require(bool condition, const std::string& path, const char* otherwise) {
  if (!condition) throw FileError(path, QuietGdal::message(otherwise));
}

struct Region {
  std::unique_ptr<OGRMultiPolygon> shape = std::make_unique<OGRMultiPolygon>();
  std::uint64_t cells = 0;

  void add(const OGRGeometry& polygon) {
    // Outlines that touch themselves at a cell's corner are not valid by the standard.
    const std::unique_ptr<OGRGeometry> valid(polygon.IsValid() ? polygon.clone() : polygon.MakeValid());
    if (!valid) return;
    if (wkbFlatten(valid->getGeometryType()) == wkbPolygon) {
      shape->addGeometry(valid.get());
    } else if (OGR_GT_IsSubClassOf(wkbFlatten(valid->getGeometryType()), wkbGeometryCollection)) {
      for (const OGRGeometry* part : *valid->toGeometryCollection())
        if (wkbFlatten(part->getGeometryType()) == wkbPolygon) shape->addGeometry(part);
    }
  }
};

using Regions = std::map<std::uint32_t, Region>;

template <class T>
void trace(const std::string& path, const RasterGrid& grid, std::span<const T> values, GDALDataType type,
           Regions& regions) {
  std::vector<std::uint8_t> mask(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto region = regions.find(values[i]);
    if (region == regions.end()) continue;
    mask[i] = 1;
    ++region->second.cells;
  }
  const GDALDatasetUniquePtr raster = memory_raster(grid);
  add_band(*raster, values, type);
  add_band(*raster, std::span<const std::uint8_t>(mask), GDT_Byte);

  GDALDatasetUniquePtr polygons(written_driver("Memory")->Create("", 0, 0, 0, GDT_Unknown, nullptr));
  OGRLayer* const layer = polygons->CreateLayer("polygons", nullptr, wkbPolygon, nullptr);
  OGRFieldDefn field("value", OFTInteger64);
  require(layer != nullptr && layer->CreateField(&field) == OGRERR_NONE, path, "its regions cannot be traced");
  require(GDALPolygonize(raster->GetRasterBand(1), raster->GetRasterBand(2), OGRLayer::ToHandle(layer), 0, nullptr,
                         nullptr, nullptr) == CE_None,
          path, "its regions cannot be traced");
  for (const OGRFeatureUniquePtr& feature : *layer)
    regions.at(static_cast<std::uint32_t>(feature->GetFieldAsInteger64(0))).add(*feature->GetGeometryRef());
}

/// Adds the layer of these regions. Returns its name and its style.
std::pair<std::string, std::string> add_region_layer(GeoPackage& package, const std::string& name,
                                                     const RasterGrid& grid, const std::vector<RegionClass>& classes,
                                                     Regions& regions) {
  OGRLayer& layer = package.add_layer(name, wkbMultiPolygon);
  for (const auto& [field, type] :
       {std::pair{"value", OFTInteger64}, std::pair{"class", OFTString}, std::pair{"area_m2", OFTReal}})
    package.add_field(layer, field, type);
  for (const RegionClass& c : classes) {
    Region& region = regions.at(c.value);
    if (region.cells == 0) continue;
    OGRFeature row(layer.GetLayerDefn());
    row.SetField(0, static_cast<GIntBig>(c.value));
    row.SetField(1, c.name.c_str());
    row.SetField(2, static_cast<double>(region.cells) * grid.cell_area());
    row.SetGeometryDirectly(region.shape.release());
    package.add(layer, row);
  }
  return {name, polygon_style(classes)};
}

/// Returns the regions of values that are of a class.
template <class T>
Regions regions_of(const std::string& path, const RasterGrid& grid, std::span<const T> values, GDALDataType type,
                   const std::vector<RegionClass>& classes) {
  ITIN_PRECONDITION(values.size() == grid.cell_count());
  Regions regions;
  for (const RegionClass& c : classes) regions[c.value];
  trace(path, grid, values, type, regions);
  return regions;
}

void write_geojson_layer(const PendingFile& output, const RasterGrid& grid, const Regions& regions,
                         const RegionDescription& description) {
  const std::string urn = crs_urn(description.crs_wkt);
  BufferedFile file(output);
  file.print(R"({{"type":"FeatureCollection","name":{},)", dumped(description.layer));
  if (!urn.empty()) file.print(R"("crs":{{"type":"name","properties":{{"name":"{}"}}}},)", urn);
  file.write("\"features\":[");
  const char* separator = "\n";
  for (const RegionClass& c : description.classes) {
    const Region& region = regions.at(c.value);
    if (region.cells == 0) continue;
    const nlohmann::ordered_json properties{
        {"value", c.value}, {"class", c.name}, {"area_m2", static_cast<double>(region.cells) * grid.cell_area()}};
    const std::unique_ptr<char, decltype(&VSIFree)> shape(region.shape->exportToJson(), &VSIFree);
    require(shape != nullptr, output.path(), "its regions cannot be written");
    file.print(R"({}{{"type":"Feature","properties":{},"geometry":)", separator, dumped(properties));
    file.write(shape.get());
    file.write("}");
    separator = ",\n";
  }
  file.write("\n]}\n");
  file.close();
}

template <class T>
void write_polygons(const std::string& path, const RasterGrid& grid, std::span<const T> values, GDALDataType type,
                    const RegionDescription& description) {
  const QuietGdal quiet;
  PendingFile output(path, description.overwrite);
  Regions regions = regions_of(path, grid, values, type, description.classes);
  if (ending_of(path) == ".geojson") {
    write_geojson_layer(output, grid, regions, description);
  } else {
    GeoPackage package(output, description.crs_wkt);
    const auto style = add_region_layer(package, description.layer, grid, description.classes, regions);
    package.require(add_layer_styles(package.dataset(), {style}));
    package.close();
  }
  output.commit();
}

}  // namespace

std::pair<std::string, std::string> add_regions(GeoPackage& package, const RegionLayer& layer) {
  const std::span<const std::uint8_t> values(layer.values);
  Regions regions = regions_of(package.path(), layer.grid, values, GDT_Byte, layer.classes);
  return add_region_layer(package, layer.name, layer.grid, layer.classes, regions);
}

void write_regions(const std::string& path, const RasterGrid& grid, std::span<const std::uint8_t> values,
                   const RegionDescription& description) {
  write_polygons(path, grid, values, GDT_Byte, description);
}

void write_regions(const std::string& path, const RasterGrid& grid, std::span<const std::uint16_t> values,
                   const RegionDescription& description) {
  write_polygons(path, grid, values, GDT_UInt16, description);
}

void write_regions(const std::string& path, const RasterGrid& grid, std::span<const std::uint32_t> values,
                   const RegionDescription& description) {
  write_polygons(path, grid, values, GDT_UInt32, description);
}

}  // namespace itin
