#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/output_file.hpp>
#include <profile/line_classes.hpp>
#include <profile/links.hpp>

#include "report/kml.hpp"
#include "report/links/link_columns.hpp"

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

/// An antenna of a link.
struct LinkEndRow {
  const LinkRow& link;
  bool first;
};

VectorLayer layer_of_ends(const std::vector<LinkRow>& rows) {
  constexpr std::array<FeatureClass, 2> kEnds{{{"1", "First end", {20, 60, 140}}, {"2", "Second end", {86, 180, 233}}}};
  const auto height = [](const LinkEndRow& row) {
    return row.first ? row.link.link->from_height : row.link.link->to_height;
  };
  const auto stands_on = [](const LinkEndRow& row) {
    const EndGrounds& grounds = row.link.result->stands_on;
    return row.first ? grounds.from_m : grounds.to_m;
  };
  const std::vector<TableColumn<LinkEndRow>> columns{
      {"id", [](const LinkEndRow& row) { return row.link.id; }},
      {"end", [](const LinkEndRow& row) { return row.first ? "1" : "2"; }},
      {"name", [](const LinkEndRow& row) { return row.first ? row.link.link->from_name : row.link.link->to_name; }},
      {"height_m", height},
      {"stands_on_m", stands_on}};
  std::vector<LinkEndRow> ends;
  for (const LinkRow& row : rows) ends.push_back({row, true}), ends.push_back({row, false});
  const auto place = [&](const LinkEndRow& row) {
    const Point2 at = row.first ? row.link.link->from : row.link.link->to;
    return std::vector<Point3>{{at.x, at.y, stands_on(row) + height(row)}};
  };
  return layer_of("ends", VectorLayer::Shape::kPoints, columns, ends, place, point_style("end", kEnds));
}

/// The tightest place of each link: what hides it or, where nothing does, comes nearest to it.
VectorLayer layer_of_obstacles(const std::vector<LinkRow>& rows, const StoreMetadata& metadata) {
  constexpr std::array<FeatureClass, 2> kObstacles{
      {{"hides", "Hides the link", {208, 32, 32}}, {"nearest", "Comes nearest to the line", {32, 160, 32}}}};
  const auto point = [](const LinkRow& row) -> const ProfilePoint& { return *row.found()->critical; };
  const std::vector<LinkColumn> columns{
      {"id", [](const LinkRow& row) { return row.id; }},
      {"what", [](const LinkRow& row) { return *row.found()->clearance_m < 0 ? "hides" : "nearest"; }},
      {"distance_m", [&](const LinkRow& row) { return point(row).distance_m; }},
      {"clearance_m", [](const LinkRow& row) { return *row.found()->clearance_m; }},
      {"theme",
       [&](const LinkRow& row) {
         const std::uint16_t theme = point(row).theme;
         return theme == 0 ? std::string("terrain") : metadata.themes[theme - std::size_t{1}].name;
       }},
      {"feature", [&](const LinkRow& row) {
         const std::int64_t feature = point(row).feature;
         return feature < 0 ? std::optional<std::int64_t>() : std::optional(feature);
       }}};
  std::vector<LinkRow> told;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(told),
               [](const LinkRow& row) { return row.found()->critical && row.found()->clearance_m; });
  const auto place = [&](const LinkRow& row) {
    return std::vector<Point3>{{point(row).x, point(row).y, point(row).ground_m}};
  };
  return layer_of("obstacles", VectorLayer::Shape::kPoints, columns, told, place, point_style("what", kObstacles));
}

/// The links, their ends, and what is in their way, in colours.
std::vector<VectorLayer> link_layers(const LinkSurvey& survey, const std::vector<LinkRow>& rows,
                                     const std::vector<LinkColumn>& columns) {
  const std::vector<LinkRow> lines = computed(rows);
  return {layer_of("links", VectorLayer::Shape::kLines, columns, lines, line_of,
                   line_style("verdict", kVerdictClasses, 0.6)),
          layer_of_ends(lines), layer_of_obstacles(lines, survey.metadata)};
}

/// Adds the places where links end, once under each name that rows give them.
void add_ends(const std::vector<LinkRow>& rows, Kml& kml) {
  std::set<std::tuple<std::string, double, double, double>> added;
  const auto add = [&](const std::string& name, const Point3& at) {
    if (!name.empty() && added.emplace(name, at.x, at.y, at.z).second) kml.point(name, at);
  };
  for (const LinkRow& row : rows) {
    const std::vector<Point3> line = line_of(row);
    add(row.link->from_name, line.front()), add(row.link->to_name, line.back());
  }
}

std::string links_kml(const std::string& crs_wkt, const std::string& title, const std::vector<LinkRow>& rows,
                      const std::vector<LinkColumn>& columns) {
  Kml kml(crs_wkt, title);
  for (const SightVerdict verdict : {SightVerdict::kVisible, SightVerdict::kHidden, SightVerdict::kUndecided})
    kml.style(name_of(verdict), kml_colour(class_of(verdict).colour), 3);
  kml.style("error", "ff909090", 3);
  const std::vector<LinkRow> lines = computed(rows);
  add_ends(lines, kml);
  for (const LinkRow& row : lines) {
    Kml::Data data;
    for (const LinkColumn& column : columns) data.emplace_back(column.name, cell_text(column.cell(row), column.number));
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
      write_geopackage(path, crs, link_layers(survey, rows, columns), options.overwrite);
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
