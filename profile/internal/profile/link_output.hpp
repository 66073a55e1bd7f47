// Writes the table of many links, as files.
//
//   const LinkSurvey survey{table, results, courses, query, store.metadata().crs_wkt, "Backhaul", {}};
//   write_links(survey, {"links.csv", "links.gpkg", "links.kml", "links.pdf"}, false);
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <profile/link_courses.hpp>
#include <profile/links.hpp>

namespace itin::profile {

/// All that the files tell. Refers to the objects given, and has one result and one course per link of the table.
struct LinkSurvey {
  const LinkTable& table;
  const std::vector<LinkResult>& results;
  const LinkCourses& courses;
  const LinkQuery& query;
  std::string crs_wkt;
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< the inputs and the settings: name, value
};

/// Writes each file by its name's ending: .csv (a row per row of the table), .gpkg and .kml (the links that could be
/// computed, as lines), .pdf (one page: the number of links by verdict, and the links that need attention first). Equal
/// surveys give equal bytes. Throws what require_link_format() throws, and FileError.
void write_links(const LinkSurvey& survey, const std::vector<std::string>& paths, bool overwrite);

/// Throws InputError for any other ending than write_links() knows.
void require_link_format(const std::string& path);

}  // namespace itin::profile
