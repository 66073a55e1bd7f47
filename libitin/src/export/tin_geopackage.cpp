#include <memory>

#include <cpl_conv.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>

#include "export/export_metadata.hpp"
#include "export/step_progress.hpp"
#include "export/tin_formats.hpp"
#include "gdal/quiet_gdal.hpp"

namespace itin {

namespace {

/// Equal Tins give equal bytes only if the file does not say when it was written.
class FixedTimestamps {
 public:
  FixedTimestamps() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z"); }
  ~FixedTimestamps() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr); }
  FixedTimestamps(const FixedTimestamps&) = delete;
  FixedTimestamps& operator=(const FixedTimestamps&) = delete;
};

class GeoPackage {
 public:
  GeoPackage(const PendingFile& output, const TinExportOptions& options) : path_(output.path()) {
    if (!options.crs_wkt.empty()) {
      crs_ = std::make_unique<OGRSpatialReference>();
      require(crs_->SetFromUserInput(options.crs_wkt.c_str()) == OGRERR_NONE, "the store's CRS is not understood");
      crs_->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    }
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    require(driver != nullptr, "this GDAL has no GeoPackage driver; choose another ending");
    dataset_.reset(driver->Create(output.temporary_path().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    require(dataset_ != nullptr, "cannot be created");
    if (!parsed_metadata(options.metadata_json).empty())
      dataset_->SetMetadataItem("METADATA_JSON", options.metadata_json.c_str());
    require(dataset_->StartTransaction() == OGRERR_NONE, "cannot be written");
  }

  OGRLayer& add_layer(const char* name, OGRwkbGeometryType type, const char* spatial_index,
                      std::initializer_list<const char*> ids, std::initializer_list<const char*> sources) {
    CPLStringList layer_options;
    layer_options.SetNameValue("SPATIAL_INDEX", spatial_index);
    OGRLayer* layer = dataset_->CreateLayer(name, crs_.get(), type, layer_options.List());
    require(layer != nullptr, "cannot be written");
    for (const char* field : ids) add_field(*layer, field, OFTInteger64);
    for (const char* field : sources) add_field(*layer, field, OFTInteger);
    return *layer;
  }
  void add_text_field(OGRLayer& layer, const char* name) { add_field(layer, name, OFTString); }
  void add(OGRLayer& layer, OGRFeature& feature) {
    feature.SetFID(OGRNullFID);
    require(layer.CreateFeature(&feature) == OGRERR_NONE, "cannot be written");
  }
  void close() {
    require(dataset_->CommitTransaction() == OGRERR_NONE, "cannot be written");
    CPLErrorReset();
    dataset_.reset();  // builds the spatial indices
    require(!QuietGdal::failed(), "cannot be written");
  }

 private:
  void add_field(OGRLayer& layer, const char* name, OGRFieldType type) {
    OGRFieldDefn field(name, type);
    require(layer.CreateField(&field) == OGRERR_NONE, "cannot be written");
  }
  void require(bool condition, const char* otherwise) const {
    if (!condition) throw FileError(path_, QuietGdal::message(otherwise));
  }

  std::string path_;
  std::unique_ptr<OGRSpatialReference> crs_;
  GDALDatasetUniquePtr dataset_;
};

void write_triangles(const Tin& tin, const TinExportOptions& options, GeoPackage& package, StepProgress& steps) {
  OGRLayer& layer = package.add_layer("triangles", wkbPolygon25D, "YES", {"vertex_a", "vertex_b", "vertex_c"},
                                      {"source_a", "source_b", "source_c"});
  if (!tin.standing.empty()) package.add_text_field(layer, "theme");
  OGRFeature feature(layer.GetLayerDefn());
  for (const Triangle& t : tin.triangles) {
    if (const std::uint16_t theme = tin.theme(t); theme != 0) {
      feature.SetField(6, theme_name(options, theme).c_str());
    } else if (!tin.standing.empty()) {
      feature.SetFieldNull(6);
    }
    auto ring = std::make_unique<OGRLinearRing>();
    ring->setNumPoints(4);
    for (int i = 0; i < 4; ++i) {
      const Point3 p = tin.point(t[static_cast<std::size_t>(i % 3)]);
      ring->setPoint(i, p.x, p.y, p.z);
    }
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = t[static_cast<std::size_t>(i)];
      feature.SetField(i, static_cast<GIntBig>(tin.id(v)));
      feature.SetField(3 + i, tin.sources[v]);
    }
    auto polygon = std::make_unique<OGRPolygon>();
    polygon->addRingDirectly(ring.release());
    feature.SetGeometryDirectly(polygon.release());
    package.add(layer, feature);
    steps.step();
  }
}

/// Without a spatial index, which takes ten times as long to build as the layer itself.
void add_vertex_layer(const Tin& tin, GeoPackage& package, StepProgress& steps) {
  OGRLayer& layer = package.add_layer("vertices", wkbPoint25D, "NO", {"id"}, {"source"});
  OGRFeature feature(layer.GetLayerDefn());
  for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
    const Point3 p = tin.point(v);
    feature.SetField(0, static_cast<GIntBig>(tin.id(v)));
    feature.SetField(1, tin.sources[v]);
    feature.SetGeometryDirectly(new OGRPoint(p.x, p.y, p.z));
    package.add(layer, feature);
    steps.step();
  }
}

void add_line_layer(const Tin& tin, const std::vector<std::string>& theme_names, GeoPackage& package,
                    StepProgress& steps) {
  OGRLayer& layer = package.add_layer("lines", wkbLineString25D, "NO", {"vertex_a", "vertex_b"}, {});
  package.add_text_field(layer, "theme");
  OGRFeature feature(layer.GetLayerDefn());
  for (const LineEdge& e : tin.lines) {
    auto line = std::make_unique<OGRLineString>();
    for (const std::uint32_t v : {e.from, e.to}) {
      const Point3 p = tin.point(v);
      line->addPoint(p.x, p.y, p.z);
    }
    feature.SetField(0, static_cast<GIntBig>(tin.id(e.from)));
    feature.SetField(1, static_cast<GIntBig>(tin.id(e.to)));
    feature.SetField(2, e.theme <= theme_names.size() ? theme_names[e.theme - std::size_t{1}].c_str() : "");
    feature.SetGeometryDirectly(line.release());
    package.add(layer, feature);
    steps.step();
  }
}

}  // namespace

void write_geopackage(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress) {
  const QuietGdal quiet;
  const FixedTimestamps fixed;
  GeoPackage package(output, options);
  StepProgress steps(progress, tin.triangles.size() + tin.vertices.size() + tin.lines.size());
  write_triangles(tin, options, package, steps);
  add_vertex_layer(tin, package, steps);
  if (!tin.lines.empty()) add_line_layer(tin, options.theme_names, package, steps);
  package.close();
}

}  // namespace itin
