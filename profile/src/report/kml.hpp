// A KML document: points and lines at their elevations, for globes.
//
//   Kml kml(crs_wkt, "Backhaul");
//   kml.style("ray", kml_colour(class_of(SightVerdict::kVisible).colour), 3);
//   kml.line("Garth to Caerphilly", "ray", {a, b}, {{"distance_m", "7434.5"}});
//   write(kml.finish());
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <itin/coordinates.hpp>
#include <itin/geometry.hpp>
#include <itin/raster.hpp>
#include <profile/los.hpp>

namespace itin::profile {

/// A colour in KML's order, aabbggrr.
std::string kml_colour(const Rgba& colour);

class Kml {
 public:
  using Data = std::vector<std::pair<std::string, std::string>>;  ///< name, value

  /// Positions are in the CRS `crs_wkt`; the description may be empty. Texts are escaped here.
  Kml(const std::string& crs_wkt, const std::string& name, const std::string& description = {});

  /// Adds a style; to be called before the first line that has it.
  void style(const std::string& id, const std::string& colour, int width);
  void point(const std::string& name, const Point3& p);
  void line(const std::string& name, const std::string& style_id, const std::vector<Point3>& points,
            const Data& data = {});
  void open_folder(const std::string& name);
  void close_folder();
  /// Returns the file's text. Nothing can be added afterwards.
  std::string finish();

 private:
  std::string coordinates(const std::vector<Point3>& points) const;

  CoordinateTransform to_geographic_;
  std::string text_;
};

}  // namespace itin::profile
