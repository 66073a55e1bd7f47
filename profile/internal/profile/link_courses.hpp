// Finds where on the Earth the ends of many links are, and the geodesics between them.
//
//   std::future<LinkCourses> courses = beside([&] { return link_courses(links, crs_wkt, progress); });
//   const std::vector<LinkResult> results = survey_links(store, links, query, progress);
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <profile/links.hpp>

namespace itin::profile {

/// One course per link, in order; nothing where an end is no place on the Earth.
using LinkCourses = std::vector<std::optional<LinkCourse>>;

/// Finds the courses of links in a CRS, given as WKT. Reports no progress. Throws InputError for a CRS that has no
/// longitude and latitude, Cancelled.
LinkCourses link_courses(const std::vector<Link>& links, const std::string& crs_wkt, const Progress& progress);

}  // namespace itin::profile
