#include "workflows/zone/viewpoint_study.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/memory_shares.hpp>
#include <itin/parsed_number.hpp>
#include <itin/site_list.hpp>
#include <itin/site_table.hpp>
#include <viewshed/turbine_sights.hpp>

#include "workflows/zone/sight_summary.hpp"
#include "workflows/zone/study_document.hpp"
#include "workflows/zone/usable_rows.hpp"

namespace itin::viewshed {

namespace {

Viewpoint viewpoint_of(const SiteRow& row, std::size_t number, double usual_height) {
  if (!row.position) throw InputError(row.error);
  Viewpoint v;
  v.number = number;
  v.position = *row.position;
  v.name = row.values[0].value_or(fmt::format("{}", number));
  v.height = row.values[1] ? parse_height("its height", with_decimal_point(*row.values[1]), NumberRange::kNotNegative)
                           : usual_height;
  return v;
}

std::vector<std::string> names_of_themes(const StoreMetadata& metadata) {
  std::vector<std::string> names;
  for (const ThemeInfo& theme : metadata.themes) names.push_back(theme.name);
  return names;
}

StudiedViewpoint look_from_viewpoint(const Viewpoint& v, const StudySurfaces& surfaces, const Zone& zone,
                                     const std::vector<std::string>& themes) {
  StudiedViewpoint studied{v, sights_to_all(surfaces.ground, v, zone), {}, {}};
  if (!surfaces.features) return studied;
  studied.screened = sights_to_all(*surfaces.features, v, zone);
  const SightSummary seen = seen_of(zone, studied.screened, all_turbines(zone));
  studied.before_the_eye = before_the_eye(*surfaces.features, v, zone.request.turbines[seen.nearest].position, themes);
  return studied;
}

}  // namespace

StudySurfaces::StudySurfaces(const Store& store, const ZoneRequest& request)
    : ground(store, request.detail, ThemeChoice::none(), section_cache_within(request.memory_bytes)) {
  if (request.themes)
    features.emplace(store, request.detail, *request.themes, section_cache_within(request.memory_bytes));
}

ViewpointTable read_viewpoints(const PointFile& file, const std::string& to_crs, double height) {
  SiteQuery query;
  query.path = file.path, query.layer = file.layer, query.where = file.where, query.crs = file.crs;
  query.name_field = file.name_field;
  ViewpointTable table;
  table.path = file.path;
  const LayerFields fields(query);
  take_names(query, fields);
  take_heights(query, fields, {}, table.warnings);
  for (const SiteRow& row : read_site_rows(query, {{query.name_field}, {query.height_field}}, to_crs, table.warnings)) {
    const std::size_t number = ++table.rows;
    table.features.push_back(row.feature), table.places.push_back(row.place);
    try {
      table.viewpoints.push_back(viewpoint_of(row, number, height));
    } catch (const InputError& error) {
      table.bad.push_back({number, row.feature, row.place, error.what()});
    }
  }
  if (table.rows == 0) throw InputError(none_in(query, "viewpoint"));
  if (table.viewpoints.empty()) throw InputError(none_usable(file.path, table.rows, table.bad.front().message));
  return table;
}

std::vector<StudiedViewpoint> study_viewpoints(const StudySurfaces& surfaces, const Zone& zone,
                                               const StoreMetadata& metadata, ViewpointTable& table,
                                               Progress& progress) {
  const std::vector<std::string> themes = names_of_themes(metadata);
  std::vector<StudiedViewpoint> studied;
  for (Viewpoint v : table.viewpoints) {
    progress.throw_if_cancelled();
    const CrossSection here = surfaces.ground.between(v.position, v.position);
    if (here.breakpoints.empty()) {
      table.bad.push_back(
          bad_row(table, v.number, fmt::format("there is no data at {:.10g},{:.10g}", v.position.x, v.position.y)));
      continue;
    }
    v.ground = here.breakpoints.front().position.z;
    studied.push_back(look_from_viewpoint(v, surfaces, zone, themes));
  }
  std::sort(table.bad.begin(), table.bad.end(), [](const BadRow& a, const BadRow& b) { return a.number < b.number; });
  return studied;
}

}  // namespace itin::viewshed
