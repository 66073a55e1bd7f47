// GeoJSON files of lines and polygons for tests, in EPSG:27700.
#pragma once

#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <itin/geometry.hpp>

namespace itin::test {

struct LineFeature {
  std::vector<Point3> vertices;
  bool polygon = false;
  std::string properties = "{}";  ///< JSON
};

/// The outline of a box with sides along the axes; its field h is the height of what stands there.
inline LineFeature box(double x0, double y0, double x1, double y1, double height) {
  return {.vertices = {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}, {x0, y0, 0}},
          .polygon = true,
          .properties = fmt::format(R"({{"h":{}}})", height)};
}

/// A box about a place, turned by an angle, radians.
inline LineFeature turned_box(Point2 centre, double width, double depth, double turn, double height) {
  LineFeature f{.vertices = {}, .polygon = true, .properties = fmt::format(R"({{"h":{:.2f}}})", height)};
  const double w = width / 2, d = depth / 2;
  for (const auto& [u, v] : {std::pair{-w, -d}, {w, -d}, {w, d}, {-w, d}, {-w, -d}})
    f.vertices.push_back(
        {centre.x + u * std::cos(turn) - v * std::sin(turn), centre.y + u * std::sin(turn) + v * std::cos(turn), 0});
  return f;
}

/// Writes 3D coordinates, or 2D ones where `flat`.
inline void write_lines(const std::string& path, const std::vector<LineFeature>& features, bool flat = false) {
  std::string text =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::27700"}},"features":[)";
  for (std::size_t f = 0; f < features.size(); ++f) {
    std::string coordinates;
    for (const Point3& p : features[f].vertices) {
      coordinates += fmt::format("{}[{:.4f},{:.4f}{}]", coordinates.empty() ? "" : ",", p.x, p.y,
                                 flat ? "" : fmt::format(",{:.4f}", p.z));
    }
    text += fmt::format(R"({}{{"type":"Feature","properties":{},"geometry":{{"type":"{}","coordinates":{}{}{}}}}})",
                        f == 0 ? "" : ",", features[f].properties, features[f].polygon ? "Polygon" : "LineString",
                        features[f].polygon ? "[[" : "[", coordinates, features[f].polygon ? "]]" : "]");
  }
  std::ofstream(path) << text << "]}";
}

}  // namespace itin::test
