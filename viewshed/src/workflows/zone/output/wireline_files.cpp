#include "workflows/zone/output/wireline_files.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/azimuth.hpp>
#include <itin/coordinates.hpp>
#include <itin/counted.hpp>
#include <itin/file_name.hpp>
#include <itin/grid_reference.hpp>
#include <itin/output_file.hpp>
#include <profile/wireline.hpp>
#include <profile/wireline_sheet.hpp>
#include <viewshed/map_base.hpp>
#include <viewshed/zone_files.hpp>

#include "workflows/zone/sight_summary.hpp"
#include "workflows/zone/viewpoint_study.hpp"

namespace itin::viewshed {

namespace {

/// A surface and the words for the view over it.
struct ViewedSurface {
  const SectionSurface& surface;
  std::string title;   ///< what a wireline's notes call it
  std::string suffix;  ///< added to the names of its files
  std::string remark;  ///< about this viewpoint; may be empty
};

class WirelineWriter {
 public:
  WirelineWriter(std::string folder, const Store& store, const Zone& zone, const WirelineChoice& choice,
                 const profile::SheetChoice& sheets)
      : folder_(std::move(folder)), store_(store), zone_(zone), choice_(choice), sheets_(sheets) {}

  void write(const Viewpoint& v, const ViewedSurface& view, const std::vector<TurbineSight>& sights,
             Progress& progress);
  std::vector<ZoneFile> files() && { return std::move(files_); }

 private:
  void add(const std::string& name, const std::string& what, const std::string& bytes);

