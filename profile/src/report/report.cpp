#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/output_file.hpp>
#include <profile/los.hpp>
#include <profile/profile_text.hpp>

#include "report/formats.hpp"
#include "report/tables/path_tables.hpp"

namespace itin::profile {

namespace {

std::string bytes_of(const LosReport& report, const std::string& json, const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".json") return json;
  if (ending == ".csv") return report_csv(report);
  if (ending == ".txt") return profile_text(report.profile, report.ground, report.theme_kinds);
  if (ending == ".html") return report_html(report);
  if (ending == ".kml") return report_kml(report);
  return report_drawing(report, *Drawing::format_of(path));
}

}  // namespace

bool shows_location(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".pdf" || ending == ".html";
}

void require_report_format(const std::string& path, bool has_positions) {
  constexpr std::string_view kEndings[] = {".json", ".csv", ".txt", ".svg", ".pdf", ".png", ".html", ".kml", ".gpkg"};
  const std::string ending = ending_of(path);
  if (std::find(std::begin(kEndings), std::end(kEndings), ending) == std::end(kEndings)) {
    throw InputError(
        fmt::format("`report` '{}': expected .json, .csv, .txt, .svg, .pdf, .png, .html, .kml or .gpkg", path),
        "report");
  }
  if (!has_positions && (ending == ".kml" || ending == ".gpkg")) {
    throw InputError(fmt::format("`report` '{}': a profile from a file has no positions to map", path), "report");
  }
}

void require_report(const LosReport& report, const std::string& path) {
  require_report_format(path, !report.crs_wkt.empty());
  if (ending_of(path) == ".txt") require_profile_text(report.profile, fmt::format("`report` '{}'", path));
  require_table_spacing(report);
}

void write_report(const LosReport& report, const std::string& json, const std::string& path, bool overwrite) {
  require_report(report, path);
  if (ending_of(path) == ".gpkg") return write_geopackage(path, report.crs_wkt, report_layers(report), overwrite);
  write_file(path, bytes_of(report, json, path), overwrite);
}

}  // namespace itin::profile
