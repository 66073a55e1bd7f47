#include <memory>

#include <itin/plain_text.hpp>
#include <itin/vector_export.hpp>

#include "export/geopackage.hpp"
#include "export/polygon_style.hpp"
#include "export/region_layer.hpp"

namespace itin {

namespace {

void set(OGRFeature& row, int field, const VectorLayer::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) row.SetField(field, *number);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) row.SetField(field, static_cast<GIntBig>(*whole));
  if (const auto* text = std::get_if<std::string>(&value)) row.SetField(field, printable_text(*text).c_str());
}

void set_geometry(OGRFeature& row, const std::vector<Point3>& points, bool point) {
  if (point) {
    row.SetGeometryDirectly(new OGRPoint(points.front().x, points.front().y, points.front().z));
    return;
  }
  auto line = std::make_unique<OGRLineString>();
  for (const Point3& p : points) line->addPoint(p.x, p.y, p.z);
  row.SetGeometryDirectly(line.release());
}

void add(GeoPackage& package, const VectorLayer& layer, const Progress& progress) {
  const bool points = layer.shape == VectorLayer::Shape::kPoints;
  OGRLayer& to = package.add_layer(layer.name, points ? wkbPoint25D : wkbLineString25D);
  for (const auto& [name, type] : layer.fields) {
    constexpr OGRFieldType kTypes[] = {OFTReal, OFTInteger64, OFTString};
    package.add_field(to, name, kTypes[static_cast<int>(type)]);
  }
  for (const VectorLayer::Feature& feature : layer.features) {
    progress.throw_if_cancelled();
    OGRFeature row(to.GetLayerDefn());
    for (std::size_t i = 0; i < feature.values.size(); ++i) set(row, static_cast<int>(i), feature.values[i]);
    set_geometry(row, feature.points, points);
    package.add(to, row);
  }
}

}  // namespace

void write_geopackage(const std::string& path, const std::string& crs_wkt, const std::vector<VectorLayer>& layers,
                      bool overwrite, const Progress& progress, const std::vector<RegionLayer>& regions) {
  PendingFile output(path, overwrite);
  GeoPackage package(output, crs_wkt);
  std::vector<std::pair<std::string, std::string>> styles;
  for (const VectorLayer& layer : layers) {
    add(package, layer, progress);
    if (!layer.style.empty()) styles.emplace_back(layer.name, layer.style);
  }
  for (const RegionLayer& layer : regions) styles.push_back(add_regions(package, layer));
  package.require(styles.empty() || add_layer_styles(package.dataset(), styles));
  package.close();
  output.commit();
}

}  // namespace itin
