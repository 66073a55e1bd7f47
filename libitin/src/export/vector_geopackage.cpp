#include <memory>

#include <cpl_conv.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>
#include <itin/vector_export.hpp>

#include "export/pending_file.hpp"
#include "gdal/quiet_gdal.hpp"

namespace itin {

namespace {

class LayerWriter {
 public:
  LayerWriter(const PendingFile& output, const std::string& crs_wkt) : path_(output.path()) {
    require(crs_.SetFromUserInput(crs_wkt.c_str()) == OGRERR_NONE, "the store's CRS is not understood");
    crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    require(driver != nullptr, "this GDAL has no GeoPackage driver; choose another ending");
    dataset_.reset(driver->Create(output.temporary_path().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    require(dataset_ != nullptr, "cannot be created");
  }

  void add(const VectorLayer& layer) {
    const bool points = layer.shape == VectorLayer::Shape::kPoints;
    OGRLayer* to = dataset_->CreateLayer(layer.name.c_str(), &crs_, points ? wkbPoint25D : wkbLineString25D, nullptr);
    require(to != nullptr, "cannot be written");
    for (const auto& [name, type] : layer.fields) {
      constexpr OGRFieldType kTypes[] = {OFTReal, OFTInteger64, OFTString};
      OGRFieldDefn field(name.c_str(), kTypes[static_cast<int>(type)]);
      require(to->CreateField(&field) == OGRERR_NONE, "cannot be written");
    }
    for (const VectorLayer::Feature& feature : layer.features) {
      OGRFeature row(to->GetLayerDefn());
      for (std::size_t i = 0; i < feature.values.size(); ++i) set(row, static_cast<int>(i), feature.values[i]);
      set_geometry(row, feature.points, points);
      require(to->CreateFeature(&row) == OGRERR_NONE, "cannot be written");
    }
  }

  void close() {
    CPLErrorReset();
    dataset_.reset();
    require(!QuietGdal::failed(), "cannot be written");
  }

 private:
  static void set(OGRFeature& row, int field, const VectorLayer::Value& value) {
    if (const auto* number = std::get_if<double>(&value)) row.SetField(field, *number);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) row.SetField(field, static_cast<GIntBig>(*whole));
    if (const auto* text = std::get_if<std::string>(&value)) row.SetField(field, text->c_str());
  }
  static void set_geometry(OGRFeature& row, const std::vector<Point3>& points, bool point) {
    if (point) {
      row.SetGeometryDirectly(new OGRPoint(points.front().x, points.front().y, points.front().z));
      return;
    }
    auto line = std::make_unique<OGRLineString>();
    for (const Point3& p : points) line->addPoint(p.x, p.y, p.z);
    row.SetGeometryDirectly(line.release());
  }
  void require(bool condition, const char* otherwise) const {
    if (!condition) throw FileError(path_, QuietGdal::message(otherwise));
  }

  std::string path_;
  OGRSpatialReference crs_;
  GDALDatasetUniquePtr dataset_;
};

}  // namespace

void write_geopackage(const std::string& path, const std::string& crs_wkt, const std::vector<VectorLayer>& layers,
                      bool overwrite) {
  const QuietGdal quiet;
  // Equal calls give equal bytes only if the file does not say when it was written.
  const CPLConfigOptionSetter fixed("OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z", false);
  // The file has its name only when it is complete: no step on the way there has to be kept.
  const CPLConfigOptionSetter unsynced("OGR_SQLITE_SYNCHRONOUS", "OFF", false);
  const CPLConfigOptionSetter in_memory("OGR_SQLITE_JOURNAL", "MEMORY", false);
  PendingFile output(path, overwrite);
  LayerWriter writer(output, crs_wkt);
  for (const VectorLayer& layer : layers) writer.add(layer);
  writer.close();
  output.commit();
}

}  // namespace itin
