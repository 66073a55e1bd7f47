#include "workflows/zone/output/viewpoint_tables.hpp"

#include <optional>

#include <fmt/format.h>

#include <itin/grid_reference.hpp>
#include <itin/table_columns.hpp>

#include "workflows/zone/sight_summary.hpp"

namespace itin::viewshed {

namespace {

/// A viewpoint and a turbine.
struct SightRow {
  const Viewpoint& viewpoint;
  const Turbine& turbine;
  const TurbineSight& bare;
  const TurbineSight* screened;  ///< null where nothing screens
};

using SightColumns = std::vector<TableColumn<SightRow>>;

const char* answer_of(TurbineSight::Verdict verdict) {
  constexpr const char* kWords[] = {"no", "yes", "undecided"};
  return kWords[verdict == TurbineSight::Verdict::kUndecided ? 2 : verdict == TurbineSight::Verdict::kVisible];
}

/// Adds columns for hub and tip, and for how much is seen. `ending` goes before the unit. Unknown values have no
/// number.
template <class SightOf>
void add_seen(SightColumns& columns, const std::string& ending, const SightOf& sight_of) {
  const auto add = [&](const std::string& name, auto of, const char* number = "{}") {
    columns.emplace_back(
        name, [sight_of, of](const SightRow& row) { return if_any(sight_of(row), of); }, kInCsv, number);
  };
  const auto if_known = [](double TurbineSight::*part) {
    return [part](const TurbineSight& s) {
      return s.tip == TurbineSight::Verdict::kUndecided ? std::nullopt : std::optional(s.*part);
    };
  };
  add("hub_visible" + ending, [](const TurbineSight& s) { return s.hub ? answer_of(*s.hub) : ""; });
  add("tip_visible" + ending, [](const TurbineSight& s) { return answer_of(s.tip); });
  add("visible_height" + ending + "_m", if_known(&TurbineSight::visible), "{:.2f}");
  add("vertical_angle" + ending + "_deg", if_known(&TurbineSight::vertical_deg), "{:.4f}");
}

SightColumns sight_columns(bool screened) {
  SightColumns columns{{"viewpoint", [](const SightRow& row) { return row.viewpoint.number; }},
                       {"viewpoint_name", [](const SightRow& row) { return row.viewpoint.name; }},
                       {"x", [](const SightRow& row) { return row.viewpoint.position.x; }, kInCsv, "{:.1f}"},
                       {"y", [](const SightRow& row) { return row.viewpoint.position.y; }, kInCsv, "{:.1f}"},
                       {"ground_m", [](const SightRow& row) { return row.viewpoint.ground; }, kInCsv, "{:.2f}"},
                       {"turbine", [](const SightRow& row) { return row.turbine.number; }},
                       {"turbine_name", [](const SightRow& row) { return row.turbine.name; }},
                       {"farm", [](const SightRow& row) { return row.turbine.farm; }},
                       {"distance_m", [](const SightRow& row) { return row.bare.distance; }, kInCsv, "{:.1f}"},
                       {"azimuth_grid_deg", [](const SightRow& row) { return row.bare.azimuth; }, kInCsv, "{:.2f}"}};
  add_seen(columns, "", [](const SightRow& row) { return &row.bare; });
  columns.emplace_back(
      "tip_elevation_deg", [](const SightRow& row) { return row.bare.tip_deg; }, kInCsv, "{:.4f}");
  columns.emplace_back("within_radius", [](const SightRow& row) { return row.bare.distance <= row.turbine.radius; });
  columns.emplace_back("note", [](const SightRow& row) { return row.bare.gaps ? "crosses ground without data" : ""; });
  if (screened) add_seen(columns, "_screened", [](const SightRow& row) { return row.screened; });
  return columns;
}

/// All that is seen from a viewpoint.
struct ViewRow {
  ViewRow(const StudiedViewpoint& v, const Zone& zone)
      : viewpoint(v.viewpoint), studied(v), bare(seen_of(zone, v.bare, all_turbines(zone))) {
    if (!v.screened.empty()) screened = seen_of(zone, v.screened, all_turbines(zone));
  }
  const TurbineSight& nearest() const { return studied.bare[bare.nearest]; }

