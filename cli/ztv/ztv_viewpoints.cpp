#include "ztv/ztv_viewpoints.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/coordinates.hpp>
#include <itin/cross_section.hpp>
#include <itin/csv_cell.hpp>
#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <itin/output_file.hpp>
#include <itin/parallel.hpp>
#include <itin/site_table.hpp>
#include <profile/profile.hpp>
#include <profile/required_heights.hpp>
#include <profile/wireline.hpp>

#include "options/site_list.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

using viewshed::Turbine;
using viewshed::Zone;

struct Viewpoint {
  std::size_t number = 0;
  std::string name;
  Point2 position;
  double height = 0;
  double ground = 0;
};

/// The part of one turbine that is seen from one viewpoint.
struct Sight {
  double distance = 0, azimuth = 0;
  double least = 0;  ///< metres above the turbine's ground, from which on it is seen
  bool tip = false;
  std::optional<bool> hub;
  double visible = 0, vertical_deg = 0, tip_deg = 0;
  bool gaps = false;
};

/// `ground` is what the turbine stands on; both ends keep their bare ground whatever the surface.
Sight sight_to(const SectionSurface& surface, const Viewpoint& from, const Turbine& turbine, double ground,
               const Earth& earth) {
  Sight sight;
  const CrossSection section = surface.between(from.position, turbine.position);
  const Point2 foot = section.one_place ? from.position : turbine.position;
  const double dx = foot.x - from.position.x, dy = foot.y - from.position.y;
  sight.distance = std::hypot(dx, dy);
  sight.azimuth = std::fmod(std::atan2(dx, dy) * kDegreesPerRadian + 360, 360);
  sight.gaps = !section.gaps.empty();
  const profile::Profile profile = profile::from_section(section);
  const double hub = turbine.hub_height.value_or(turbine.tip_height);
  const auto seen = profile::visible_height(profile, from.height, hub, turbine.tip_height, earth,
                                            profile::EndGrounds{from.ground, ground});
  sight.least = std::max(0.0, seen.from_m);
  sight.visible = turbine.tip_height - sight.least;
  sight.tip = seen.tip_visible_m > 0;
  if (turbine.hub_height) sight.hub = sight.tip && sight.least <= *turbine.hub_height;
  const double eye = from.ground + from.height;
  const auto angle = [&](double height) {
    return profile::apparent_angle_deg(earth, sight.distance, ground + height - eye);
  };
  sight.tip_deg = angle(turbine.tip_height);
  if (sight.tip) sight.vertical_deg = sight.tip_deg - angle(sight.least);
  return sight;
}

const char* yes_or_no(bool value) {
  return value ? "yes" : "no";
}

std::string hub_cell(const Sight& s) {
  return s.hub ? yes_or_no(*s.hub) : "";
}

std::string row_of(const Viewpoint& v, const Turbine& t, const Sight& s, const Sight* screened) {
  std::string row =
      fmt::format("{},{},{:.3f},{:.3f},{:.2f},{},{},{},{:.2f},{:.4f},{},{},{:.3f},{:.5f},{:.5f},{},{}", v.number,
                  csv_cell(v.name), v.position.x, v.position.y, v.ground, t.number, csv_cell(t.name), csv_cell(t.farm),
                  s.distance, s.azimuth, hub_cell(s), yes_or_no(s.tip), s.visible, s.vertical_deg, s.tip_deg,
                  yes_or_no(s.distance <= t.radius), s.gaps ? "crosses ground without data" : "");
  if (screened != nullptr)
    row += fmt::format(",{},{},{:.3f},{:.5f}", hub_cell(*screened), yes_or_no(screened->tip), screened->visible,
                       screened->vertical_deg);
  return row + "\n";
}

constexpr const char* kHeader =
    "viewpoint,viewpoint_name,x,y,ground_m,turbine,turbine_name,farm,distance_m,azimuth_grid_deg,hub_visible,"
    "tip_visible,visible_height_m,vertical_angle_deg,tip_elevation_deg,within_radius,note";
constexpr const char* kScreenedHeader =
    ",hub_visible_screened,tip_visible_screened,visible_height_screened_m,vertical_angle_screened_deg";

