#include <initializer_list>
#include <memory>

#include "export/export_metadata.hpp"
#include "export/geopackage.hpp"
#include "export/step_progress.hpp"
#include "export/tin/tin_formats.hpp"

namespace itin {

namespace {

OGRLayer& add_layer(GeoPackage& package, const char* name, OGRwkbGeometryType type, bool spatial_index,
                    std::initializer_list<const char*> ids, std::initializer_list<const char*> sources) {
  OGRLayer& layer = package.add_layer(name, type, spatial_index);
  for (const char* field : ids) package.add_field(layer, field, OFTInteger64);
  for (const char* field : sources) package.add_field(layer, field, OFTInteger);
  return layer;
}

/// Adds a feature to a layer that numbers its features itself.
void add_next(GeoPackage& package, OGRLayer& layer, OGRFeature& feature) {
  feature.SetFID(OGRNullFID);
  package.add(layer, feature);
}

void write_triangles(const Tin& tin, const TinExportOptions& options, GeoPackage& package, StepProgress& steps) {
  OGRLayer& layer = add_layer(package, "triangles", wkbPolygon25D, true, {"vertex_a", "vertex_b", "vertex_c"},
                              {"source_a", "source_b", "source_c"});
  if (!tin.raised_theme.empty()) package.add_field(layer, "theme", OFTString);
  OGRFeature feature(layer.GetLayerDefn());
  for (const Triangle& t : tin.triangles) {
    if (const std::uint16_t theme = tin.theme(t); theme != 0) {
      feature.SetField(6, theme_name(options, theme).c_str());
    } else if (!tin.raised_theme.empty()) {
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
    add_next(package, layer, feature);
    steps.step();
  }
}

/// Adds the vertices, without a spatial index, which takes ten times as long to build as the layer itself.
void add_vertex_layer(const Tin& tin, GeoPackage& package, StepProgress& steps) {
  OGRLayer& layer = add_layer(package, "vertices", wkbPoint25D, false, {"id"}, {"source"});
  OGRFeature feature(layer.GetLayerDefn());
  for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
    const Point3 p = tin.point(v);
    feature.SetField(0, static_cast<GIntBig>(tin.id(v)));
    feature.SetField(1, tin.sources[v]);
    feature.SetGeometryDirectly(new OGRPoint(p.x, p.y, p.z));
    add_next(package, layer, feature);
    steps.step();
  }
}

void add_line_layer(const Tin& tin, const std::vector<std::string>& theme_names, GeoPackage& package,
                    StepProgress& steps) {
  OGRLayer& layer = add_layer(package, "lines", wkbLineString25D, false, {"vertex_a", "vertex_b"}, {});
  package.add_field(layer, "theme", OFTString);
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
    add_next(package, layer, feature);
    steps.step();
  }
}

}  // namespace

void write_geopackage(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress) {
  GeoPackage package(output, options.crs_wkt);
  if (!parsed_metadata(options.metadata_json).empty())
    package.dataset().SetMetadataItem("METADATA_JSON", options.metadata_json.c_str());
  package.require(package.dataset().StartTransaction() == OGRERR_NONE);
  StepProgress steps(progress, tin.triangles.size() + tin.vertices.size() + tin.lines.size());
  write_triangles(tin, options, package, steps);
  add_vertex_layer(tin, package, steps);
  if (!tin.lines.empty()) add_line_layer(tin, options.theme_names, package, steps);
  package.require(package.dataset().CommitTransaction() == OGRERR_NONE);
  package.close();
}

}  // namespace itin