  const Viewpoint& viewpoint;
  const StudiedViewpoint& studied;
  SightSummary bare;
  std::optional<SightSummary> screened;  ///< nothing where nothing screens
};

using ViewColumns = std::vector<TableColumn<ViewRow>>;

/// The sights over one of the two surfaces, and their summary.
struct SeenOver {
  const SightSummary& seen;
  const std::vector<TurbineSight>& sights;
};
std::optional<SeenOver> seen_over(const ViewRow& row, bool screened) {
  if (!screened) return SeenOver{row.bare, row.studied.bare};
  if (!row.screened) return std::nullopt;
  return SeenOver{*row.screened, row.studied.screened};
}

/// Returns the cells of a column about one of the two surfaces.
template <class Of>
auto of_surface(bool screened, Of of) {
  return [screened, of](const ViewRow& row) { return if_any(seen_over(row, screened), of); };
}

/// Adds how much is seen over one of the two surfaces. `ending` goes before the unit.
void add_summary(ViewColumns& columns, const Zone& zone, bool screened) {
  const std::string ending = screened ? "_screened" : "";
  const auto add = [&](const std::string& name, auto of, const char* number = "{}") {
    columns.emplace_back(name, of_surface(screened, of), kInCsv, number);
  };
  add("hubs_visible" + ending, [](const SeenOver& over) { return over.seen.hubs; });
  add("tips_visible" + ending, [](const SeenOver& over) { return over.seen.tips; });
  add("nearest_visible_turbine" + ending, [&zone](const SeenOver& over) {
    return if_any(over.seen.nearest_seen, [&](std::size_t k) { return zone.request.turbines[k].number; });
  });
  add(
      "nearest_visible" + ending + "_m",
      [](const SeenOver& over) {
        return if_any(over.seen.nearest_seen, [&](std::size_t k) { return over.sights[k].distance; });
      },
      "{:.0f}");
  add(
      "horizontal_from" + ending + "_deg", [](const SeenOver& over) { return if_any(over.seen.arc, &Arc::from); },
      "{:.1f}");
  add(
      "horizontal_extent" + ending + "_deg", [](const SeenOver& over) { return if_any(over.seen.arc, &Arc::width); },
      "{:.1f}");
  add("vertical_angle" + ending + "_deg", [](const SeenOver& over) {
    return over.seen.nearest_seen ? fmt::format("{:.3f}", over.seen.vertical_deg) : "0";
  });
}

void add_undecided(ViewColumns& columns, bool screened) {
  const std::string ending = screened ? "_screened" : "";
  columns.emplace_back("hubs_undecided" + ending,
                       of_surface(screened, [](const SeenOver& over) { return over.seen.hubs_undecided; }));
  columns.emplace_back("tips_undecided" + ending,
                       of_surface(screened, [](const SeenOver& over) { return over.seen.tips_undecided; }));
}

ViewColumns view_columns(const ZoneStudy& study) {
  const Zone& zone = study.zone;
  const bool national = is_national_grid(study.metadata.crs_wkt), screened = zone.screened.has_value();
  ViewColumns columns;
  const auto add = [&](const char* name, auto of, const char* number = "{}") {
    columns.emplace_back(name, of, kInCsv, number);
  };
  add("viewpoint", [](const ViewRow& row) { return row.viewpoint.number; });
  add("viewpoint_name", [](const ViewRow& row) { return row.viewpoint.name; });
  add(
      "x", [](const ViewRow& row) { return row.viewpoint.position.x; }, "{:.1f}");
  add(
      "y", [](const ViewRow& row) { return row.viewpoint.position.y; }, "{:.1f}");
  add("grid_reference", [national](const ViewRow& row) {
    return national ? national_grid_reference(row.viewpoint.position) : std::nullopt;
  });
  add(
      "ground_m", [](const ViewRow& row) { return row.viewpoint.ground; }, "{:.1f}");
  add(
      "eye_m", [](const ViewRow& row) { return row.viewpoint.ground + row.viewpoint.height; }, "{:.1f}");
  add("turbines", [](const ViewRow& row) { return row.bare.turbines; });
  add("nearest_turbine", [&zone](const ViewRow& row) { return zone.request.turbines[row.bare.nearest].number; });
  add(
      "nearest_m", [](const ViewRow& row) { return row.nearest().distance; }, "{:.0f}");
  add(
      "nearest_azimuth_grid_deg", [](const ViewRow& row) { return row.nearest().azimuth; }, "{:.1f}");
  add_summary(columns, zone, false);
  if (screened) add_summary(columns, zone, true);
  add("tips_beyond_radius", [](const ViewRow& row) { return row.bare.tips_beyond; });
  add("note", [](const ViewRow& row) { return row.bare.gaps ? "some lines cross ground without data" : ""; });
  if (screened) add("before_the_eye", [](const ViewRow& row) { return row.studied.before_the_eye; });
  add_undecided(columns, false);
  if (screened) add_undecided(columns, true);
  return columns;
}

}  // namespace

std::string viewpoint_table(const ZoneStudy& study) {
  std::vector<SightRow> rows;
  for (const StudiedViewpoint& v : study.viewpoints)
    for (std::size_t k = 0; k < v.bare.size(); ++k)
      rows.push_back(
          {v.viewpoint, study.zone.request.turbines[k], v.bare[k], v.screened.empty() ? nullptr : &v.screened[k]});
  return csv_of(sight_columns(study.zone.screened.has_value()), rows);
}

std::string viewpoint_summary(const ZoneStudy& study) {
  std::vector<ViewRow> rows;
  for (const StudiedViewpoint& v : study.viewpoints) rows.emplace_back(v, study.zone);
  return csv_of(view_columns(study), rows);
}

}  // namespace itin::viewshed
