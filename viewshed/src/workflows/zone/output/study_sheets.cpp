#include "workflows/zone/output/study_sheets.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/output_file.hpp>
#include <itin/sources_in.hpp>
#include <profile/foliage_text.hpp>
#include <viewshed/area_text.hpp>
#include <viewshed/result_map.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/zone_files.hpp>
#include <viewshed/zone_maps.hpp>

#include "workflows/zone/study_radio.hpp"

namespace itin::viewshed {

namespace {

using profile::SheetKey;

constexpr Rgba kViewpoint{20, 60, 140, 255}, kRadar{90, 40, 150, 255};

MapObjects viewpoint_objects(const std::vector<StudiedViewpoint>& viewpoints) {
  profile::SheetMarks marks{profile::SheetSymbol::kViewpoint, kViewpoint, {}};
  for (const auto& [v, bare, screened, remark] : viewpoints)
    marks.marks.push_back({v.position, fmt::format("{} {}", v.number, v.name)});
  return {{std::move(marks)}, {{SheetKey::Sample::kMark, {kViewpoint}, "Viewpoint", profile::SheetSymbol::kViewpoint}}};
}

/// Returns the rings of distance and the study area's edge. There are no rings where all radii are shorter than the
/// first.
MapObjects distance_objects(const StudyLines& lines) {
  MapObjects objects{{lines.rings, lines.study_area},
                     {{SheetKey::Sample::kDashes, {lines.study_area.colour}, "Study area"}}};
  if (!lines.rings.lines.empty())
    objects.keys.push_back({SheetKey::Sample::kLine, {lines.rings.colour}, lines.rings_text});
  return objects;
}

MapObjects radar_objects(const Observer& radar) {
  const profile::SheetMarks mark{profile::SheetSymbol::kExistingMast, kRadar, {{radar.position, "Radar"}}};
  return {{mark}, {{SheetKey::Sample::kMark, {kRadar}, "Radar", mark.symbol}}};
}

/// Returns the objects that a map of hubs, or of what else is seen of the zone, has above its classes.
std::vector<MapObjects> objects_of(const ZoneStudy& study, const StudyLines& lines, bool of_hubs) {
  std::vector<MapObjects> objects{distance_objects(lines)};
  if (!lines.routes.lines.empty())
    objects.push_back({{lines.routes}, {{SheetKey::Sample::kLine, {lines.routes.colour}, "Route"}}});
  if (!lines.radio_links.lines.empty())
    objects.push_back({{lines.radio_links}, {{SheetKey::Sample::kDashes, {lines.radio_links.colour}, "Radio link"}}});
  objects.push_back(turbine_objects(study.zone.request.turbines, of_hubs));
  if (study.zone.request.radar) objects.push_back(radar_objects(*study.zone.request.radar));
  if (!study.viewpoints.empty()) objects.push_back(viewpoint_objects(study.viewpoints));
  return objects;
}

ResultMap classes_of(const Zone& zone, const ZoneMap& map) {
  ResultMap result;
  std::uint64_t all = 0;
  for (const ZoneMap::Class& c : map.classes) all += c.cells;
  const double cell_area = zone.grid.cell_area(), whole = static_cast<double>(all) * cell_area;
  for (const ZoneMap::Class& c : map.classes) {
    result.keys.push_back(
        {{over_relief(c.colour)},
         fmt::format("{}: {} ({:.1f} %)", c.label, part_text(static_cast<double>(c.cells) * cell_area, whole),
                     100.0 * static_cast<double>(c.cells) / static_cast<double>(std::max<std::uint64_t>(1, all)))});
  }
  for (const std::uint8_t c : map.class_of_cell)
    result.cells.push_back(c == kNoMapClass ? kTransparent : result.keys[c].colours.front());
  return result;
}

std::string without_terrain_in_words(const MissingGround& missing) {
  if (missing.share() == 0) return "";
  return fmt::format("; {} of it has no terrain data and is not in the percentages", missing.percent());
}

/// Tells from how much area more may be visible than shown, apart from the map's class of undecided cells.
std::string more_in_words(const Zone& zone, const ZoneMap& map) {
  std::uint64_t more = 0;
  for (const ZoneMap::Class& c : map.classes)
    if (!c.undecided) more += c.open_cells;
  if (more == 0) return "";
  return fmt::format("ground without data leaves open whether more is visible than shown from {}",
                     area_text(static_cast<double>(more) * zone.grid.cell_area()));
}

std::string heights_in_words(const Zone& zone) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Turbine& t : zone.request.turbines)
    least = std::min(least, t.tip_height), most = std::max(most, t.tip_height);
  const std::string tips = least == most ? fmt::format("{:g}", most) : fmt::format("{:g} to {:g}", least, most);
  return fmt::format("{}, {} m to blade tip", zone.request.turbines.size(), tips);
}

bool shows_hubs(const ZoneMap& map) {
  return std::string_view(map.seen) == "hub";
}

bool shows_radar(const ZoneMap& map) {
  return std::string_view(map.seen) == "radar";
}

