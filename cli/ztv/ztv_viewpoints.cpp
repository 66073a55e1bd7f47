#include "ztv/ztv_viewpoints.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/cross_section.hpp>
#include <itin/csv_cell.hpp>
#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/grid_reference.hpp>
#include <itin/output_file.hpp>
#include <itin/site_list.hpp>
#include <itin/site_table.hpp>

#include "options/memory_option.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

using viewshed::Turbine;
using viewshed::Zone;

const char* yes_or_no(bool value) {
  return value ? "yes" : "no";
}

const char* verdict_cell(Sight::Verdict verdict) {
  return verdict == Sight::Verdict::kUndecided ? "undecided" : yes_or_no(verdict == Sight::Verdict::kVisible);
}

/// Returns the cells for hub and tip, and for how much is seen; unknown values have no number.
std::string seen_cells(const Sight& s) {
  const std::string verdicts = fmt::format("{},{}", s.hub ? verdict_cell(*s.hub) : "", verdict_cell(s.tip));
  return s.tip == Sight::Verdict::kUndecided ? verdicts + ",,"
                                             : fmt::format("{},{:.2f},{:.4f}", verdicts, s.visible, s.vertical_deg);
}

std::string row_of(const Viewpoint& v, const Turbine& t, const Sight& s, const Sight* screened) {
  std::string row = fmt::format("{},{},{:.1f},{:.1f},{:.2f},{},{},{},{:.1f},{:.2f},{},{:.4f},{},{}", v.number,
                                csv_cell(v.name), v.position.x, v.position.y, v.ground, t.number, csv_cell(t.name),
                                csv_cell(t.farm), s.distance, s.azimuth, seen_cells(s), s.tip_deg,
                                yes_or_no(s.distance <= t.radius), s.gaps ? "crosses ground without data" : "");
  if (screened != nullptr) row += "," + seen_cells(*screened);
  return row + "\n";
}

constexpr const char* kHeader =
    "viewpoint,viewpoint_name,x,y,ground_m,turbine,turbine_name,farm,distance_m,azimuth_grid_deg,hub_visible,"
    "tip_visible,visible_height_m,vertical_angle_deg,tip_elevation_deg,within_radius,note";
constexpr const char* kScreenedHeader =
    ",hub_visible_screened,tip_visible_screened,visible_height_screened_m,vertical_angle_screened_deg";

constexpr const char* kSummaryHeader =
    "viewpoint,viewpoint_name,x,y,grid_reference,ground_m,eye_m,turbines,nearest_turbine,nearest_m,"
    "nearest_azimuth_grid_deg";
constexpr const char* kSummarySeen =
    ",hubs_visible{0},tips_visible{0},nearest_visible_turbine{0},nearest_visible{0}_m,horizontal_from{0}_deg,"
    "horizontal_extent{0}_deg,vertical_angle{0}_deg";

std::string summary_header(bool screened) {
  std::string header = kSummaryHeader + fmt::format(kSummarySeen, "");
  if (screened) header += fmt::format(kSummarySeen, "_screened");
  header += std::string(",tips_beyond_radius,note") + (screened ? ",before_the_eye" : "");
  header += ",hubs_undecided,tips_undecided";
  return header + (screened ? ",hubs_undecided_screened,tips_undecided_screened\n" : "\n");
}

std::string number_cell(std::optional<std::size_t> number) {
  return number ? fmt::format("{}", *number) : "";
}

std::string undecided_cells(const Seen& seen) {
  return fmt::format(",{},{}", number_cell(seen.hubs_undecided), seen.tips_undecided);
}

std::string summary_cells(const Zone& zone, const std::vector<Sight>& sights, const Seen& seen) {
  std::string cells = fmt::format(",{},{}", number_cell(seen.hubs), seen.tips);
  if (!seen.nearest_seen) return cells + ",,,,,0";
  return cells + fmt::format(",{},{:.0f},{:.1f},{:.1f},{:.3f}", zone.request.turbines[*seen.nearest_seen].number,
                             sights[*seen.nearest_seen].distance, seen.arc->from, seen.arc->width, seen.vertical_deg);
}

/// Returns a row of the summary. `remark` tells what stands before the eye, where there is a screened surface.
std::string summary_row(const Viewpoint& v, const Zone& zone, const std::vector<Sight>& sights,
                        const std::vector<Sight>& screened, const std::string& remark, bool national) {
  const Seen seen = seen_of(zone, sights, all_turbines(zone));
  const Sight& nearest = sights[seen.nearest];
  const auto reference = national ? national_grid_reference(v.position) : std::nullopt;
  std::string row =
      fmt::format("{},{},{:.1f},{:.1f},{},{:.1f},{:.1f},{},{},{:.0f},{:.1f}", v.number, csv_cell(v.name), v.position.x,
                  v.position.y, reference.value_or(""), v.ground, v.ground + v.height, seen.turbines,
                  zone.request.turbines[seen.nearest].number, nearest.distance, nearest.azimuth);
  row += summary_cells(zone, sights, seen);
  std::optional<Seen> behind;
  if (!screened.empty()) behind = seen_of(zone, screened, all_turbines(zone));
  if (behind) row += summary_cells(zone, screened, *behind);
  row += fmt::format(",{},{}", seen.tips_beyond, seen.gaps ? "some lines cross ground without data" : "");
  if (behind) row += "," + csv_cell(remark);
  return row + undecided_cells(seen) + (behind ? undecided_cells(*behind) : "") + "\n";
}

