#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>
#include <itin/window_source.hpp>

#include "gdal/crs.hpp"
#include "gdal/files/drivers.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "import/source/layers/source_layer.hpp"

namespace itin {

namespace {

using Geometry = std::unique_ptr<OGRGeometry>;

bool is_well_known_text(const std::string& text) {
  const auto start = std::find_if_not(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c); });
  std::string word;
  for (auto c = start; c != text.end() && std::isalpha(static_cast<unsigned char>(*c)); ++c)
    word += static_cast<char>(std::toupper(static_cast<unsigned char>(*c)));
  const bool bracketed = text.find('(') != std::string::npos || text.find("EMPTY") != std::string::npos;
  constexpr std::string_view kWords[] = {"POINT",        "LINESTRING",   "POLYGON",           "MULTIPOINT",
                                         "CURVEPOLYGON", "MULTISURFACE", "TRIANGLE",          "MULTILINESTRING",
                                         "MULTIPOLYGON", "TIN",          "GEOMETRYCOLLECTION"};
  return bracketed && std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

void transform(OGRGeometry& geometry, const std::string& from_crs, const std::string& to_crs) {
  const OGRSpatialReference from = horizontal_crs(from_crs, "polygon"), to = horizontal_crs(to_crs, "polygon");
  if (same_crs(from, to)) return;
  const std::unique_ptr<OGRCoordinateTransformation> transformation(OGRCreateCoordinateTransformation(&from, &to));
  if (!transformation || geometry.transform(transformation.get()) != OGRERR_NONE)
    throw InputError(fmt::format("polygon: its coordinates cannot be transformed from {} to {}",
                                 from.GetName() ? from.GetName() : "its CRS", to.GetName() ? to.GetName() : "the CRS"));
}

Window::Ring ring_of(const OGRLinearRing& ring) {
  Window::Ring corners;
  for (int i = 0; i < ring.getNumPoints(); ++i) corners.push_back({ring.getX(i), ring.getY(i)});
  return corners;
}

void append_polygons(const OGRGeometry& geometry, std::vector<Window::Polygon>& parts) {
  if (const auto type = wkbFlatten(geometry.getGeometryType()); type == wkbPolygon || type == wkbTriangle) {
    const OGRPolygon& polygon = *geometry.toPolygon();
    if (polygon.IsEmpty()) return;
    Window::Polygon part;
    part.outer = ring_of(*polygon.getExteriorRing());
    for (int i = 0; i < polygon.getNumInteriorRings(); ++i) part.holes.push_back(ring_of(*polygon.getInteriorRing(i)));
    parts.push_back(std::move(part));
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* member : *geometry.toGeometryCollection()) append_polygons(*member, parts);
  } else if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface)) {
    for (const OGRPolygon* member : *geometry.toPolyhedralSurface()) append_polygons(*member, parts);
  }
}

Geometry geometry_from_text(const std::string& text, const std::string& target_crs, const std::string& wkt_crs) {
  OGRGeometry* parsed = nullptr;
  const char* rest = text.c_str();
  const OGRErr error = OGRGeometryFactory::createFromWkt(&rest, nullptr, &parsed);
  Geometry geometry(parsed);
  const bool trailing = std::any_of(rest, text.c_str() + text.size(), [](unsigned char c) { return !std::isspace(c); });
  if (error != OGRERR_NONE || !geometry || trailing)
    throw InputError(
        fmt::format("polygon: '{}' is not well-known text; check brackets and numbers", text.substr(0, 60)));
  geometry.reset(geometry->getLinearGeometry());
  if (!wkt_crs.empty() && !target_crs.empty()) transform(*geometry, wkt_crs, target_crs);
  return geometry;
}

void append_layer(OGRLayer& layer, const std::string& target_crs, std::vector<Window::Polygon>& parts) {
  const OGRSpatialReference* crs = layer.GetSpatialRef();
  for (const auto& feature : layer) {
    if (!feature->GetGeometryRef()) continue;
    const Geometry geometry(feature->GetGeometryRef()->getLinearGeometry());
    if (crs && !target_crs.empty()) transform(*geometry, wkt_of(*crs), target_crs);
    append_polygons(*geometry, parts);
  }
}

std::vector<Window::Polygon> polygons_of_file(const std::string& path, const std::string& target_crs) {
  const GDALDatasetUniquePtr dataset = open_dataset(path, GDAL_OF_VECTOR);
  if (!dataset) throw FileError(path, "neither well-known text nor a vector file that can be read");
  std::vector<Window::Polygon> parts;
  for (OGRLayer* layer : dataset->GetLayers()) {
    if (holds_styles(*layer)) continue;
    append_layer(*layer, target_crs, parts);
    if (QuietGdal::failed()) throw FileError(path, QuietGdal::message("cannot be read"));
  }
  if (parts.empty()) throw InputError(path + ": holds no polygon");
  return parts;
}

}  // namespace

Window window_from_polygon(const std::string& wkt_or_file, const std::string& target_crs, const std::string& wkt_crs) {
  const QuietGdal quiet;
  if (!is_well_known_text(wkt_or_file)) return Window::polygons(polygons_of_file(wkt_or_file, target_crs));
  std::vector<Window::Polygon> parts;
  append_polygons(*geometry_from_text(wkt_or_file, target_crs, wkt_crs), parts);
  if (parts.empty()) throw InputError(fmt::format("polygon: '{}' holds no polygon", wkt_or_file.substr(0, 60)));
  return Window::polygons(std::move(parts));
}

}  // namespace itin