std::pair<std::string, std::string> observer_fact(const Zone& zone) {
  return {"Observer", fmt::format("eyes {:g} m above the ground at the centre of cells of {:g} m",
                                  zone.request.observer_height, zone.grid.cell_width())};
}

std::pair<std::string, std::string> radar_fact(const Zone& zone) {
  const Observer& radar = *zone.request.radar;
  return {"Radar", fmt::format("{:g} m above its ground of {:.1f} m, at {:.0f}, {:.0f}; it sees {}; heights at the "
                               "centres of cells of {:g} m",
                               radar.height, zone.radar->ground_m, radar.position.x, radar.position.y,
                               turbines_of_radar(zone), zone.grid.cell_width())};
}

std::string hub_heights_in_words(const Zone& zone) {
  const std::string known = of_known_hubs(zone);
  return known.empty() ? "" : fmt::format("; hubs{}, those of the others are not known", known);
}

std::string radii_in_words(const Zone& zone) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Turbine& t : turbines_of_study_area(zone.request))
    least = std::min(least, t.radius), most = std::max(most, t.radius);
  const char* const each = has_proposal(zone.request) ? "each proposed turbine" : "each turbine";
  return least == most ? fmt::format("within {:g} km of {}", most / 1000, each)
                       : fmt::format("within {:g} to {:g} km of {}, by its height", least / 1000, most / 1000, each);
}

profile::Foliage foliage_of_season(const ZoneFoliage& foliage, const std::string& season) {
  return {.extinction = foliage.extinction,
          .leaf_area = season == "winter" ? profile::kLeavesOff : profile::kLeavesOn,
          .least_transmittance = foliage.least_transmittance};
}

profile::TitleBlock title_block(const ZoneStudy& study, const ZoneMap& map) {
  const Zone& zone = study.zone;
  const StoreMetadata& metadata = study.metadata;
  profile::TitleBlock block;
  const bool solid_woods = map.screened && map.season.empty();
  block.title = map.title + (solid_woods ? ", screened" : "");
  block.statement =
      statement_of(metadata, map.screened ? *zone.request.themes : ThemeChoice::none(), zone.request.detail);
  if (!map.screened) block.statement += " What is shown as visible may be hidden by them.";
  block.facts = {{"Turbines", heights_in_words(zone) + (shows_hubs(map) ? hub_heights_in_words(zone) : "")},
                 {"Study area", radii_in_words(zone) + without_terrain_in_words(study.missing)},
                 shows_radar(map) ? radar_fact(zone) : observer_fact(zone),
                 {"Earth", zone.request.earth.curvature
                               ? "curvature and refraction are taken into account, " + zone.request.earth.convention()
                               : "flat; curvature and refraction are not taken into account"},
                 terrain_fact(metadata, zone.request.detail)};
  if (!map.season.empty())
    block.facts.emplace_back("Woods", profile::foliage_rule_text(foliage_of_season(*zone.request.foliage, map.season)));
  if (const std::string undecided = more_in_words(zone, map); !undecided.empty())
    block.facts.emplace_back("Undecided", undecided);
  block.sources = described(study.sources, metadata);
  return block;
}

}  // namespace

std::vector<ZoneFile> write_study_sheets(const std::string& folder, const Store& store, const ZoneStudy& study,
                                         const StudyLines& lines, const profile::SheetChoice& choice,
                                         Progress& progress) {
  const Zone& zone = study.zone;
  std::vector<ZoneFile> files;
  std::vector<ZoneMap> maps = zone_maps(zone);
  if (std::optional<ZoneMap> radar = radar_map(zone)) maps.push_back(std::move(*radar));
  const std::vector<Turbine> own = turbines_of_study_area(zone.request);
  const MissingOnSheet missing = missing_on_sheet(places_without_ground(zone), study.missing, "the study area");
  const auto content_of = [&](const ZoneMap& map) {
    return ResultSheet{zone.grid,
                       study_area(own),
                       classes_of(zone, map),
                       map.heading + ", and share of the area that has terrain data",
                       [&](Point2 p) { return beyond_study_area(own, p) <= 0; },
                       objects_of(study, lines, shows_hubs(map)),
                       title_block(study, map),
                       missing};
  };
  std::size_t done = 0;
  for (const profile::PaperSize paper : choice.papers) {
    const MapBase base = base_of(store, content_of(maps.front()), paper, choice, progress);
    for (const ZoneMap& map : maps) {
      const profile::MapSheet sheet = map_sheet(store, content_of(map), base, paper, choice);
      for (const std::string& name : sheet_names(map.name, paper)) {
        write_file(fmt::format("{}/{}", folder, name), profile::draw_map_sheet(sheet, name), true);
        files.push_back({name, fmt::format("map sheet: {}, {} at 1:{:.0f}", sheet.title.title, profile::name_of(paper),
                                           profile::scale_of(sheet))});
      }
      progress.report("sheets", static_cast<double>(++done) / static_cast<double>(maps.size() * choice.papers.size()));
    }
  }
  return files;
}

}  // namespace itin::viewshed