/// A name that every file system takes.
std::string file_name(const Viewpoint& v, const std::string& suffix) {
  std::string name;
  for (const char c : v.name)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ? c : '_';
  return fmt::format("wireline-{}-{}{}", v.number, name, suffix);
}

/// The widest gap between azimuths lies behind the viewer.
profile::WirelineQuery field_of_view(const Viewpoint& v, const std::vector<Sight>& sights, double least_width) {
  std::vector<double> azimuths;
  for (const Sight& s : sights) azimuths.push_back(s.azimuth);
  std::sort(azimuths.begin(), azimuths.end());
  double widest = 360 - (azimuths.back() - azimuths.front()), from = azimuths.front();
  for (std::size_t i = 0; i + 1 < azimuths.size(); ++i) {
    const double gap = azimuths[i + 1] - azimuths[i];
    if (gap > widest) widest = gap, from = azimuths[i + 1];
  }
  const double span = 360 - widest;
  profile::WirelineQuery query;
  query.eye = v.position;
  query.width_deg = std::min(360.0, std::max(least_width, std::ceil(span + 10)));
  query.from_deg = std::fmod(from + span / 2 - query.width_deg / 2 + 720, 360);
  return query;
}

profile::WirelineQuery wireline_of(const Viewpoint& v, const Zone& zone, const std::vector<Sight>& sights,
                                   double least_width, const std::string& surface) {
  profile::WirelineQuery query = field_of_view(v, sights, least_width);
  query.title = fmt::format("Wireline from viewpoint {}: {}", v.number, v.name);
  query.eye_elevation_m = v.ground + v.height;
  query.earth = zone.request.earth;
  const auto tips = std::count_if(sights.begin(), sights.end(), [](const Sight& s) { return s.tip; });
  const auto hubs = std::count_if(sights.begin(), sights.end(), [](const Sight& s) { return s.hub.value_or(false); });
  const auto nearest = std::min_element(sights.begin(), sights.end(),
                                        [](const Sight& a, const Sight& b) { return a.distance < b.distance; });
  const std::string of_hubs =
      known_hubs(zone.request.turbines) > 0 ? fmt::format(" and {} their hub", hubs) : std::string();
  query.notes = {
      fmt::format("{:.0f}, {:.0f}; ground {:.1f} m, eye {:g} m above it. Of {} turbines {} have their tip seen"
                  "{}; the nearest stands {:.2f} km away.",
                  v.position.x, v.position.y, v.ground, v.height, sights.size(), tips, of_hubs,
                  nearest->distance / 1000),
      surface + "; " + zone.request.earth.convention()};
  double reach = 20000;
  for (std::size_t k = 0; k < sights.size(); ++k) {
    const Turbine& t = zone.request.turbines[k];
    query.turbines.push_back(
        {fmt::format("{}", t.number), t.position, zone.ground_m[k], t.hub_height, t.tip_height, sights[k].tip});
    reach = std::max(reach, sights[k].distance + 5000);
  }
  query.reach_m = std::min(reach, 60000.0);
  return query;
}

}  // namespace

void ViewpointOptions::declare(CLI::App& app) {
  reads(app.add_option("--viewpoints", query_.path,
                       "Viewpoints for a table and wirelines, from a vector file of points, or CSV with columns x,y or "
                       "lon,lat; fields "
                       "name, and height for eyes that stand higher or lower than --observer-height")
            ->type_name("FILE"));
  app.add_option("--wireline-field", field_text_, "Least width of a wireline (default: 53.5)")->type_name("DEGREES");
}

void ViewpointOptions::validate(const InCrs& in_crs) {
  query_.crs = in_crs.crs;
  if (field_text_.empty()) return;
  if (!given()) throw InputError("--wireline-field is of use with --viewpoints only");
  field_deg_ = parse_number("--wireline-field", field_text_, Range::kPositive);
  if (field_deg_ > 360) throw InputError("--wireline-field: give at most 360 degrees");
}

Document ViewpointOptions::parameters() const {
  if (!given()) return Document::object();
  return {{"viewpoints", query_.path}, {"wireline_field_deg", field_deg_}};
}