  std::string folder_;
  const Store& store_;
  const Zone& zone_;
  WirelineChoice choice_;
  const profile::SheetChoice& sheets_;
  std::vector<ZoneFile> files_;
};

constexpr double kCylinder = 90, kRoomBeside = 10;  ///< degrees

std::string name_of_file(const char* kind, const Viewpoint& v, const std::string& ending) {
  return file_name(fmt::format("{}-{}-{}", kind, v.number, v.name)) + ending;
}

std::string visible_in_words(const Zone& zone, const SightSummary& seen) {
  std::string text = fmt::format("the blade tips of {} of {}", seen.tips, counted(seen.turbines, "turbine"));
  if (seen.tips_beyond > 0) text += fmt::format(" ({} beyond the radius of the maps)", seen.tips_beyond);
  if (seen.hubs) text += fmt::format(", the hubs of {}", *seen.hubs);
  if (seen.tips_undecided > 0)
    text += fmt::format("; undecided, across ground without data, for {} more, marked ?", seen.tips_undecided);
  const std::size_t hubs = known_hubs(zone);
  if (hubs < seen.turbines)
    text += hubs == 0 ? "; hub heights are unknown for all turbines"
                      : fmt::format("; hub heights are unknown for {}", seen.turbines - hubs);
  return text;
}

std::string place_in_words(const Viewpoint& v, const std::string& crs_wkt) {
  const auto reference = is_national_grid(crs_wkt) ? national_grid_reference(v.position) : std::nullopt;
  const std::string numbers = fmt::format("{:.0f}, {:.0f}", v.position.x, v.position.y);
  return reference ? fmt::format("{} ({})", *reference, numbers) : numbers;
}

/// The number by which pictures and maps call a turbine, with its name if that is another.
std::string number_and_name(const Turbine& t) {
  const std::string number = fmt::format("{}", t.number);
  return t.name.empty() || t.name == number ? number : number + " " + t.name;
}

std::string turbine_in_words(const Turbine& t) {
  return fmt::format("turbine {}{}", number_and_name(t), t.farm.empty() ? "" : " of " + t.farm);
}

/// Returns degrees that look random, but are always the same for a turbine.
double scattered_blade(std::size_t turbine) {
  constexpr double kGoldenAngle = 137.50776405;
  return std::fmod(kGoldenAngle * static_cast<double>(turbine), 120);
}

using Facts = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kMiddle = "Bearing to the middle";

std::string bearing_in_words(double degrees) {
  return fmt::format("{:.1f}° from grid north, {}", degrees, compass_point(degrees));
}

/// Tells what a picture looks at where no turbine is in sight.
std::string towards_in_words(const std::vector<TurbineSight>& sights) {
  return std::any_of(sights.begin(), sights.end(), is_shown) ? "" : "; no turbine is in sight";
}

Facts facts_of(const Viewpoint& v, const ViewedSurface& view, const Zone& zone, const std::vector<TurbineSight>& sights,
               double centre_deg, const Store& store) {
  const SightSummary seen = seen_of(zone, sights, all_turbines(zone));
  Facts facts{{"Grid reference", place_in_words(v, store.metadata().crs_wkt)},
              {"Ground", fmt::format("{:.1f} m", v.ground)},
              {"Eye", fmt::format("{:g} m above the ground, {:.1f} m", v.height, v.ground + v.height)},
              {kMiddle, bearing_in_words(centre_deg) + towards_in_words(sights)},
              {"Nearest turbine", fmt::format("{:.2f} km, {}", sights[seen.nearest].distance / 1000,
                                              turbine_in_words(zone.request.turbines[seen.nearest]))},
              {"Visible", visible_in_words(zone, seen)},
              {"Surface", view.title},
              {"Earth", zone.request.earth.convention()}};
  if (seen.gaps) facts.emplace_back("Terrain data", "some lines of sight cross ground without data");
  if (!view.remark.empty()) facts.emplace_back("Remark", view.remark);
  return facts;
}

/// Returns the colour of each turbine's group.
std::vector<Rgba> turbine_colours(const Zone& zone) {
  std::vector<Rgba> colours(zone.request.turbines.size());
  for (const TurbineGroup& group : turbine_groups(zone.request.turbines))
    for (const std::size_t turbine : group.turbines) colours[turbine] = group.colour;
  return colours;
}

profile::WirelineQuery query_of(const Viewpoint& v, const ViewedSurface& view, const Zone& zone,
                                const std::vector<TurbineSight>& sights, const WirelineChoice& choice,
                                const Facts& facts) {
  profile::WirelineQuery query;
  query.eye = v.position;
  query.eye_elevation_m = v.ground + v.height;
  query.earth = zone.request.earth;
  query.hidden_dashed = choice.hidden_dashed;
  query.title = fmt::format("Wireline from viewpoint {}: {}", v.number, v.name);
  const auto fact = [&](const char* name) {
    const auto found = std::find_if(facts.begin(), facts.end(), [&](const auto& f) { return f.first == name; });
    return found->second;
  };
  query.notes = {fmt::format("{}; ground {}, eye {}. Visible: {}. The nearest turbine: {}.", fact("Grid reference"),
                             fact("Ground"), fact("Eye"), fact("Visible"), fact("Nearest turbine")),
                 view.title + "; " + zone.request.earth.convention() + (view.remark.empty() ? "" : ". " + view.remark)};
  double reach = 20000;
  const std::vector<Rgba> colours = turbine_colours(zone);
  for (std::size_t k = 0; k < sights.size(); ++k) {
    const Turbine& t = zone.request.turbines[k];
    const bool undecided = sights[k].tip == TurbineSight::Verdict::kUndecided;
    query.turbines.push_back({fmt::format("{}{}", t.number, undecided ? "?" : ""), t.position, zone.ground_m[k],
                              t.hub_height, t.tip_height, sights[k].tip != TurbineSight::Verdict::kHidden, t.farm,
                              choice.blade_deg.value_or(scattered_blade(t.number)), colours[k]});
    reach = std::max(reach, sights[k].distance + 5000);
  }
  query.reach_m = std::min(reach, 60000.0);
  return query;
}

std::string and_undecided(std::size_t seen, std::size_t undecided) {
  return undecided > 0 ? fmt::format("{}, {} undecided", seen, undecided) : fmt::format("{}", seen);
}

/// Returns how many hubs are seen, and of how many where the others are not known.
std::string hubs_in_words(const SightSummary& seen) {
  if (!seen.hubs) return "unknown";
  const std::string of = seen.hubs_known < seen.turbines ? fmt::format(" of {} known", seen.hubs_known) : "";
  return and_undecided(*seen.hubs, *seen.hubs_undecided) + of;
}

constexpr double kFirstColumn = 0.26;  ///< the part of a table's width that its first column has

/// Returns a row for each farm, and one for all turbines where there are several farms.
profile::SheetTable farm_table(const Zone& zone, const std::vector<TurbineSight>& sights) {
  profile::SheetTable table{.first_column = kFirstColumn};
  table.rows = {
      {"Wind farm", "Turbines", "Hubs visible", "Tips visible", "Nearest, km", "Horizontal extent", "Vertical angle"}};
  const auto add = [&](const std::string& name, const std::vector<std::size_t>& turbines) {
    const SightSummary s = seen_of(zone, sights, turbines);
    table.rows.push_back({name, fmt::format("{}", s.turbines), hubs_in_words(s),
                          and_undecided(s.tips, s.tips_undecided),
                          fmt::format("{:.2f}", sights[s.nearest].distance / 1000),
                          s.arc ? fmt::format("{:.1f}°", s.arc->width) : "none",
                          s.tips > 0 ? fmt::format("{:.2f}°", s.vertical_deg) : "none"});
  };
  const std::vector<std::string> farms = farms_of(zone.request.turbines);
  for (const std::string& farm : farms) {
    std::vector<std::size_t> own;
    for (std::size_t k = 0; k < sights.size(); ++k)
      if (zone.request.turbines[k].farm == farm) own.push_back(k);
    add(farm.empty() ? "All turbines" : farm, own);
  }
  if (farms.size() > 1) add("All", all_turbines(zone));
  return table;
}

const char* verdict_in_words(const std::optional<TurbineSight::Verdict>& verdict) {
  if (!verdict) return "unknown";
  if (*verdict == TurbineSight::Verdict::kUndecided) return "undecided";
  return *verdict == TurbineSight::Verdict::kVisible ? "visible" : "hidden";
}

/// The turbines that a study is about: those proposed where there is a proposal, else all.
std::vector<std::size_t> turbines_of_interest(const Zone& zone) {
  std::vector<std::size_t> turbines = all_turbines(zone);
  if (has_proposal(zone.request))
    std::erase_if(turbines, [&](std::size_t k) { return zone.request.turbines[k].status != TurbineStatus::kProposed; });
  return turbines;
}

/// Returns a row for each turbine: those in sight before those that are hidden, among these the proposal's, and then
/// the nearest first.
profile::SheetTable table_of_sights(const Zone& zone, const std::vector<TurbineSight>& sights) {
  profile::SheetTable table{.first_column = kFirstColumn, .rest = "of turbines hidden or farther away"};
  table.rows = {{"Turbine", "Distance, km", "Bearing", "Hub", "Blade tip", "In sight", "Vertical angle"}};
  std::vector<char> others(sights.size(), true);
  for (const std::size_t k : turbines_of_interest(zone)) others[k] = false;
  const auto order = [&](std::size_t k) { return std::tuple(!is_shown(sights[k]), others[k], sights[k].distance); };
  std::vector<std::size_t> turbines = all_turbines(zone);
  std::stable_sort(turbines.begin(), turbines.end(), [&](std::size_t a, std::size_t b) { return order(a) < order(b); });
  for (const std::size_t k : turbines) {
    const TurbineSight& s = sights[k];
    const Turbine& t = zone.request.turbines[k];
    const bool seen = s.tip == TurbineSight::Verdict::kVisible;
    table.rows.push_back({number_and_name(t), fmt::format("{:.2f}", s.distance / 1000),
                          fmt::format("{:.1f}°", s.azimuth), verdict_in_words(s.hub), verdict_in_words(s.tip),
                          seen ? fmt::format("{:.1f} of {:.1f} m", s.visible, t.tip_height) : "",
                          seen ? fmt::format("{:.2f}°", s.vertical_deg) : ""});
  }
  return table;
}

/// Returns the direction of a picture that is too narrow for all turbines: to the middle of those of interest or, where
/// it is too narrow for these, to the nearest of them whose tip is seen, else to the nearest.
double bearing_of_narrow(const Zone& zone, const std::vector<TurbineSight>& sights) {
  const std::vector<std::size_t> turbines = turbines_of_interest(zone);
  std::vector<TurbineSight> their_sights;
  for (const std::size_t k : turbines) their_sights.push_back(sights[k]);
  const Arc arc = arc_to_shown(their_sights);
  if (arc.width + kRoomBeside <= profile::kPlanarField) return within_turn(arc.from + arc.width / 2);
  const SightSummary seen = seen_of(zone, sights, turbines);
  return sights[seen.nearest_seen.value_or(seen.nearest)].azimuth;
}

/// A part of the horizon, degrees.
struct PartOfHorizon {
  double bearing = 0;  ///< the bearing of its middle
  double width = 0;
};

/// Counts the turbines shown that lie beside a field of view.
std::size_t shown_beside(const std::vector<TurbineSight>& sights, const PartOfHorizon& field) {
  return static_cast<std::size_t>(std::count_if(sights.begin(), sights.end(), [&](const TurbineSight& s) {
    return is_shown(s) && std::abs(within_turn(s.azimuth - field.bearing + 180) - 180) > field.width / 2;
  }));
}

/// Returns a sheet that looks in one direction and says how many of the turbines shown lie beside the picture, and
/// whether the cylindrical sheets have them.
profile::WirelineSheet sheet_towards(const PartOfHorizon& field, const PartOfHorizon& cylinders,
                                     const std::vector<TurbineSight>& sights, profile::WirelineSheet sheet) {
  sheet.centre_deg = field.bearing;
  for (auto& [name, value] : sheet.facts)
    if (name == kMiddle) value = bearing_in_words(field.bearing) + towards_in_words(sights);
  const std::size_t beside = shown_beside(sights, field), lacking = shown_beside(sights, cylinders);
  if (beside == 0) return sheet;
  const auto shown = static_cast<std::size_t>(std::count_if(sights.begin(), sights.end(), is_shown));
  const std::string elsewhere = lacking == 0 ? "which the cylindrical sheets show"
                                             : fmt::format("of which the cylindrical sheets lack {}", lacking);
  sheet.facts.emplace_back(
      "Beside this field",
      fmt::format("{} of {}, {}", beside, counted(shown, "turbine in sight", "turbines in sight"), elsewhere));
  return sheet;
}

profile::Wireline of_one_farm(profile::Wireline view, const std::string& farm) {
  std::erase_if(view.query.turbines, [&](const profile::WirelineTurbine& t) { return t.farm != farm; });
  return view;
}

profile::MapSheet location_map(const Store& store, const Zone& zone, const Viewpoint& v,
                               const std::vector<TurbineSight>& sights, const std::string& basemap,
                               Progress& progress) {
  const SightSummary seen = seen_of(zone, sights, turbines_of_interest(zone));
  const Turbine& nearest = zone.request.turbines[seen.nearest];
  profile::MapSheet sheet;
  sheet.paper = profile::PaperSize::kA3;
  sheet.crs_wkt = store.metadata().crs_wkt;
  sheet.area.extend(v.position), sheet.area.extend(nearest.position);
  const double room = std::max(1000.0, 0.35 * sights[seen.nearest].distance);
  sheet.area = {sheet.area.xmin - room, sheet.area.ymin - room, sheet.area.xmax + room, sheet.area.ymax + room};
  sheet.scale = 2 * profile::scale_of(sheet);
  const MapBase base = map_base(store, profile::ground_in_location_map(sheet), sheet.scale, basemap, progress);
  sheet.layers = {base.picture};
  sheet.layers.insert(sheet.layers.end(), base.contours.begin(), base.contours.end());
  const std::vector<Rgba> colours = turbine_colours(zone);
  for (std::size_t k = 0; k < colours.size(); ++k) {
    const Turbine& t = zone.request.turbines[k];
    sheet.layers.emplace_back(
        profile::SheetMarks{profile::SheetSymbol::kTurbine, colours[k], {{t.position, fmt::format("{}", t.number)}}});
  }
  sheet.layers.emplace_back(profile::SheetMarks{
      profile::SheetSymbol::kViewpoint, {20, 60, 140, 255}, {{v.position, fmt::format("{} {}", v.number, v.name)}}});
  return sheet;
}

void WirelineWriter::add(const std::string& name, const std::string& what, const std::string& bytes) {
  write_file(folder_ + "/" + name, bytes, true);
  files_.push_back({name, what});
}

void WirelineWriter::write(const Viewpoint& v, const ViewedSurface& view, const std::vector<TurbineSight>& sights,
                           Progress& progress) {
  const Arc arc = arc_to_shown(sights);
  const double centre = choice_.bearing_deg.value_or(within_turn(arc.from + arc.width / 2));
  const Facts facts = facts_of(v, view, zone_, sights, centre, store_);
  profile::WirelineQuery query = query_of(v, view, zone_, sights, choice_, facts);
  query.width_deg = std::min(360.0, std::max(choice_.least_width_deg, std::ceil(arc.width + kRoomBeside)));
  query.from_deg = within_turn(centre - query.width_deg / 2);
  const std::string of =
      fmt::format("viewpoint {}, {}{}", v.number, v.name, view.suffix.empty() ? "" : ", with what screens");
  const profile::Wireline drawn = profile::survey_wireline(view.surface, query, progress);
  for (const char* ending : {".svg", ".pdf", ".png"}) {
    const std::string name = name_of_file("wireline", v, view.suffix + ending);
    add(name, "wireline from " + of + ", to scale", profile::draw_wireline(drawn, name));
  }
  if (sheets_.papers.empty()) return;
  const int fields = std::clamp(static_cast<int>(std::ceil((arc.width + kRoomBeside) / kCylinder)), 1, 4);
  query.width_deg = fields * kCylinder, query.step_deg = 0.025;
  query.from_deg = within_turn(centre - query.width_deg / 2);
  const profile::Wireline wide = profile::survey_wireline(view.surface, query, progress);
  profile::WirelineSheet sheet{query.title, facts, centre};
  if (!sheets_.project.empty()) sheet.facts.insert(sheet.facts.begin(), {"Project", sheets_.project});
  sheet.facts.emplace_back("Date", sheets_.date);
  const bool fits = choice_.bearing_deg || arc.width + kRoomBeside <= profile::kPlanarField;
  const double bearing = fits ? centre : bearing_of_narrow(zone_, sights);
  query.width_deg = kCylinder, query.from_deg = within_turn(bearing - kCylinder / 2);
  std::optional<profile::Wireline> turned;
  if (!fits) turned = profile::survey_wireline(view.surface, query, progress);
  const profile::Wireline& narrow = turned ? *turned : wide;
  const PartOfHorizon cylinders{centre, fields * kCylinder};
  std::string planar = name_of_file("wireline", v, view.suffix + "-planar.pdf");
  add(planar, "sheet of 841 by 297 mm: planar wireline of 53.5 degrees from " + of,
      profile::draw_planar_sheet(narrow, sheet_towards({bearing, profile::kPlanarField}, cylinders, sights, sheet),
                                 planar));
  std::string cylindrical = name_of_file("wireline", v, view.suffix + "-cylindrical.pdf");
  std::optional<profile::Wireline> alone;
  if (!choice_.alone.empty()) alone = of_one_farm(wide, choice_.alone);
  std::vector<profile::WirelineField> drawn_fields;
  for (const double middle : profile::cylinder_centres(centre, fields)) {
    if (alone) drawn_fields.push_back({*alone, middle, choice_.alone + " alone"});
    drawn_fields.push_back({wide, middle, alone ? "All wind farms" : ""});
  }
  add(cylindrical,
      fmt::format("sheets of 841 by 297 mm: {} of 90 degrees{}, cylindrical, from {}", fields,
                  alone ? ", each with " + choice_.alone + " alone and with all wind farms" : "", of),
      profile::draw_cylindrical_sheets(drawn_fields, sheet, cylindrical));
  sheet.title = fmt::format("Viewpoint {}: {}", v.number, v.name);
  const std::string name = name_of_file("viewpoint", v, view.suffix + ".pdf");
  add(name, "sheet about " + of,
      profile::draw_viewpoint_sheet(
          narrow,
          {sheet_towards({bearing, kCylinder}, cylinders, sights, sheet), farm_table(zone_, sights),
           table_of_sights(zone_, sights), location_map(store_, zone_, v, sights, sheets_.basemap, progress)},
          name));
}

bool has_wireline(const Viewpoint& v, const WirelineChoice& choice) {
  const std::vector<std::string>& names = choice.viewpoints;
  return names.empty() ||
         std::any_of(names.begin(), names.end(), [&](const std::string& name) { return is_called(v, name); });
}

}  // namespace

bool is_called(const Viewpoint& v, const std::string& name) {
  return name == v.name || name == fmt::format("{}", v.number);
}

std::vector<ZoneFile> write_wirelines(const std::string& folder, const Store& store, const ZoneStudy& study,
                                      const WirelineChoice& choice, const profile::SheetChoice& sheets,
                                      Progress& progress) {
  const ZoneRequest& request = study.zone.request;
  const StudySurfaces surfaces(store, request);
  const std::string screened_title =
      request.themes ? fmt::format("Ground with {}", fmt::join(request.themes->names(study.metadata.themes), ", "))
                     : "";
  WirelineWriter writer(folder, store, study.zone, choice, sheets);
  for (const auto& [v, bare, screened, remark] : study.viewpoints) {
    if (!has_wireline(v, choice)) continue;
    writer.write(v, {surfaces.ground, "Bare ground", "", ""}, bare, progress);
    if (surfaces.features)
      writer.write(v, {*surfaces.features, screened_title, "-screened", remark}, screened, progress);
  }
  return std::move(writer).files();
}

}  // namespace itin::viewshed
