#include "workflows/premises/output/premises_tables.hpp"

#include <cmath>

#include <itin/feature_style.hpp>
#include <itin/table_columns.hpp>
#include <viewshed/result_sheet.hpp>

#include "workflows/premises/output/wall_service.hpp"

namespace itin::viewshed {

namespace {

constexpr const char *kMillimetres = "{:.3f}", *kAsGiven = "{:.10g}";

/// A building, and the link and the antenna that its row tells of: null where no mast is within reach.
struct PremisesRow {
  explicit PremisesRow(const Premises& p) : premises(p), link(p.best ? &p.links[*p.best] : p.nearest_miss()) {
    if (link != nullptr) mounting = p.best ? &p.best_mounting() : link->tried ? &*link->tried : nullptr;
    if (link != nullptr && link->blocker) blocker = &*link->blocker;
  }
  const Premises& premises;
  const PremisesLink* link = nullptr;
  const Mounting* mounting = nullptr;
  const LinkBlocker* blocker = nullptr;
};

/// A building and a mast within reach.
struct PremisesLinkRow {
  PremisesLinkRow(const Premises& p, const PremisesLink& l)
      : premises(p), link(l), blocker(l.blocker ? &*l.blocker : nullptr) {
    for (const auto* told : {&l.wall, &l.roof, &l.tried})
      if (mounting == nullptr && *told) mounting = &**told;
  }
  const Premises& premises;
  const PremisesLink& link;
  const Mounting* mounting = nullptr;
  const LinkBlocker* blocker;
};

struct WallRow {
  const Premises& premises;
  const WallPlace& wall;
};
struct RoofRow {
  const Premises& premises;
  const RoofPlace& place;
};
/// How many buildings a mast reaches, serves, and serves best.
struct MastService {
  std::size_t within_reach = 0, serves = 0, best = 0;
};
struct MastRow {
  const SitePosition& mast;
  MastService service;
};

template <class Row>
using Columns = std::vector<TableColumn<Row>>;

template <class Row>
void add_building(const PremisesSurvey& survey, Columns<Row>& columns, int formats) {
  columns.emplace_back(
      "theme", [&survey](const Row& row) { return survey.metadata.themes[row.premises.theme - std::size_t{1}].name; },
      formats);
  columns.emplace_back(
      "name", [](const Row& row) { return row.premises.name; }, formats);
  columns.emplace_back(
      "id", [](const Row& row) { return row.premises.id; }, formats);
}

/// Adds what the row's antenna is on, where, its height, elevations and distance. Layers have height and distance.
template <class Row>
void add_mounting(Columns<Row>& columns) {
  const auto add = [&](const char* name, auto of, int formats = kInCsv, const char* number = kMillimetres) {
    columns.emplace_back(
        name, [of](const Row& row) { return if_any(row.mounting, of); }, formats, number);
  };
  add("on", [](const Mounting& m) { return word_of(m.on); });
  add("x", [](const Mounting& m) { return m.position.x; });
  add("y", [](const Mounting& m) { return m.position.y; });
  add("height_m", &Mounting::height_m, kInCsv | kInLayer, kAsGiven);
  add("base_m", &Mounting::base_m);
  add("elevation_m", &Mounting::elevation_m);
  add("distance_m", &Mounting::distance_m, kInCsv | kInLayer);
}

/// Adds what blocks the row's link. Layers have its names.
template <class Row>
void add_blocker(const PremisesSurvey& survey, Columns<Row>& columns) {
  const auto add = [&](const char* name, auto of, int formats = kInCsv) {
    using Value = decltype(of(std::declval<const LinkBlocker&>()));
    using Cell = std::conditional_t<std::is_same_v<Value, std::string>, std::string, std::optional<Value>>;
    columns.emplace_back(
        name, [of](const Row& row) { return row.blocker != nullptr ? Cell(of(*row.blocker)) : Cell(); }, formats,
        kMillimetres);
  };
  add(
      "blocked_by", [&survey](const LinkBlocker& b) { return theme_of(b.theme, survey.metadata); }, kInCsv | kInLayer);
  add(
      "blocking_feature", [](const LinkBlocker& b) { return b.name; }, kInCsv | kInLayer);
  add("blocked_x", [](const LinkBlocker& b) { return b.position.x; });
  add("blocked_y", [](const LinkBlocker& b) { return b.position.y; });
  add("blocked_by_itself", [](const LinkBlocker& b) { return b.own; });
}

std::size_t walls_served(const Premises& p) {
  std::size_t served = 0;
  for (const WallPlace& wall : p.walls) served += wall.mast.has_value();
  return served;
}

const char* service_of_row(const PremisesRow& row) {
  return class_of(service_of(row.premises)).name;
}

std::vector<PremisesRow> premises_rows(const PremisesSurvey& survey) {
  return {survey.premises.begin(), survey.premises.end()};
}

Columns<PremisesRow> premises_columns(const PremisesSurvey& survey) {
  Columns<PremisesRow> columns;
  const auto add = [&](const char* name, auto of, int formats = kInCsv | kInLayer) {
    columns.emplace_back(name, of, formats);
  };
  add_building(survey, columns, kInCsv | kInLayer);
  add("service", service_of_row);
  add("verdict", [](const PremisesRow& row) { return word_of(row.premises.verdict()); });
  add("mast", [&survey](const PremisesRow& row) {
    return row.link == nullptr ? std::string() : survey.masts[row.link->mast].name;
  });
  add_mounting(columns);
  add(
      "masts_in_reach", [](const PremisesRow& row) { return row.premises.links.size(); }, kInCsv);
  add("masts_serving", [](const PremisesRow& row) { return row.premises.masts_serving(); });
  add(
      "walls", [](const PremisesRow& row) { return row.premises.walls.size(); }, kInCsv);
  add(
      "walls_served", [](const PremisesRow& row) { return walls_served(row.premises); }, kInCsv);
  add_blocker(survey, columns);
  return columns;
}

Columns<PremisesLinkRow> premises_link_columns(const PremisesSurvey& survey) {
  Columns<PremisesLinkRow> columns;
  const auto add = [&](const char* name, auto of) { columns.emplace_back(name, of, kInCsv, kAsGiven); };
  add_building(survey, columns, kInCsv);
  add("mast", [&survey](const PremisesLinkRow& row) { return survey.masts[row.link.mast].name; });
  add("verdict", [](const PremisesLinkRow& row) { return word_of(row.link.verdict); });
  add("wall_height_m", [](const PremisesLinkRow& row) { return if_any(row.link.wall, &Mounting::height_m); });
  add("pole_m", [](const PremisesLinkRow& row) { return if_any(row.link.roof, &Mounting::height_m); });
  add_mounting(columns);
  add_blocker(survey, columns);
  return columns;
}

/// Adds the least pole that sees the street, and what hides the street from lower ones.
void add_street(const PremisesSurvey& survey, Columns<RoofRow>& columns) {
  const auto add = [&](const char* name, auto of) {
    columns.emplace_back(
        name, [of](const RoofRow& row) { return if_any(row.place.street, of); }, kInCsv, kMillimetres);
  };
  const auto add_edge = [&](const char* name, auto of) {
    columns.emplace_back(
        name,
        [of](const RoofRow& row) {
          const StreetSight::Edge* edge =
              row.place.street && row.place.street->edge ? &*row.place.street->edge : nullptr;
          return if_any(edge, [&](const StreetSight::Edge& e) { return of(e, row.place); });
        },
        kInCsv, kMillimetres);
  };
  using Edge = StreetSight::Edge;
  add("street_x", [](const StreetSight& s) { return s.street.x; });
  add("street_y", [](const StreetSight& s) { return s.street.y; });
  // Poles are rounded up, so that the street is in sight from what is told.
  add("street_pole_m", [](const StreetSight& s) { return std::ceil(s.pole_m * 1000) / 1000; });
  add_edge("hidden_by", [&survey](const Edge& e, const RoofPlace&) { return theme_of(e.theme, survey.metadata); });
  add_edge("hidden_x", [](const Edge& e, const RoofPlace&) { return e.position.x; });
  add_edge("hidden_y", [](const Edge& e, const RoofPlace&) { return e.position.y; });
  // Zero has no sign.
  add_edge("hidden_above_roof_m", [](const Edge& e, const RoofPlace& place) {
    return std::round((e.position.z - place.roof_m) * 1000) / 1000 + 0.0;
  });
}

Columns<RoofRow> roof_columns(const PremisesSurvey& survey) {
  Columns<RoofRow> columns;
  const auto add = [&](const char* name, auto of, const char* number = kMillimetres) {
    columns.emplace_back(name, of, kInCsv, number);
  };
  const auto if_served = [](auto of) {
    return
        [of](const RoofRow& row) { return if_any(row.place.mast, [&](auto) { return std::invoke(of, row.place); }); };
  };
  add_building(survey, columns, kInCsv);
  add("x", [](const RoofRow& row) { return row.place.position.x; });
  add("y", [](const RoofRow& row) { return row.place.position.y; });
  add("roof_m", [](const RoofRow& row) { return row.place.roof_m; });
  add("mast", if_served([&survey](const RoofPlace& place) { return survey.masts[*place.mast].name; }));
  add("pole_m", if_served(&RoofPlace::height_m), kAsGiven);
  add("distance_m", if_served(&RoofPlace::distance_m));
  add_street(survey, columns);
  return columns;
}

VectorLayer layer_of_premises(const PremisesSurvey& survey) {
  const auto place = [](const PremisesRow& row) -> std::vector<Point3> {
    const Point2 foot = row.premises.foot.front().front();
    if (row.mounting == nullptr) return {{foot.x, foot.y, 0}};
    return {{row.mounting->position.x, row.mounting->position.y, row.mounting->elevation_m()}};
  };
  return layer_of("premises", VectorLayer::Shape::kPoints, premises_columns(survey), premises_rows(survey), place,
                  point_style("service", kPremisesServices));
}

VectorLayer layer_of_facades(const PremisesSurvey& survey) {
  const auto if_served = [](auto of) {
    return [of](const WallRow& row) { return if_any(row.wall.mast, [&](auto) { return std::invoke(of, row.wall); }); };
  };
  const Columns<WallRow> columns{
      {"name", [](const WallRow& row) { return row.premises.name; }},
      {"service", [&](const WallRow& row) { return class_of(service_of(row.wall, survey.request.storey)).name; }},
      {"mast", if_served([&](const WallPlace& wall) { return survey.masts[*wall.mast].name; })},
      {"least_height_m", if_served(&WallPlace::height_m)},
      {"wall_m", [](const WallRow& row) { return row.wall.most_m; }},
      {"x", [](const WallRow& row) { return row.wall.position.x; }},
      {"y", [](const WallRow& row) { return row.wall.position.y; }}};
  std::vector<WallRow> rows;
  for (const Premises& p : survey.premises)
    for (const WallPlace& wall : p.walls) rows.push_back({p, wall});
  const auto top = [](const WallRow& row) {
    std::vector<Point3> line;
    for (const Point3& at : row.wall.stretch) line.push_back({at.x, at.y, row.wall.ground_m + row.wall.most_m});
    return line;
  };
  return layer_of("facades", VectorLayer::Shape::kLines, columns, rows, top, line_style("service", kWallServices, 0.8));
}

VectorLayer layer_of_best_links(const PremisesSurvey& survey) {
  const auto mast = [&](const PremisesRow& row) -> const SitePosition& { return survey.masts[row.link->mast]; };
  const Columns<PremisesRow> columns{{"mast", [&](const PremisesRow& row) { return mast(row).name; }},
                                     {"name", [](const PremisesRow& row) { return row.premises.name; }},
                                     {"service", service_of_row},
                                     {"height_m", [](const PremisesRow& row) { return row.mounting->height_m; }},
                                     {"distance_m", [](const PremisesRow& row) { return row.mounting->distance_m; }}};
  std::vector<PremisesRow> rows;
  for (const Premises& p : survey.premises)
    if (p.best) rows.emplace_back(p);
  const auto line = [&](const PremisesRow& row) {
    const SitePosition& a = mast(row);
    const Mounting& b = *row.mounting;
    return std::vector<Point3>{{a.position.x, a.position.y, a.elevation()},
                               {b.position.x, b.position.y, b.elevation_m()}};
  };
  return layer_of("links", VectorLayer::Shape::kLines, columns, rows, line,
                  line_style("service", std::span(kPremisesServices).first(2), 0.15));
}

/// Returns one for each mast.
std::vector<MastService> services_of(const PremisesSurvey& survey) {
  std::vector<MastService> services(survey.masts.size());
  for (const Premises& p : survey.premises) {
    for (const PremisesLink& link : p.links) {
      ++services[link.mast].within_reach;
      services[link.mast].serves += link.verdict == Verdict::kVisible;
    }
    if (p.best) ++services[p.links[*p.best].mast].best;
  }
  return services;
}

const Columns<MastRow>& mast_columns() {
  static const Columns<MastRow> columns{
      {"name", [](const MastRow& row) { return row.mast.name; }},
      {"x", [](const MastRow& row) { return row.mast.position.x; }, kInDocument},
      {"y", [](const MastRow& row) { return row.mast.position.y; }, kInDocument},
      {"height_m", [](const MastRow& row) { return row.mast.height; }},
      {"ground_m", [](const MastRow& row) { return row.mast.ground; }, kInLayer},
      {"stands_on_m", [](const MastRow& row) { return row.mast.ground; }, kInDocument},
      {"within_reach", [](const MastRow& row) { return row.service.within_reach; }, kInDocument},
      {"serves", [](const MastRow& row) { return row.service.serves; }},
      {"serves_best", [](const MastRow& row) { return row.service.best; }}};
  return columns;
}

std::vector<MastRow> mast_rows(const PremisesSurvey& survey) {
  const std::vector<MastService> services = services_of(survey);
  std::vector<MastRow> rows;
  for (std::size_t i = 0; i < services.size(); ++i) rows.push_back({survey.masts[i], services[i]});
  return rows;
}

VectorLayer layer_of_masts(const PremisesSurvey& survey) {
  const auto place = [](const MastRow& row) {
    return std::vector<Point3>{{row.mast.position.x, row.mast.position.y, row.mast.ground}};
  };
  return layer_of("masts", VectorLayer::Shape::kPoints, mast_columns(), mast_rows(survey), place,
                  point_style({"mast", "Mast", kMastColour}));
}

}  // namespace

std::string premises_csv(const PremisesSurvey& survey) {
  return csv_of(premises_columns(survey), premises_rows(survey));
}

std::string premises_links_csv(const PremisesSurvey& survey) {
  std::vector<PremisesLinkRow> rows;
  for (const Premises& p : survey.premises)
    for (const PremisesLink& link : p.links) rows.emplace_back(p, link);
  return csv_of(premises_link_columns(survey), rows);
}

std::string premises_roofs_csv(const PremisesSurvey& survey) {
  std::vector<RoofRow> rows;
  for (const Premises& p : survey.premises)
    for (const RoofPlace& place : p.roof) rows.push_back({p, place});
  return csv_of(roof_columns(survey), rows);
}

Document masts_document(const PremisesSurvey& survey) {
  return documents_of(mast_columns(), mast_rows(survey));
}

std::vector<VectorLayer> premises_layers(const PremisesSurvey& survey) {
  return {layer_of_facades(survey), layer_of_premises(survey), layer_of_best_links(survey), layer_of_masts(survey)};
}

}  // namespace itin::viewshed
