#include "workflows/zone/output/study_methods.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/coordinates.hpp>
#include <itin/counted.hpp>
#include <itin/height_axis.hpp>
#include <itin/sources_in.hpp>
#include <itin/surface_text.hpp>
#include <profile/foliage.hpp>
#include <viewshed/radius_document.hpp>
#include <viewshed/undecided_area.hpp>
#include <viewshed/zone_files.hpp>

#include "turbines/proposal.hpp"
#include "workflows/zone/study_document.hpp"
#include "workflows/zone/study_radio.hpp"

namespace itin::viewshed {

namespace {

std::string range(double low, double high, const char* unit) {
  return low == high ? fmt::format("{:g} {}", low, unit) : fmt::format("{:g} to {:g} {}", low, high, unit);
}

std::string origin_in_words(const TurbineTable& table) {
  std::string text;
  if (!table.path.empty())
    text = fmt::format(" Positions and heights are those of the file `{}` (SHA-256 {}).", table.path, table.sha256);
  const std::size_t bad = table.bad.size();
  if (bad == 0) return text;
  return text + fmt::format(" {} of its {} could not be used.", counted(bad, "row"), table.rows);
}

std::string turbines_in_words(const ZoneStudy& study) {
  const Zone& zone = study.zone;
  const auto& turbines = zone.request.turbines;
  const auto [least, most] = std::minmax_element(
      turbines.begin(), turbines.end(), [](const auto& a, const auto& b) { return a.tip_height < b.tip_height; });
  std::string text =
      fmt::format("The assessment covers {}, with blade tips {} above the ground.",
                  counted(turbines.size(), "wind turbine"), range(least->tip_height, most->tip_height, "m"));
  const std::vector<std::string> farms = farms_of(zone.request.turbines);
  if (farms.size() > 1) text += fmt::format(" The wind farms are {}.", fmt::join(farms, ", "));
  const std::size_t unknown = turbines.size() - known_hubs(zone);
  if (unknown == turbines.size())
    text += " Hub heights are unknown for all turbines; hubs are not assessed.";
  else if (unknown > 0)
    text += fmt::format(" Hub heights are unknown for {} of them; these are not counted among the hubs.", unknown);
  return text + origin_in_words(study.request.turbines);
}

/// Returns the sources of terrain, or of a theme, with their notes where they have any.
std::string sources_in_words(const std::vector<SourceInfo>& sources, const StoreMetadata& metadata,
                             const std::string& theme) {
  std::vector<SourceInfo> of_theme;
  std::copy_if(sources.begin(), sources.end(), std::back_inserter(of_theme),
               [&](const SourceInfo& source) { return source.theme == theme; });
  return fmt::format("{}", fmt::join(described(of_theme, metadata), "; "));
}

/// Returns the datum of heights, as the sources give it.
std::string datum_in_words(const std::vector<SourceInfo>& sources) {
  std::set<std::string> datums;
  for (const SourceInfo& source : sources)
    if (source.theme.empty() && !source.source_crs.empty())
      if (const std::string datum = height_axis(source.source_crs).datum; !datum.empty()) datums.insert(datum);
  if (datums.empty()) return "Heights are taken as metres above one vertical datum, which the sources do not name.";
  return fmt::format("Heights are metres above {}.", listed({datums.begin(), datums.end()}));
}

std::string surface_in_words(const ZoneStudy& study) {
  const Detail& detail = study.zone.request.detail;
  if (detail.coarsest() == 0) return "Every point of the model is used.";
  const Document error = study_surface(study)["certified_error_m"];
  return fmt::format(
      "The surface is generalised to a tolerance of {:g} m, with a certified error of {:.2f} to {:.2f} m against the "
      "full terrain.",
      detail.coarsest(), error[0].get<double>(), error[1].get<double>());
}

std::string terrain_in_words(const ZoneStudy& study) {
  double spacing = 0;
  for (const SourceInfo& source : study.sources)
    if (source.theme.empty()) spacing = std::max(spacing, source.spacing);
  std::string text =
      fmt::format("The terrain model of the study area is made from: {}. Coordinates are in {}.",
                  sources_in_words(study.sources, study.metadata, ""), crs_title(study.metadata.crs_wkt));
  if (spacing > 0) text += fmt::format(" Its points lie up to {} m apart.", significant(spacing, 3));
  return text + " " + datum_in_words(study.sources) + " " + surface_in_words(study) +
         " The points are joined by triangles, on which heights between them are read; nothing is resampled.";
}

std::string screening_in_words(const ZoneStudy& study) {
  const Zone& zone = study.zone;
  const StoreMetadata& metadata = study.metadata;
  if (!zone.screened)
    return "The results are for bare ground: the screening effect of buildings, walls and vegetation is not taken into "
           "account, so that what is shown as visible may be hidden by them.";
  std::string features;
  for (const ThemeInfo& theme : metadata.themes) {
    const std::vector<std::string> names = zone.request.themes->names(metadata.themes);
    if (std::find(names.begin(), names.end(), theme.name) == names.end() || is_terrain(theme.kind)) continue;
    features += fmt::format("{}{} ({}, {}, from {})", features.empty() ? "" : "; ", theme.name, name_of(theme.kind),
                            counted(theme.features, "feature"), sources_in_words(study.sources, metadata, theme.name));
  }
  const double tolerance = zone.request.detail.coarsest();
  const std::string generalised =
      tolerance == 0 ? ""
                     : fmt::format(
                           " At the tolerance of {:g} m lower features may be left out: their screening effect is then "
                           "not taken into account.",
                           tolerance);
  const std::string omitted = omitted_text(*zone.request.themes);
  return fmt::format(
      "The results are given for bare ground and, where they are called screened, with the screening effect of these "
      "features: {}.{}{} Their heights are as they were imported: by a field, by one height for all, or by a raster in "
      "whole steps. They are taken as solid in all seasons. The observer "
      "stands on the ground in both cases; an observer within a feature that is higher than the eye sees nothing.",
      features, omitted.empty() ? "" : fmt::format(" They are given {}, as though these were not there.", omitted),
      generalised);
}

constexpr const char* kWirelines =
    "Wirelines are drawn from the same terrain model, curvature and refraction. Along each line of sight nothing is "
    "sampled; lines of sight follow each other every 0.05 degrees or less. Rotors face the viewer.";
constexpr const char* kSheets =
    " Wireline sheets have the fields of view, principal distances and paper sizes that are assumed for NatureScot's "
    "Visual Representation of Wind Farms, version 2.2: planar, 53.5 by 18.2 degrees at 812.5 mm, and cylindrical, 90 "
    "by 14.2 degrees at 522 mm, on paper of 841 by 297 mm.";

std::string foliage_in_words(const ZoneFoliage& foliage) {
  return fmt::format(
      "The results for summer and for winter count turbines that are seen through the woods, which are not taken as "
      "solid there. Of the light along a line exp(-{:g} a d) comes through d metres of foliage of the "
      "leaf "
      "area a, which is {:g} m²/m³ in summer and {:g} m²/m³ in winter, for which there is no source. A blade tip or "
      "hub "
      "is visible where nothing else hides it and at least {:g} % of its light comes through. Foliage is everything "
      "between the tops of the vegetation and the ground.",
      foliage.extinction, profile::kLeavesOn, profile::kLeavesOff, 100 * foliage.least_transmittance);
}

/// Tells how sight lines that cross ground without data are judged.
std::string crossings_in_words(const Zone& zone) {
  if (zone.request.nodata == NoData::kClear)
    return "Where sight lines cross ground without data, it is taken as clear.";
  if (zone.request.nodata == NoData::kBlock)
    return "Where sight lines cross ground without data, it is taken to block them.";
  if (!zone.leaves_open()) return "No sight line to a turbine crosses ground without data.";
  const auto open = [&](const Visibility& v) {
    const std::string what = undecided_in_words(undecided_area(zone, v.tip_count, v.tip_undecided));
    return what.empty() ? "of no place" : what;
  };
  std::string text =
      "Where ground without data alone could hide a turbine, it is undecided whether that is visible. Maps, areas and "
      "numbers of turbines count those that are certainly visible; those that are undecided are counted apart. It is "
      "undecided " +
      open(zone.bare);
  if (zone.screened) text += "; with the screening effect of features, " + open(*zone.screened);
  return text + ".";
}

std::string missing_in_words(const ZoneStudy& study) {
  const MissingGround& missing = study.missing;
  if (missing.share() == 0) return "The terrain data cover the whole study area: all places within the radii.";
  return fmt::format(
      "{} of the study area, {:.1f} km² within the radii, has no terrain data. Nothing is known of places there; they "
      "are no part of the areas and percentages given, which are of the area with data. {}",
      missing.text(), missing.study_m2() / 1e6, crossings_in_words(study.zone));
}

/// Returns the turbines beside the proposal by their status: "6 in planning, 4 consented and 14 existing turbines".
std::string others_in_words(const ZoneRequest& request) {
  using enum TurbineStatus;
  std::vector<std::string> parts;
  std::size_t rest = request.turbines.size() - proposed_turbines(request.turbines);
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, what));
    rest -= count;
  };
  add(turbines_with(kInPlanning, request.turbines), "in planning");
  add(turbines_with(kConsented, request.turbines), "consented");
  add(turbines_with(kExisting, request.turbines), "existing");
  add(rest, "other");
  return listed(parts) + " turbines";
}

