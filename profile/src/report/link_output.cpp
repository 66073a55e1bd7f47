#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/output_file.hpp>
#include <profile/links.hpp>

#include "report/kml.hpp"
#include "report/link_columns.hpp"

namespace itin::profile {

namespace {

using Value = VectorLayer::Value;

/// Appends every digit of a number.
void append_value(std::string& text, const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) fmt::format_to(std::back_inserter(text), "{}", *number);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) fmt::format_to(std::back_inserter(text), "{}", *whole);
  if (const auto* words = std::get_if<std::string>(&value)) text += *words;
}

std::string links_csv(const std::vector<LinkRow>& rows, const std::vector<LinkColumn>& columns) {
  std::string csv;
  const auto add_row = [&](const auto& cell_of) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i > 0) csv += ',';
      const Value cell = cell_of(columns[i]);
      const auto* words = std::get_if<std::string>(&cell);
      append_value(csv, words != nullptr ? csv_cell(*words) : cell);
    }
    csv += '\n';
  };
  add_row([](const LinkColumn& column) { return Value(column.name); });
  for (const LinkRow& row : rows) add_row([&](const LinkColumn& column) { return column.value(row); });
  return csv;
}

/// The line from antenna to antenna.
std::vector<Point3> line_of(const LinkRow& row) {
  const Link& link = *row.link;
  const EndGrounds& ground = row.result->stands_on;
  return {{link.from.x, link.from.y, ground.from_m + link.from_height},
          {link.to.x, link.to.y, ground.to_m + link.to_height}};
}

VectorLayer links_layer(const std::vector<LinkRow>& rows, const std::vector<LinkColumn>& columns) {
  VectorLayer layer{"links", VectorLayer::Shape::kLines, {}, {}};
  for (const LinkColumn& column : columns) layer.fields.emplace_back(column.name, column.type);
  for (const LinkRow& row : rows) {
    if (row.found() == nullptr) continue;
    VectorLayer::Feature feature{line_of(row), {}};
    for (const LinkColumn& column : columns) feature.values.push_back(column.value(row));
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

std::string links_kml(const std::string& crs_wkt, const std::string& title, const std::vector<LinkRow>& rows,
                      const std::vector<LinkColumn>& columns) {
  Kml kml(crs_wkt, title);
  for (const SightVerdict verdict : {SightVerdict::kVisible, SightVerdict::kHidden, SightVerdict::kUndecided})
    kml.style(name_of(verdict), verdict_colour(verdict), 3);
  kml.style("error", "ff909090", 3);
  for (const LinkRow& row : rows) {
    if (row.found() == nullptr) continue;
    Kml::Data data;
    for (const LinkColumn& column : columns) append_value(data.emplace_back(column.name, "").second, column.value(row));
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
      write_geopackage(path, crs, {links_layer(rows, columns)}, options.overwrite);
    } else {
      write_file(path,
                 ending == ".pdf"   ? link_summary(survey, rows, options)
                 : ending == ".csv" ? links_csv(rows, columns)
                                    : links_kml(crs, options.title, rows, columns),
                 options.overwrite);
    }
  }
}

}  // namespace itin::profile
