#include "ztv/ztv_methods.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <viewshed/missing_ground.hpp>
#include <viewshed/zone_files.hpp>

#include "output/store_document.hpp"
#include "ztv/ztv_turbines.hpp"

namespace itin::cli {

namespace {

std::string range(double low, double high, const char* unit) {
  return low == high ? fmt::format("{:g} {}", low, unit) : fmt::format("{:g} to {:g} {}", low, high, unit);
}

std::string turbines_in_words(const viewshed::Zone& zone, const ZtvMethods& facts) {
  const auto& turbines = zone.request.turbines;
  const auto [least, most] = std::minmax_element(
      turbines.begin(), turbines.end(), [](const auto& a, const auto& b) { return a.tip_height < b.tip_height; });
  const std::size_t hubs = known_hubs(turbines);
  std::string text = fmt::format("{} of {} in `{}` (SHA-256 {}); tips {} above the ground.",
                                 counted(turbines.size(), "turbine"), counted(facts.rows, "row"), facts.turbines_file,
                                 facts.turbines_sha256, range(least->tip_height, most->tip_height, "m"));
  if (hubs < turbines.size())
    text += fmt::format(" The hub's height is known of {} of them; the others are not counted among hubs.", hubs);
  if (facts.bad > 0)
    text += fmt::format(" Named in `turbines.csv`, because they could not be used: {}.", counted(facts.bad, "row"));
  const std::vector<std::string> farms = viewshed::farms_of(zone);
  if (farms.size() > 1) text += fmt::format(" Farms: {}.", fmt::join(farms, ", "));
  return text;
}

std::string nodata_in_words(viewshed::NoData rule) {
  return rule == viewshed::NoData::kBlock ? "is taken to block them" : "is taken as clear";
}

std::string missing_in_words(const viewshed::Zone& zone) {
  const viewshed::MissingGround missing = viewshed::missing_ground(zone);
  if (missing.share() == 0) return "The terrain data cover the whole study area: all places within the radii.";
  return fmt::format(
      "{} of the study area, {:.1f} km2 within the radii, has no terrain data. Nothing is known of places there; they "
      "are no part of the areas and percentages given, which are of the area with data. Where sight lines cross ground "
      "without data, it {}.",
      missing.text(), missing.study_m2() / 1e6, nodata_in_words(zone.request.nodata));
}

}  // namespace

std::string refraction_in_words(const Earth& earth) {
  if (!earth.curvature) return "The Earth is taken as flat: neither curvature nor refraction is allowed for.";
  const std::string drops =
      fmt::format("a point at 10 km appears {:.2f} m lower, at 40 km {:.1f} m", earth.drop(10000), earth.drop(40000));
  if (earth.effective_factor)
    return fmt::format(
        "The Earth's curvature and refraction are allowed for by an effective Earth radius of {:.4g} times {:g} km, as "
        "in radio planning: drop = d^2 / (2 K R); {}.",
        *earth.effective_factor, earth.radius / 1000, drops);
  return fmt::format(
      "The Earth's curvature and atmospheric refraction are allowed for: drop = d^2 (1 - k) / (2 R), with a refraction "
      "coefficient k = {:g}, where k is the ratio of the Earth's radius to that of the sight line (so that it enters "
      "once, not twice), and R = {:g} km; {}.",
      earth.refraction, earth.radius / 1000, drops);
}

std::string methods_text(const viewshed::Zone& zone, const ZtvMethods& facts) {
  const viewshed::ZoneRequest& request = zone.request;
  std::string text = "# Zone of theoretical visibility: methods\n\n";
  const auto paragraph = [&](const std::string& heading, const std::string& body) {
    text += fmt::format("## {}\n\n{}\n\n", heading, body);
  };
  paragraph("Turbines", turbines_in_words(zone, facts));
  paragraph(
      "Terrain",
      fmt::format(
          "`{}`, {}. {} The surface is a triangulation of the terrain's own points; heights "
          "between them are those of its triangles, nothing is resampled. Its sources within the study area:\n\n- {}",
          facts.store, facts.crs, facts.surface, fmt::join(facts.sources, "\n- ")));
  paragraph("Viewer",
            fmt::format("An eye {:g} m above the bare ground at the centre of every cell of {:g} m by {:g} m.",
                        request.observer_height, zone.grid.cell_width(), zone.grid.cell_height()));
  paragraph("Radius", facts.radius + " A turbine counts only in cells within its own radius, measured horizontally.");
  paragraph("Ground without data", missing_in_words(zone));
  paragraph("Curvature and refraction", refraction_in_words(request.earth));
  paragraph("Visibility",
            "For every eye and turbine the least height on the turbine's axis is found at which the straight line from "
            "the eye clears the surface. It is exact for the surface: the height at which the line touches a triangle, "
            "in double precision, with no step size. A line that touches the surface counts as clear. The tip is "
            "seen where this height is no higher than the tip, the hub likewise; the visible height is the tip less "
            "this height. A rotor is taken to face the eye. Nothing is said about haze, light, or a viewer's acuity.");
  paragraph("Bare and screened",
            zone.screened ? fmt::format("Results are given for bare ground and, with `-screened` in their names, with "
                                        "these features standing on it: {}. Features are taken as solid. Eyes stand on "
                                        "the ground in both; an eye within a feature sees nothing.",
                                        fmt::join(facts.themes, ", "))
                          : std::string("Bare ground alone: no buildings, walls or vegetation. What is shown as seen "
                                        "may be screened by them."));
  for (const std::string& further : facts.further) text += further + "\n\n";
  text += fmt::format("Made by itin {}.\n", ITIN_VERSION);
  return text;
}

}  // namespace itin::cli
