#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/output_file.hpp>
#include <profile/links.hpp>

#include "report/kml.hpp"
#include "report/link_columns.hpp"

namespace itin::profile {

namespace {

/// The rows of links that have a line.
std::vector<LinkRow> computed(const std::vector<LinkRow>& rows) {
  std::vector<LinkRow> some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some),
               [](const LinkRow& row) { return row.found() != nullptr; });
  return some;
}

/// The line from antenna to antenna.
std::vector<Point3> line_of(const LinkRow& row) {
  const Link& link = *row.link;
  const EndGrounds& ground = row.result->stands_on;
  return {{link.from.x, link.from.y, ground.from_m + link.from_height},
          {link.to.x, link.to.y, ground.to_m + link.to_height}};
}

std::string links_kml(const std::string& crs_wkt, const std::string& title, const std::vector<LinkRow>& rows,
                      const std::vector<LinkColumn>& columns) {
  Kml kml(crs_wkt, title);
  for (const SightVerdict verdict : {SightVerdict::kVisible, SightVerdict::kHidden, SightVerdict::kUndecided})
    kml.style(name_of(verdict), verdict_colour(verdict), 3);
  kml.style("error", "ff909090", 3);
  for (const LinkRow& row : computed(rows)) {
    Kml::Data data;
    for (const LinkColumn& column : columns) data.emplace_back(column.name, cell_text(column.cell(row)));
    kml.line(row.id, verdict_of(row), line_of(row), data);
  }
  return kml.finish();
}

}  // namespace

void require_link_format(const std::string& path) {
  for (const char* known : {".csv", ".gpkg", ".kml", ".pdf"})
    if (ending_of(path) == known) return;
  throw InputError(
      fmt::format("`output` '{}': links are written as a table, .csv, as lines, .gpkg or .kml, or as a page, .pdf",
                  path),
      "output");
}

void write_link_table(const LinkSurvey& survey, const std::vector<std::string>& paths, const LinkFileOptions& options) {
  for (const std::string& path : paths) require_link_format(path);
  const std::string& crs = survey.metadata.crs_wkt;
  const std::vector<LinkRow> rows = link_rows(survey);
  const std::vector<LinkColumn> columns = link_columns(survey, rows);
  for (const std::string& path : paths) {
    const std::string ending = ending_of(path);
    if (ending == ".gpkg") {
      write_geopackage(path, crs, {layer_of("links", VectorLayer::Shape::kLines, columns, computed(rows), line_of)},
                       options.overwrite);
    } else {
      write_file(path,
                 ending == ".pdf"   ? link_summary(survey, rows, options)
                 : ending == ".csv" ? csv_of(columns, rows)
                                    : links_kml(crs, options.title, rows, columns),
                 options.overwrite);
    }
  }
}

}  // namespace itin::profile