std::string proposal_in_words(const ZoneRequest& request) {
  return fmt::format(
      "The proposal is {}; {} are assessed with it. The study area is that of the proposal alone. Within it, maps and "
      "areas are cumulative, and count all turbines, unless they are called those of the proposal, which count the "
      "proposed ones. The additional area is where tips of the proposal are seen and those of no other turbine.",
      counted(proposed_turbines(request.turbines), "turbine"), others_in_words(request));
}

std::string combinations_in_words(const ZoneStudy& study) {
  return fmt::format(
      "Every cell is classed by the combination of wind farms of which at least one blade tip is visible from it, and "
      "the area of each combination is given: where one of the {} is seen alone, where two are, and so on.{}",
      counted(farms_of(study.zone.request.turbines).size(), "wind farm"),
      study.zone.screened ? " This is done for bare ground, and again with the screening effect of features." : "");
}

std::string viewpoints_in_words(const ZoneStudy& study) {
  const auto& viewpoints = study.viewpoints;
  const auto [least, most] =
      std::minmax_element(viewpoints.begin(), viewpoints.end(),
                          [](const auto& a, const auto& b) { return a.viewpoint.height < b.viewpoint.height; });
  return fmt::format(
      "{} {} assessed, with the eyes {} above the ground. From each, every turbine is judged by itself, in the way "
      "that "
      "is described under Visibility, however far it is: its horizontal distance, its bearing from grid north, whether "
      "its hub and its tip are visible, and how much of it is. A viewpoint is judged where it is, not at the centre of "
      "its cell, so that it may differ from the maps about it.",
      counted(viewpoints.size(), "viewpoint"), viewpoints.size() == 1 ? "is" : "are",
      range(least->viewpoint.height, most->viewpoint.height, "m"));
}

