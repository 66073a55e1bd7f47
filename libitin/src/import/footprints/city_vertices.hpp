// The vertices of a city model, in the CRS of the store.
//
//   CityVertices vertices(document, crs, metres, to_crs, path);
//   const std::size_t first = vertices.add(document.at("vertices"));     // placed()[first] is the document's vertex 0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <itin/geometry.hpp>

#include "gdal/crs.hpp"

namespace itin {

class CityVertices {
 public:
  /// `head` has the transform of the vertices, if there is one; `metres` is what heights are multiplied by. Throws
  /// BadCityJson, InputError.
  CityVertices(const nlohmann::json& head, const Crs& crs, double metres, const std::string& to_crs,
               const std::string& path);

  /// Adds the vertices of a document, and returns the number of the first. Throws BadCityJson.
  std::size_t add(const nlohmann::json& vertices);
  /// All vertices that were added; x and y are NaN where one has no place in the store's CRS.
  const std::vector<Point3>& placed() const { return placed_; }
  /// Returns vertices of a template, which a matrix of 16 numbers, row by row, takes to their places about a vertex
  /// that was added. Throws BadCityJson.
  std::vector<Point3> instance(const nlohmann::json& template_vertices, const nlohmann::json& matrix,
                               std::size_t about) const;
  /// The box of what was added, in the model's own CRS.
  const Box& extent() const { return extent_; }

 private:
  std::vector<Point3> place(const std::vector<Point3>& points) const;

  std::array<double, 3> scale_{1, 1, 1}, shift_{0, 0, 0};
  PointTransform transform_;
  double metres_;
  std::vector<Point3> own_, placed_;  ///< in the model's own CRS, and in the store's
  Box extent_;
};

}  // namespace itin
