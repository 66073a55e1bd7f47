#include "report/kml.hpp"

#include <fmt/format.h>

#include <itin/markup.hpp>

namespace itin::profile {

std::string kml_colour(const Rgba& colour) {
  return fmt::format("ff{:02x}{:02x}{:02x}", colour.blue, colour.green, colour.red);
}

Kml::Kml(const std::string& crs_wkt, const std::string& name, const std::string& description)
    : to_geographic_(crs_wkt, "EPSG:4326") {
  text_ = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n"
      "<name>{}</name>\n",
      escaped_markup(name));
  if (!description.empty()) text_ += fmt::format("<description>{}</description>\n", escaped_markup(description));
}

void Kml::style(const std::string& id, const std::string& colour, int width) {
  text_ += fmt::format("<Style id=\"{}\"><LineStyle><color>{}</color><width>{}</width></LineStyle></Style>\n", id,
                       colour, width);
}

void Kml::point(const std::string& name, const Point3& p) {
  text_ += fmt::format(
      "<Placemark><name>{}</name><Point><altitudeMode>absolute</altitudeMode><coordinates>{}</coordinates></Point>"
      "</Placemark>\n",
      escaped_markup(name), coordinates({p}));
}

void Kml::line(const std::string& name, const std::string& style_id, const std::vector<Point3>& points,
               const Data& data) {
  text_ += fmt::format("<Placemark><name>{}</name><styleUrl>#{}</styleUrl>", escaped_markup(name), style_id);
  if (!data.empty()) {
    text_ += "<ExtendedData>";
    for (const auto& [field, value] : data)
      text_ += fmt::format("<Data name=\"{}\"><value>{}</value></Data>", escaped_markup(field), escaped_markup(value));
    text_ += "</ExtendedData>";
  }
  text_ += fmt::format(
      "<LineString><altitudeMode>absolute</altitudeMode><coordinates>{}</coordinates></LineString></Placemark>\n",
      coordinates(points));
}

void Kml::open_folder(const std::string& name) {
  text_ += "<Folder><name>" + escaped_markup(name) + "</name>\n";
}

void Kml::close_folder() {
  text_ += "</Folder>\n";
}

std::string Kml::finish() {
  return text_ + "</Document>\n</kml>\n";
}

std::string Kml::coordinates(const std::vector<Point3>& points) const {
  std::string text;
  for (const Point3& p : points) {
    const Point2 lon_lat = to_geographic_({p.x, p.y});
    text += fmt::format("{}{:.8f},{:.8f},{:.2f}", text.empty() ? "" : " ", lon_lat.x, lon_lat.y, p.z);
  }
  return text;
}

}  // namespace itin::profile