std::string routes_in_words(const ZoneStudy& study) {
  double length = 0;
  std::size_t places = 0;
  for (const StudiedRoute& route : study.routes) length += route.length, places += route.places.size();
  return fmt::format(
      "{}, {:.1f} km long{}, {} looked at from {} along {}, in the middle of equal stretches of at most {:g} m, with "
      "the eyes {:g} m above the ground. What is seen from such a place counts for its whole stretch; lengths in sight "
      "are sums of stretches, and every turbine counts, however far it is.",
      counted(study.routes.size(), "route"), length / 1000, study.routes.size() == 1 ? "" : " in all",
      study.routes.size() == 1 ? "is" : "are", counted(places, "place"), study.routes.size() == 1 ? "it" : "them",
      study.request.route_step, study.zone.request.observer_height);
}

std::string radius_in_words(const ZoneStudy& study) {
  const bool proposal = has_proposal(study.zone.request);
  if (study.request.turbines.radius) return radius_text(*study.request.turbines.radius, proposal);
  const auto& turbines = study.zone.request.turbines;
  const auto [least, most] = std::minmax_element(turbines.begin(), turbines.end(),
                                                 [](const auto& a, const auto& b) { return a.radius < b.radius; });
  return fmt::format("The study area extends to {} from every {}turbine.",
                     range(least->radius / 1000, most->radius / 1000, "km"), proposal ? "proposed " : "");
}

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
      "coefficient k = {:g}, where k is the ratio of the Earth's radius to that of the sight line, and R = {:g} km; "
      "{}. Where guidance has the form (1 - 2 k), its coefficient must be doubled: 0.075 there is k = 0.15 here.",
      earth.refraction, earth.radius / 1000, drops);
}

}  // namespace

