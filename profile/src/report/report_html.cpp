// Writes one self-contained page: drawings are embedded as images, nothing is fetched.
#include <string_view>

#include <fmt/format.h>

#include <itin/base64.hpp>
#include <itin/markup.hpp>
#include <profile/map_sheet.hpp>
#include <profile/sight_svg.hpp>

#include "report/charts/fade.hpp"
#include "report/charts/trade_off_chart.hpp"
#include "report/formats.hpp"
#include "report/tables/path_tables.hpp"
#include "report/tables/tables.hpp"

namespace itin::profile {

namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;color:#222;max-width:64rem;margin:2rem auto;padding:0 1rem}"
    "h1{font-size:1.6rem;margin:0 0 .3rem}h2{font-size:1.1rem;margin:1.6rem 0 .3rem}"
    "table{border-collapse:collapse}td,th{padding:.18rem .9rem .18rem 0;text-align:left;vertical-align:top;"
    "border-bottom:1px solid #ddd}img{width:100%;height:auto}.note{color:#666;font-size:.9em}"
    ".verdict{font-size:1.1rem;font-weight:600}@media print{body{margin:0;max-width:none}h2{break-after:avoid}}";

constexpr double kDrawingWidth = 842, kDrawingHeight = 420;
constexpr int kMapPixels = 800;

std::string image(const char* what, const std::string& bytes) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">\n", what, base64(bytes));
}

std::string map_image(const MapSheet& map) {
  return fmt::format("<img alt=\"Map of where the line runs\" src=\"data:image/png;base64,{}\">\n",
                     base64(draw_map_png(map, kMapPixels)));
}

std::string trade_off_svg(const LosReport& report) {
  constexpr double width = 620, height = 380;
  Drawing drawing(Drawing::Format::kSvg, width, height);
  draw_trade_off_chart(drawing, {0, 0, width, height}, report);
  return drawing.finish();
}

std::string html_table(const Table& table) {
  std::string html = fmt::format("<h2>{}</h2>\n<table>\n", escaped_markup(table.title));
  const auto row = [&](const std::vector<std::string>& cells, std::string_view tag) {
    html += "<tr>";
    for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, escaped_markup(cell));
    html += "</tr>\n";
  };
  if (!table.header.empty()) row(table.header, "th");
  for (const auto& cells : table.rows) row(cells, "td");
  html += "</table>\n";
  if (!table.note.empty()) html += fmt::format("<p class=\"note\">{}</p>\n", escaped_markup(table.note));
  return html;
}

}  // namespace

std::string report_html(const LosReport& report) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>{0}</title>\n<style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n"
      "<p class=\"verdict\">{2}</p>\n",
      escaped_markup(report.title), kStyle, escaped_markup(verdict_line(report)));
  html += image("Sight line over the terrain", sight_svg(report, kDrawingWidth, kDrawingHeight));
  if (const CriterionResult* fade = worst_fade(report)) {
    html += fmt::format("<p>{}</p>\n", escaped_markup(fade_line(*fade, unit_of(report))));
    html += image("Sight line over the Earth of the worst fade",
                  sight_svg(over_earth_of(report, *fade), kDrawingWidth, kDrawingHeight));
  }
  html += html_table(ends_table(report));
  for (const Table& table : result_tables(report)) html += html_table(table);
  if (report.location) html += map_image(*report.location);
  if (has_trade_off(report)) html += image("Heights at A against B", trade_off_svg(report));
  if (const std::optional<Table> profile = profile_table(report)) html += html_table(*profile);
  return html + html_table(facts_table(report)) + "</body>\n</html>\n";
}

}  // namespace itin::profile