Viewpoint viewpoint_of(const SiteRow& row, std::size_t number, const SectionSurface& ground, double usual_height) {
  if (!row.position) throw InputError(row.error);
  Viewpoint v;
  v.number = number;
  v.position = *row.position;
  v.name = row.values[0].value_or(fmt::format("{}", number));
  v.height = row.values[1] ? parse_height("its height", with_decimal_point(*row.values[1]), Range::kNotNegative)
                           : usual_height;
  const CrossSection here = ground.between(v.position, v.position);
  if (here.breakpoints.empty())
    throw InputError(fmt::format("there is no data at {:.10g},{:.10g}", v.position.x, v.position.y));
  v.ground = here.breakpoints.front().position.z;
  return v;
}

}  // namespace

void ViewpointOptions::declare(CLI::App& app) {
  begin_group(app, "Viewpoints and wirelines");
  reads(app.add_option("--viewpoints", query_.path,
                       "Viewpoints for tables and wirelines, from a vector file of points, or CSV with columns x,y or "
                       "lon,lat; fields "
                       "name, and height for eyes that stand higher or lower than --observer-height")
            ->type_name("FILE"));
  app.add_option("--wireline-field", field_text_, "Least width of a wireline (default: 53.5)")->type_name("DEGREES");
  app.add_option("--wireline-bearing", bearing_text_,
                 "Bearing of every wireline's middle, from grid north (default: the middle of the turbines that are "
                 "seen, or of all where none is; sheets too narrow for them look at the nearest that is seen)")
      ->type_name("DEGREES");
  app.add_flag("--wireline-hidden", choice_.hidden_dashed, "Draw the hidden parts of turbines dashed in wirelines");
  app.add_option("--wireline-blades", blades_text_,
                 "By how much a blade is turned from upright in wirelines; random: by another angle for each turbine "
                 "(default: 0)")
      ->type_name("DEGREES|random");
  app.add_option("--wireline-pairs", choice_.alone,
                 "Cylindrical sheets in pairs: above, this wind farm alone; below, all of them")
      ->type_name("FARM");
  app.add_option("--wirelines", wirelines_text_, "Wirelines only from viewpoints of these names or numbers")
      ->type_name("NAME,...");
  app.add_flag("--no-wirelines", no_wirelines_, "Write tables of viewpoints alone");
}

void ViewpointOptions::validate(const InCrs& in_crs, const SheetOptions& sheets) {
  query_.crs = in_crs.crs;
  const std::pair<bool, const char*> options[] = {
      {!field_text_.empty(), "--wireline-field"},   {!bearing_text_.empty(), "--wireline-bearing"},
      {!blades_text_.empty(), "--wireline-blades"}, {!choice_.alone.empty(), "--wireline-pairs"},
      {!wirelines_text_.empty(), "--wirelines"},    {no_wirelines_, "--no-wirelines"},
      {choice_.hidden_dashed, "--wireline-hidden"}};
  for (const auto& [is_given, option] : options)
    if (is_given && !given()) throw InputError(fmt::format("{} works only with --viewpoints", option));
  if (no_wirelines_ && !wirelines_text_.empty()) throw InputError("--wirelines and --no-wirelines exclude each other");
  if (!field_text_.empty()) choice_.least_width_deg = parse_number("--wireline-field", field_text_, Range::kPositive);
  if (choice_.least_width_deg > 360) throw InputError("--wireline-field: give at most 360 degrees");
  if (!bearing_text_.empty()) choice_.bearing_deg = parse_bearing("--wireline-bearing", bearing_text_);
  if (!choice_.alone.empty() && !sheets.given())
    throw InputError("--wireline-pairs are sheets: give --sheets A3 or A1 with it");
  if (blades_text_ == "random") {
    choice_.blade_deg.reset();
  } else if (!blades_text_.empty()) {
    choice_.blade_deg = parse_number("--wireline-blades", blades_text_, Range::kNotNegative);
  }
  std::istringstream names(wirelines_text_);
  for (std::string name; std::getline(names, name, ',');) wirelines_.push_back(name);
}

