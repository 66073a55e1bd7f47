#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/tin_export.hpp>
#include <itin/vector_export.hpp>

#include "export/pending_file.hpp"
#include "topology/joined_lines.hpp"

namespace itin {

namespace {

double length_of(const std::vector<Point3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return length;
}

void add_lines(const Tin& tin, std::uint16_t theme, const std::string& name, VectorLayer& layer) {
  for (const JoinedLine& line : joined_lines(tin, theme)) {
    VectorLayer::Feature feature;
    for (const std::uint32_t vertex : line.vertices) feature.points.push_back(tin.point(vertex));
    feature.values = {name, length_of(feature.points)};
    layer.features.push_back(std::move(feature));
  }
}

}  // namespace

void require_lines_output(const std::string& path, bool overwrite) {
  if (ending_of(path) != ".gpkg")
    throw InputError(fmt::format("{}: lines are written as a GeoPackage; end the name in .gpkg", path));
  PendingFile::require_possible(path, overwrite);
}

std::size_t export_lines(const Tin& tin, const std::vector<std::uint16_t>& themes, const std::string& path,
                         const TinExportOptions& options) {
  require_lines_output(path, options.overwrite);
  VectorLayer layer{"lines",
                    VectorLayer::Shape::kLines,
                    {{"theme", VectorLayer::Type::kText}, {"length_m", VectorLayer::Type::kNumber}},
                    {}};
  for (const std::uint16_t theme : themes) add_lines(tin, theme, options.theme_names.at(theme - std::size_t{1}), layer);
  write_geopackage(path, options.crs_wkt, {layer}, options.overwrite);
  return layer.features.size();
}

}  // namespace itin
