#include "import/footprints/city_vertices.hpp"

#include "import/footprints/city_json_values.hpp"

namespace itin {

CityVertices::CityVertices(const nlohmann::json& head, const Crs& crs, double metres, const std::string& to_crs,
                           const std::string& path)
    : transform_(crs.wkt, to_crs, path), metres_(metres) {
  if (!head.contains("transform")) return;
  scale_ = coordinates(member(head.at("transform"), "scale"), "scale of the transform");
  shift_ = coordinates(member(head.at("transform"), "translate"), "translate of the transform");
}

std::size_t CityVertices::add(const nlohmann::json& vertices) {
  std::vector<Point3> own;
  for (const nlohmann::json& vertex : items_of(vertices, "vertices")) {
    const std::array<double, 3> v = coordinates(vertex, "vertices");
    own.push_back({v[0] * scale_[0] + shift_[0], v[1] * scale_[1] + shift_[1], v[2] * scale_[2] + shift_[2]});
    extent_.extend(Point2{own.back().x, own.back().y});
  }
  const std::vector<Point3> placed = place(own);
  own_.insert(own_.end(), own.begin(), own.end());
  placed_.insert(placed_.end(), placed.begin(), placed.end());
  return placed_.size() - placed.size();
}

std::vector<Point3> CityVertices::instance(const nlohmann::json& template_vertices, const nlohmann::json& matrix,
                                           std::size_t about) const {
  std::array<double, 12> m{};
  for (std::size_t i = 0; i < m.size(); ++i) m[i] = items_of(matrix, "transformationMatrix").at(i).get<double>();
  const Point3& origin = own_[about];
  std::vector<Point3> points;
  for (const nlohmann::json& vertex : items_of(template_vertices, "vertices-templates")) {
    const auto [x, y, z] = coordinates(vertex, "vertices-templates");
    points.push_back({origin.x + m[0] * x + m[1] * y + m[2] * z + m[3],
                      origin.y + m[4] * x + m[5] * y + m[6] * z + m[7],
                      origin.z + m[8] * x + m[9] * y + m[10] * z + m[11]});
  }
  return place(points);
}

std::vector<Point3> CityVertices::place(const std::vector<Point3>& points) const {
  std::vector<double> x, y;
  for (const Point3& p : points) x.push_back(p.x), y.push_back(p.y);
  transform_.transform(x, y);
  std::vector<Point3> placed;
  for (std::size_t i = 0; i < points.size(); ++i) placed.push_back({x[i], y[i], points[i].z * metres_});
  return placed;
}

}  // namespace itin
