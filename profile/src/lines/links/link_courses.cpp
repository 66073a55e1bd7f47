#include <itin/celestial_body.hpp>
#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <profile/link_courses.hpp>

namespace itin::profile {

namespace {

std::optional<LinkCourse> course_of(const Link& link, const CoordinateTransform& to_geographic,
                                    const Ellipsoid& ellipsoid) {
  try {
    const Point2 from = to_geographic(link.from), to = to_geographic(link.to);
    const Geodesic line = geodesic(from, to, ellipsoid);
    return LinkCourse{from, to, line.distance_m, line.azimuth_deg, line.back_azimuth_deg};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

LinkCourses link_courses(const std::vector<Link>& links, const std::string& crs_wkt, const Progress& progress) {
  const CelestialBody body = body_of(crs_wkt);
  const CoordinateTransform to_geographic(crs_wkt, body.geographic_crs);
  LinkCourses courses;
  courses.reserve(links.size());
  for (const Link& link : links) {
    progress.throw_if_cancelled();
    courses.push_back(course_of(link, to_geographic, body.ellipsoid));
  }
  return courses;
}

}  // namespace itin::profile
