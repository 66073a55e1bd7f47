#include <optional>

#include <itin/coordinates.hpp>
#include <itin/magnetic_north.hpp>
#include <profile/documents.hpp>
#include <profile/fresnel.hpp>

#include "lines/paths/path_cover.hpp"
#include "report/budget_document.hpp"

namespace itin::profile {

namespace {

Document cause(const LosReport& report, std::uint16_t theme) {
  return cause_of(report, theme);
}

/// Adds the feature's name by its source, its number in its theme, from 0, and its id; null where there is no
/// feature.
void add_feature(const LosReport& report, std::uint16_t theme, std::int64_t number, Document& document) {
  const auto known = report.features.find({theme, number});
  const bool found = known != report.features.end();
  document["feature"] = found ? Document(known->second.name) : Document(nullptr);
  document["feature_number"] = number < 0 ? Document(nullptr) : Document(number);
  document["feature_id"] = found && !known->second.id.empty() ? Document(known->second.id) : Document(nullptr);
}

Document place_document(const LosReport& report, const std::optional<ProfilePoint>& place) {
  if (!place) return nullptr;
  const ProfilePoint& p = *place;
  const bool placed = !report.crs_wkt.empty();
  Document document{{"distance_m", p.distance_m},
                    {"x", placed ? Document(p.x) : Document(nullptr)},
                    {"y", placed ? Document(p.y) : Document(nullptr)},
                    {"z", p.ground_m},
                    {"theme", cause(report, p.theme)}};
  add_feature(report, p.theme, p.feature, document);
  return document;
}

/// The document of the tightest place, which reports call the critical point.
Document tightest_document(const LosReport& report, const LineFindings& found) {
  Document place = place_document(report, found.critical);
  if (found.critical) place["clearance_m"] = number_or_null(found.clearance_m);
  return place;
}

Document obstructions_document(const LosReport& report, const LineFindings& found) {
  Document list = Document::array();
  for (const Obstruction& o : found.obstructions) {
    list.push_back({{"from_m", o.from_m},
                    {"to_m", o.to_m},
                    {"peak_at_m", o.peak_at_m},
                    {"peak_m", o.peak_m},
                    {"depth_m", o.depth_m},
                    {"theme", cause(report, o.theme)}});
    add_feature(report, o.theme, o.feature, list.back());
  }
  return list;
}

Document criteria_document(const LineFindings& found) {
  Document list = Document::array();
  for (const CriterionResult& c : found.criteria) {
    list.push_back({{"k", c.k},
                    {"fade", c.criterion.fade},
                    {"fraction", c.criterion.fraction},
                    {"verdict", name_of(c.verdict)},
                    {"clearance_m", number_or_null(c.clearance_m)},
                    {"clearance_f1", number_or_null(c.clearance_f1)},
                    {"margin_m", number_or_null(c.margin_m)},
                    {"margin_at_m", number_or_null(c.margin_at_m)},
                    {"margin_f1", number_or_null(c.margin_f1)},
                    {"margin_f1_at_m", number_or_null(c.margin_f1_at_m)}});
  }
  return list;
}

Document heights_document(const LineFindings& found) {
  Document list = Document::array();
  for (const NamedHeights& named : found.required) {
    Document curve = Document::array();
    for (const HeightPair& pair : named.curve) {
      curve.push_back({{"h1_m", pair.from_m}, {"h2_m", number_or_null(pair.to_m)}});
    }
    list.push_back({{"name", named.name},
                    {"k", number_or_null(named.k)},
                    {"fraction", named.fraction},
                    {"from_alone_m", number_or_null(named.heights.from_alone_m)},
                    {"to_alone_m", number_or_null(named.heights.to_alone_m)},
                    {"both_equal_m", number_or_null(named.heights.both_equal_m)},
                    {"curve", curve}});
  }
  return list;
}

Document edge_document(const DiffractionEdge& edge) {
  return {{"distance_m", edge.distance_m}, {"elevation_m", edge.elevation_m}, {"v", edge.v}, {"loss_db", edge.loss_db}};
}

Document edges_document(const PathLosses& losses) {
  Document deygout = Document::array();
  for (const DiffractionEdge& edge : losses.deygout) deygout.push_back(edge_document(edge));
  return {{"bullington", losses.bullington ? edge_document(*losses.bullington) : Document(nullptr)},
          {"deygout", deygout}};
}

Document reflection_document(const LosReport& report) {
  if (!report.reflection) return nullptr;
  const Reflection& r = *report.reflection;
  Document screen = place_document(report, r.screen);
  if (r.screen) screen["depth_m"] = r.screen_depth_m;
  return {{"distance_m", r.distance_m},
          {"ground_m", number_or_null(r.ground_m)},
          {"theme", cause(report, r.theme)},
          {"grazing_deg", r.grazing_deg},
          {"longer_by_m", r.longer_by_m},
          {"clear", r.ground_m ? Document(!r.screen) : Document(nullptr)},
          {"screen", screen}};
}

Document radio_document(const LosReport& report) {
  const RadioPath& path = *report.query.radio;
  const PathLosses& losses = *report.losses;
  Document radio{{"frequency_ghz", path.frequency_ghz},
                 {"wavelength_m", wavelength_m(path.frequency_ghz)},
                 {"wavelength", "0.299792458 / f, f in GHz"},
                 {"effective_earth_km", path.effective_earth_km},
                 {"polarisation", path.polarisation == Polarisation::kVertical ? "v" : "h"},
                 {"over_sea", path.over_sea}};
  radio["fresnel_fraction"] = report.fresnel ? number_or_null(report.fresnel->fraction) : Document(nullptr);
  radio["fresnel_fraction_at_m"] = report.fresnel ? Document(report.fresnel->distance_m) : Document(nullptr);
  radio["path"] = losses.horizons.trans_horizon ? "trans-horizon" : "line-of-sight";
  radio["theta_t_mrad"] = losses.horizons.theta_t_mrad;
  radio["theta_r_mrad"] = losses.horizons.theta_r_mrad;
  radio["dlt_km"] = number_or_null(losses.horizons.dlt_km);
  radio["dlr_km"] = number_or_null(losses.horizons.dlr_km);
  radio["hst_m"] = losses.smooth.hst_m;
  radio["hsr_m"] = losses.smooth.hsr_m;
  radio["hstd_m"] = losses.smooth.hstd_m;
  radio["hsrd_m"] = losses.smooth.hsrd_m;
  radio["hte_m"] = report.antennas.from_m - losses.smooth.hstd_m;
  radio["hre_m"] = report.antennas.to_m - losses.smooth.hsrd_m;
  radio["v"] = number_or_null(losses.largest_v);
  radio["losses_db"] = {{"free_space", losses.free_space_db},
                        {"knife_edge", losses.knife_edge_db},
                        {"bullington", losses.lba_db},
                        {"lba", losses.lba_db},
                        {"lbs", losses.lbs_db},
                        {"ldsph", losses.ldsph_db},
                        {"ld", losses.ld_db},
                        {"deygout", losses.deygout_db}};
  if (report.budget) radio["budget"] = budget_document(report);
  radio["edges"] = edges_document(losses);
  radio["reflection"] = reflection_document(report);
  return radio;
}

/// The document of the metres over each theme.
Document cover_document(const LosReport& report) {
  Document cover = Document::array();
  for (const ThemeLength& part : path_cover(report.profile))
    cover.push_back({{"theme", cause(report, part.theme)}, {"length_m", part.length_m}});
  return cover;
}

Document visible_document(const LosReport& report) {
  const VisibleHeight& seen = *report.visible;
  const auto part = [](const VisiblePart& p) { return Document{{"visible_m", p.visible_m}, {"fraction", p.fraction}}; };
  return {{"hub_m", number_or_null(report.query.object->hub_m)},
          {"tip_m", report.query.object->tip_m},
          {"hidden_below_m", seen.from_m},
          {"hub", seen.hub ? part(*seen.hub) : Document(nullptr)},
          {"tip", part(seen.tip)}};
}

Document findings_document(const LosReport& report, const LineFindings& found) {
  return {{"verdict", name_of(found.verdict)},
          {"known_verdict", name_of(found.known_verdict)},
          {"clearance_m", number_or_null(found.least_clearance_m)},
          {"critical", place_document(report, found.lowest)},
          {"tightest", tightest_document(report, found)},
          {"obstructions", obstructions_document(report, found)},
          {"criteria", criteria_document(found)},
          {"required_heights", heights_document(found)}};
}

Document end_document(const LosEnd& end) {
  const auto of_site = [&](auto member) { return end.site ? Document(member(*end.site)) : Document(nullptr); };
  return {{"x", of_site([](const LosEnd::Site& s) { return s.position.x; })},
          {"y", of_site([](const LosEnd::Site& s) { return s.position.y; })},
          {"lon", of_site([](const LosEnd::Site& s) { return s.lon_lat.x; })},
          {"lat", of_site([](const LosEnd::Site& s) { return s.lon_lat.y; })},
          {"ground_m", end.ground_m},
          {"surface_m", number_or_null(end.surface_m)},
          {"stands_on", end.on_surface ? "surface" : "ground"},
          {"height_m", end.height_m},
          {"elevation_m", end.elevation_m},
          {"azimuth_grid_deg", of_site([](const LosEnd::Site& s) { return s.azimuth_grid_deg; })},
          {"azimuth_true_deg", of_site([](const LosEnd::Site& s) { return s.azimuth_true_deg; })},
          {"azimuth_magnetic_deg", number_or_null(end.site ? end.site->azimuth_magnetic_deg : std::nullopt)},
          {"declination_deg", number_or_null(end.site ? end.site->declination_deg : std::nullopt)},
          {"elevation_angle_deg", end.elevation_angle_deg}};
}

/// The model of the declinations, or null where there are none.
Document magnetic_document(const LosReport& report) {
  const auto& day = report.query.day;
  if (!report.from.site || !day || !has_declination(*day)) return nullptr;
  return {{"model", kMagneticModel},
          {"day", iso_day_text(*day)},
          {"valid_from", kMagneticFrom},
          {"valid_until", kMagneticUntil}};
}

}  // namespace

Document los_document(const LosReport& report) {
  Document document;
  document["crs"] = report.crs_wkt.empty() ? Document(nullptr) : Document(crs_identifier(report.crs_wkt));
  document["refraction"] = earth_document(report.query.earth);
  document["from"] = end_document(report.from);
  document["to"] = end_document(report.to);
  document["magnetic_north"] = magnetic_document(report);
  document["distance_m"] = report.profile.length_m;
  document["geodesic_distance_m"] = number_or_null(report.geodesic_m);
  document.update(findings_document(report, report));
  if (report.bare) {
    document["bare"] = findings_document(report, *report.bare);
    if (report.bare->fresnel) document["bare"]["fresnel_fraction"] = report.bare->fresnel->fraction;
  }
  document["cover"] = cover_document(report);
  if (report.losses) document["radio"] = radio_document(report);
  if (report.visible) document["visible_height"] = visible_document(report);
  document["gaps"] = gaps_document(report.profile);
  document["gap_m"] = report.profile.gap_length_m();
  return document;
}

Document los_document(const StoreMetadata& metadata, const StoreLine& line, const LosReport& report) {
  Document document = los_document(report);
  document["surface"] = surface_document(metadata, line.detail, line.themes);
  document["sources"] = sources_document(report.sources);
  document["statistics"] = statistics_document(report.statistics, report.triangles);
  return document;
}

std::string json_of(const LosReport& report) {
  return result_text(los_document(report));
}

std::string json_of(const Store& store, const StoreLine& line, const LosReport& report) {
  return result_text(los_document(store.metadata(), line, report));
}

}  // namespace itin::profile