Document ViewpointOptions::parameters() const {
  if (!given()) return Document::object();
  Document parameters{{"viewpoints", query_.path}, {"wireline_field_deg", choice_.least_width_deg}};
  if (choice_.bearing_deg) parameters["wireline_bearing_deg"] = *choice_.bearing_deg;
  if (choice_.hidden_dashed) parameters["wireline_hidden"] = true;
  if (!blades_text_.empty()) parameters["wireline_blades"] = blades_text_;
  if (!choice_.alone.empty()) parameters["wireline_pairs"] = choice_.alone;
  if (!wirelines_.empty()) parameters["wirelines"] = wirelines_;
  if (no_wirelines_) parameters["wirelines"] = Document::array();
  return parameters;
}

bool ViewpointOptions::has_wireline(const Viewpoint& v) const {
  if (no_wirelines_) return false;
  return wirelines_.empty() || std::any_of(wirelines_.begin(), wirelines_.end(), [&](const std::string& name) {
           return name == v.name || name == fmt::format("{}", v.number);
         });
}

void ViewpointOptions::require_wirelines_known(const std::vector<NamedPlace>& places) const {
  for (const std::string& name : wirelines_) {
    const bool known = std::any_of(places.begin(), places.end(), [&](const NamedPlace& p) {
      return p.name == name || fmt::format("{}", p.number) == name;
    });
    if (!known)
      throw InputError(fmt::format("--wirelines: '{}' is no viewpoint of {} that can be used", name, query_.path));
  }
}

void ViewpointOptions::require_farm_known(const Zone& zone) const {
  const std::vector<std::string> farms = viewshed::farms_of(zone);
  if (!choice_.alone.empty() && std::find(farms.begin(), farms.end(), choice_.alone) == farms.end())
    throw InputError(fmt::format("--wireline-pairs: '{}' is no wind farm of the turbines; there is: {}", choice_.alone,
                                 fmt::join(farms, ", ")));
}

ViewpointOptions::Written ViewpointOptions::write(const std::string& folder, const Store& store, const Zone& zone,
                                                  const SheetOptions& sheets, Progress& progress) const {
  Written written;
  written.path = query_.path;
  const StoreMetadata& metadata = store.metadata();
  const SectionSurface::Options cache = section_cache_within(zone.request.memory_bytes);
  const SectionSurface ground(store, zone.request.detail, ThemeChoice::none(), cache);
  std::optional<SectionSurface> features;
  std::string screened_title;
  if (zone.request.themes) {
    features.emplace(store, zone.request.detail, *zone.request.themes, cache);
    screened_title = fmt::format("Ground with {}", fmt::join(zone.request.themes->names(metadata.themes), ", "));
  }
  std::vector<std::string> theme_names;
  for (const ThemeInfo& theme : metadata.themes) theme_names.push_back(theme.name);
  require_farm_known(zone);
  const bool national = is_national_grid(metadata.crs_wkt);
  std::string table = fmt::format("{}{}\n", kHeader, features ? kScreenedHeader : "");
  std::string summary = summary_header(features.has_value());
  WirelineWriter wirelines(folder, store, zone, choice_, sheets.choice());
  SiteQuery query = query_;
  const LayerFields fields(query);
  take_names(query, fields);
  take_heights(query, fields, {}, written.warnings);
  for (const SiteRow& row :
       read_site_rows(query, {{query.name_field}, {query.height_field}}, metadata.crs_wkt, written.warnings)) {
    const std::size_t number = ++written.rows;
    try {
      const Viewpoint v = viewpoint_of(row, number, ground, zone.request.observer_height);
      const std::vector<Sight> sights = sights_to_all(ground, v, zone);
      std::vector<Sight> screened;
      std::string remark;
      if (features) {
        screened = sights_to_all(*features, v, zone);
        const Seen seen = seen_of(zone, screened, all_turbines(zone));
        remark = before_the_eye(*features, v, zone.request.turbines[seen.nearest].position, theme_names);
      }
      for (std::size_t k = 0; k < sights.size(); ++k)
        table += row_of(v, zone.request.turbines[k], sights[k], features ? &screened[k] : nullptr);
      summary += summary_row(v, zone, sights, screened, remark, national);
      written.places.push_back({number, v.name, v.position});
      if (!has_wireline(v)) continue;
      wirelines.write(v, {ground, "Bare ground", "", ""}, sights, progress);
      if (features) wirelines.write(v, {*features, screened_title, "-screened", remark}, screened, progress);
    } catch (const InputError& error) {
      written.bad.push_back({number, row.feature, row.place, in_options(error.what())});
    }
  }
  if (written.rows == 0) throw InputError(none_in(query_, "viewpoint"));
  require_wirelines_known(written.places);
  write_file(folder + "/viewpoints.csv", table, true);
  write_file(folder + "/viewpoints-summary.csv", summary, true);
  written.files = {
      {"viewpoints.csv", "viewpoint by turbine: hub and tip visible, metres and degrees seen, azimuth"},
      {"viewpoints-summary.csv",
       "a row for each viewpoint: hubs and tips visible, the nearest turbine, the part of the horizon that "
       "the visible ones take up"}};
  for (viewshed::ZoneFile& file : std::move(wirelines).files()) written.files.push_back(std::move(file));
  return written;
}

}  // namespace itin::cli