std::string methods_text(const ZoneStudy& study, const ZoneStudyFileOptions& options) {
  const Zone& zone = study.zone;
  const ZoneRequest& request = zone.request;
  std::string text = "# Zone of theoretical visibility: methods\n\n";
  const auto paragraph = [&](const std::string& heading, const std::string& body) {
    text += fmt::format("## {}\n\n{}\n\n", heading, body);
  };
  paragraph("Turbines", turbines_in_words(study));
  paragraph("Terrain", terrain_in_words(study));
  paragraph(
      "Observer",
      fmt::format("The observer's eyes are {:g} m above the bare ground, at the centre of every cell of {:g} m by "
                  "{:g} m.",
                  request.observer_height, zone.grid.cell_width(), zone.grid.cell_height()));
  paragraph("Study area",
            radius_in_words(study) +
                " Distances are horizontal; beyond its own distance a turbine is not counted on maps and in "
                "areas. Tables and sheets of viewpoints and routes count every turbine, however far it is.");
  if (has_proposal(request)) paragraph("Cumulative assessment", proposal_in_words(request));
  paragraph("Ground without data", missing_in_words(study));
  paragraph("Curvature and refraction", refraction_in_words(request.earth));
  paragraph(
      "Visibility",
      "For every observer the lowest visible point of each turbine's axis is found: the lowest one that a straight "
      "line "
      "from the eye reaches without passing below the surface. The result is exact for the surface: it follows from "
      "the "
      "triangles themselves, without a step size; a line that touches the surface counts as clear. The blade tip is "
      "visible where this point is no higher than the tip, the hub likewise; the visible height is the part of the "
      "turbine above this point. Rotors are taken to face the observer. Haze, light and the acuity of the eye are not "
      "taken into account.");
  paragraph("Screening", screening_in_words(study));
  if (farms_of(zone.request.turbines).size() > 1) paragraph("Combinations of wind farms", combinations_in_words(study));
  if (!study.viewpoints.empty()) paragraph("Viewpoints", viewpoints_in_words(study));
  if (!study.routes.empty()) paragraph("Routes", routes_in_words(study));
  if (zone.seasons) paragraph("Foliage", foliage_in_words(*request.foliage));
  if (has_viewpoints(study.request) && !options.wirelines.none)
    paragraph("Wirelines", std::string(kWirelines) + (options.sheets.papers.empty() ? "" : kSheets));
  for (const std::string& further : radio_methods(study)) text += further + "\n\n";
  text += fmt::format("Computed with itin {}.\n", ITIN_VERSION);
  return text;
}

}  // namespace itin::viewshed