namespace {

/// A surface and what is written of the view over it.
struct View {
  const SectionSurface& surface;
  std::string title;   ///< in a wireline's notes
  std::string suffix;  ///< of its files' names
};

/// One sight a turbine of the zone.
std::vector<Sight> sights_to_all(const View& view, const Viewpoint& from, const Zone& zone) {
  std::vector<Sight> sights(zone.request.turbines.size());
  parallel_for(sights.size(), [&](std::size_t k) {
    sights[k] = sight_to(view.surface, from, zone.request.turbines[k], zone.ground_m[k], zone.request.earth);
  });
  return sights;
}

Viewpoint viewpoint_of(const SiteRow& row, std::size_t number, const SectionSurface& ground, double usual_height) {
  if (!row.position) throw InputError(row.error);
  Viewpoint v;
  v.number = number;
  v.position = *row.position;
  v.name = row.values[0].value_or(fmt::format("{}", number));
  v.height = row.values[1] ? parse_height("its height", *row.values[1], Range::kNotNegative) : usual_height;
  const CrossSection here = ground.between(v.position, v.position);
  if (here.breakpoints.empty())
    throw InputError(fmt::format("there is no data at {:.10g},{:.10g}", v.position.x, v.position.y));
  v.ground = here.breakpoints.front().position.z;
  return v;
}

void write_wireline(const std::string& folder, const View& view, const Viewpoint& v, const Zone& zone,
                    const std::vector<Sight>& sights, double least_width, Progress& progress,
                    ViewpointOptions::Written& written) {
  const auto drawn =
      profile::survey_wireline(view.surface, wireline_of(v, zone, sights, least_width, view.title), progress);
  for (const char* ending : {".svg", ".pdf", ".png"}) {
    const std::string name = file_name(v, view.suffix) + ending;
    write_file(folder + "/" + name, profile::draw_wireline(drawn, name), true);
    written.files.push_back({name, fmt::format("wireline from viewpoint {}, {}, to scale{}", v.number, v.name,
                                               view.suffix.empty() ? "" : ", with what screens")});
  }
}

}  // namespace

ViewpointOptions::Written ViewpointOptions::write(const std::string& folder, const Store& store, const Zone& zone,
                                                  Progress& progress) const {
  Written written;
  written.path = query_.path;
  const SectionSurface ground(store, zone.request.detail);
  const View bare{ground, "Bare ground", ""};
  std::optional<SectionSurface> features;
  std::optional<View> screened;
  if (zone.request.themes) {
    features.emplace(store, zone.request.detail, *zone.request.themes);
    screened.emplace(
        View{*features,
             "Ground with " + fmt::format("{}", fmt::join(zone.request.themes->names(store.metadata().themes), ", ")),
             "-screened"});
  }
  std::string table = fmt::format("{}{}\n", kHeader, screened ? kScreenedHeader : "");
  for (const SiteRow& row : read_site_rows(query_, {"name", "height"}, store.metadata().crs_wkt)) {
    const std::size_t number = ++written.rows;
    try {
      const Viewpoint v = viewpoint_of(row, number, ground, zone.request.observer_height);
      const std::vector<Sight> sights = sights_to_all(bare, v, zone);
      std::vector<Sight> over_features;
      if (screened) over_features = sights_to_all(*screened, v, zone);
      for (std::size_t k = 0; k < sights.size(); ++k)
        table += row_of(v, zone.request.turbines[k], sights[k], screened ? &over_features[k] : nullptr);
      write_wireline(folder, bare, v, zone, sights, field_deg_, progress, written);
      if (screened) write_wireline(folder, *screened, v, zone, over_features, field_deg_, progress, written);
      written.places.push_back({fmt::format("{} {}", number, v.name), v.position});
    } catch (const InputError& error) {
      written.bad.push_back({number, row.feature, in_options(error.what())});
    }
  }
  if (written.rows == 0) throw InputError(none_in(query_, "viewpoint"));
  write_file(folder + "/viewpoints.csv", table, true);
  written.files.insert(
      written.files.begin(),
      {"viewpoints.csv", "viewpoint by turbine: hub and tip visible, metres and degrees seen, azimuth"});
  return written;
}

}  // namespace itin::cli
