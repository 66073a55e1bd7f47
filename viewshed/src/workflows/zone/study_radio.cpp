#include "workflows/zone/study_radio.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/earth.hpp>
#include <itin/error.hpp>
#include <viewshed/link_exclusion.hpp>
#include <viewshed/zone_files.hpp>

#include "workflows/zone/study_document.hpp"
#include "workflows/zone/usable_rows.hpp"

namespace itin::viewshed {

namespace {

/// Returns how many turbines a radar sees at least in part.
std::size_t seen_in(const std::vector<double>& turbine_m) {
  return static_cast<std::size_t>(std::count_if(turbine_m.begin(), turbine_m.end(), [](double m) { return m > 0; }));
}

/// Tells whether ground without data alone leaves it open that turbine k of the request is seen.
bool radar_leaves_open(const RadarView& radar, std::size_t k) {
  return !radar.undecided_turbine_m.empty() && radar.undecided_turbine_m[k] > 0;
}

std::vector<RadioLink> radio_links(const profile::LinkTable& table) {
  std::vector<RadioLink> links;
  for (const profile::Link& link : table.links) links.push_back({link.id, link.from, link.to});
  return links;
}

bool has_links(const ZoneStudy& study) {
  return !study.request.links.links.empty();
}

std::vector<BadRow> bad_links(const profile::LinkTable& table) {
  std::vector<BadRow> bad;
  for (const profile::BadLink& link : table.bad)
    bad.push_back({link.row, static_cast<std::int64_t>(link.row), fmt::format("feature {}", link.row), link.message});
  return bad;
}

std::string radar_methods(const ZoneStudy& study) {
  const Observer& place = *study.zone.request.radar;
  const RadarView& radar = *study.zone.radar;
  std::string text = fmt::format(
      "## Radar\n\nA radar at {:.0f}, {:.0f}, {:g} m above its ground of {:.1f} m. Mapped is the least height above "
      "the ground that it sees over bare ground, with curvature and refraction as stated; for each turbine is told "
      "how many metres of it rise above the radar's horizon. It sees {}. The heights are exact for the surface; "
      "between the terrain's points they depend on its triangles.",
      place.position.x, place.position.y, place.height, radar.ground_m, turbines_of_radar(study.zone));
  if (radar.leaves_open())
    text += fmt::format(
        " Where ground without data alone could hide something from the radar, it is undecided whether that is seen: "
        "of {}, and from the heights on that are mapped as undecided. What must stay out of the radar's sight has to "
        "stay below these, too.",
        counted(seen_in(radar.undecided_turbine_m), "turbine"));
  return text;
}

std::string link_methods(const ZoneStudy& study) {
  const double radius = exclusion_of(study).rotor_radius_m;
  const std::string rotor =
      radius > 0 ? fmt::format("the greatest rotor, {:g} m in radius", radius) : "the axis alone, as no rotor is known";
  return fmt::format(
      "## Radio links\n\n{} of `{}` at {:g} GHz (wavelength 0.299792458 / f). After Bacon (2002) a rotor must stay "
      "out of the second Fresnel zone, of radius sqrt(2 lambda d1 d2 / d), in plan. The area is mapped for {}; each "
      "turbine is judged by its own rotor. Heights are not taken into account, so that ground without data leaves "
      "nothing open.",
      counted(study.request.links.links.size(), "link"), study.request.links.path, study.request.frequency_ghz, rotor);
}

}  // namespace

std::string turbines_of_radar(const Zone& zone) {
  const std::size_t undecided = seen_in(zone.radar->undecided_turbine_m);
  return fmt::format("{} of {}, at least in part{}", seen_in(zone.radar->turbine_m),
                     counted(zone.request.turbines.size(), "turbine"),
                     undecided == 0 ? "" : fmt::format("; {} more undecided", undecided));
}

LinkStudy exclusion_of(const ZoneStudy& study) {
  LinkStudy links{radio_links(study.request.links), study.request.frequency_ghz, 0};
  for (const Turbine& t : study.zone.request.turbines)
    links.rotor_radius_m = std::max(links.rotor_radius_m, t.rotor_diameter.value_or(0) / 2);
  return links;
}

void require_links(const ZoneStudyRequest& request) {
  const profile::LinkTable& table = request.links;
  if (!table.links.empty() && !(request.frequency_ghz > 0))
    throw InputError("`frequency_ghz`: radio links need a frequency", "frequency_ghz");
  if (!table.links.empty() || table.bad.empty()) return;
  throw InputError(none_usable(table.path, table.bad.size(), table.bad.front().message), "links");
}

std::vector<LinkClearance> link_clearances(const ZoneStudyRequest& request, const Zone& zone) {
  std::vector<LinkClearance> clearances;
  const std::vector<RadioLink> links = radio_links(request.links);
  if (links.empty()) return clearances;
  for (const Turbine& turbine : zone.request.turbines) {
    LinkClearance& nearest = clearances.emplace_back(LinkClearance{"", std::numeric_limits<double>::infinity()});
    for (const RadioLink& link : links) {
      const double clearance =
          link_clearance_m(link, turbine.position, request.frequency_ghz, turbine.rotor_diameter.value_or(0) / 2);
      if (clearance < nearest.clearance_m) nearest = {link.id, clearance};
    }
  }
  return clearances;
}

std::vector<ZoneFile> write_radio_rasters(const std::string& folder, const ZoneStudy& study,
                                          const ZoneFileOptions& options) {
  std::vector<ZoneFile> files = write_radar_raster(folder, study.zone, options);
  const auto links = write_link_raster(folder, study.zone, options, exclusion_of(study));
  files.insert(files.end(), links.begin(), links.end());
  return files;
}

void add_radio_columns(const ZoneStudy& study, std::vector<TableColumn<TurbineRow>>& columns) {
  const auto add = [&](const char* name, auto of) { columns.emplace_back(name, of_turbine(of), kInCsv, "{:.2f}"); };
  if (study.zone.radar)
    add("radar_visible_m", [&radar = *study.zone.radar](const TurbineRow& row) {
      return radar_leaves_open(radar, row.index) ? std::nullopt : std::optional(radar.turbine_m[row.index]);
    });
  if (has_links(study)) {
    const auto nearest = [&study](const TurbineRow& row) -> const LinkClearance& {
      return study.link_clearances[row.index];
    };
    add("link", [nearest](const TurbineRow& row) { return nearest(row).link; });
    add("link_clearance_m", [nearest](const TurbineRow& row) { return nearest(row).clearance_m; });
    add("link_excluded", [nearest](const TurbineRow& row) { return nearest(row).clearance_m < 0; });
  }
  if (study.zone.radar)
    add("radar_sees", [&radar = *study.zone.radar](const TurbineRow& row) {
      return radar_leaves_open(radar, row.index) ? "undecided" : radar.turbine_m[row.index] > 0 ? "yes" : "no";
    });
}

Document radio_document(const ZoneStudy& study) {
  Document document = Document::object();
  if (const std::optional<RadarView>& radar = study.zone.radar) {
    document["radar"] = {{"ground_m", radar->ground_m},
                         {"turbines_seen", seen_in(radar->turbine_m)},
                         {"turbines_undecided", seen_in(radar->undecided_turbine_m)}};
  }
  if (has_links(study)) {
    const profile::LinkTable& table = study.request.links;
    const auto excluded = std::count_if(study.link_clearances.begin(), study.link_clearances.end(),
                                        [](const LinkClearance& c) { return c.clearance_m < 0; });
    const std::size_t used = table.links.size();
    document["links"] = bad_rows_document(table.path, used + table.bad.size(), used, bad_links(table));
    document["links"].update({{"links", used},
                              {"wavelength_m", wavelength_m(study.request.frequency_ghz)},
                              {"turbines_excluded", excluded}});
  }
  return document;
}

std::vector<std::string> radio_methods(const ZoneStudy& study) {
  std::vector<std::string> paragraphs;
  if (study.zone.radar) paragraphs.push_back(radar_methods(study));
  if (has_links(study)) paragraphs.push_back(link_methods(study));
  return paragraphs;
}

void warn_of_radio(const ZoneStudy& study, std::vector<std::string>& warnings) {
  if (!has_links(study)) return;
  const profile::LinkTable& table = study.request.links;
  warnings.insert(warnings.end(), table.warnings.begin(), table.warnings.end());
  for (const BadRow& bad : bad_links(table)) warnings.push_back(bad_row_warning(table.path, bad));
  const auto& turbines = study.zone.request.turbines;
  const auto unknown =
      std::count_if(turbines.begin(), turbines.end(), [](const Turbine& t) { return !t.rotor_diameter; });
  if (unknown > 0)
    warnings.push_back(
        fmt::format("the rotor diameter is unknown for {}: links are kept clear of the axes of these alone",
                    counted(static_cast<std::uint64_t>(unknown), "turbine")));
}

}  // namespace itin::viewshed
