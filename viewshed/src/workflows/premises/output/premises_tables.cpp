#include "workflows/premises/output/premises_tables.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>

#include "files/vector_styles.hpp"
#include "workflows/premises/output/wall_service.hpp"

namespace itin::viewshed {

namespace {

using Type = VectorLayer::Type;

const std::string& theme_name(const PremisesSurvey& survey, const Premises& p) {
  return survey.metadata.themes[p.theme - std::size_t{1}].name;
}

/// x, y, what the antenna is on, its height, elevations and the distance; seven empty cells for nothing.
std::string mounting_cells(const Mounting* m) {
  if (m == nullptr) return ",,,,,,";
  return fmt::format("{},{:.3f},{:.3f},{:.10g},{:.3f},{:.3f},{:.3f}", word_of(m->on), m->position.x, m->position.y,
                     m->height_m, m->base_m, m->elevation_m(), m->distance_m);
}
constexpr const char* kMountingColumns = "on,x,y,height_m,base_m,elevation_m,distance_m";

std::string blocker_cells(const PremisesSurvey& survey, const LinkBlocker* b) {
  if (b == nullptr) return ",,,,";
  return fmt::format("{},{},{:.3f},{:.3f},{}", csv_cell(theme_of(b->theme, survey.metadata)), csv_cell(b->name),
                     b->position.x, b->position.y, b->own ? "yes" : "no");
}
constexpr const char* kBlockerColumns = "blocked_by,blocking_feature,blocked_x,blocked_y,blocked_by_itself";

std::string roof_cells(const PremisesSurvey& survey, const RoofPlace& place) {
  const std::string at = fmt::format("{:.3f},{:.3f},{:.3f}", place.position.x, place.position.y, place.roof_m);
  if (!place.mast) return at + ",,,";
  return fmt::format("{},{},{:.10g},{:.3f}", at, csv_cell(survey.masts[*place.mast].name), place.height_m,
                     place.distance_m);
}
constexpr const char* kRoofColumns = "x,y,roof_m,mast,pole_m,distance_m";

/// Without a sign where it is 0.
double in_whole_millimetres(double metres) {
  return std::round(metres * 1000) / 1000 + 0.0;
}

std::string street_cells(const PremisesSurvey& survey, const RoofPlace& place) {
  if (!place.street) return ",,,,,,";
  const auto& [street, pole, edge] = *place.street;
  // Poles are rounded up, so that the street is in sight from what is told.
  std::string cells = fmt::format("{:.3f},{:.3f},{:.3f},", street.x, street.y, std::ceil(pole * 1000) / 1000);
  if (!edge) return cells + ",,,";
  return cells + fmt::format("{},{:.3f},{:.3f},{:.3f}", csv_cell(theme_of(edge->theme, survey.metadata)),
                             edge->position.x, edge->position.y, in_whole_millimetres(edge->position.z - place.roof_m));
}
constexpr const char* kStreetColumns =
    "street_x,street_y,street_pole_m,hidden_by,hidden_x,hidden_y,hidden_above_roof_m";

template <class T>
const T* pointer_to(const std::optional<T>& value) {
  return value ? &*value : nullptr;
}

/// The link that a building's row tells of, and its antenna: null where no mast is within reach.
struct ToldLink {
  explicit ToldLink(const Premises& p) : link(p.best ? &p.links[*p.best] : p.nearest_miss()) {
    if (link != nullptr) mounting = p.best ? &p.best_mounting() : pointer_to(link->tried);
  }
  const PremisesLink* link = nullptr;
  const Mounting* mounting = nullptr;
};

std::string mast_name(const PremisesSurvey& survey, const PremisesLink* link) {
  return link == nullptr ? "" : survey.masts[link->mast].name;
}

std::size_t walls_served(const Premises& p) {
  std::size_t served = 0;
  for (const WallPlace& wall : p.walls) served += wall.mast.has_value();
  return served;
}

VectorLayer::Value whole(std::size_t value) {
  return static_cast<std::int64_t>(value);
}

VectorLayer layer_of_premises(const PremisesSurvey& survey) {
  VectorLayer layer{"premises",
                    VectorLayer::Shape::kPoints,
                    {{"theme", Type::kText},
                     {"name", Type::kText},
                     {"id", Type::kText},
                     {"service", Type::kText},
                     {"verdict", Type::kText},
                     {"mast", Type::kText},
                     {"height_m", Type::kNumber},
                     {"distance_m", Type::kNumber},
                     {"masts_serving", Type::kWhole},
                     {"blocked_by", Type::kText},
                     {"blocking_feature", Type::kText}},
                    {},
                    point_style("service", kPremisesServices)};
  for (const Premises& p : survey.premises) {
    const ToldLink told(p);
    const LinkBlocker* const blocker = told.link == nullptr ? nullptr : pointer_to(told.link->blocker);
    const Point2 at = told.mounting == nullptr ? p.foot.front().front() : told.mounting->position;
    VectorLayer::Value height, distance;
    if (told.mounting != nullptr) height = told.mounting->height_m, distance = told.mounting->distance_m;
    layer.features.push_back(
        {{{at.x, at.y, told.mounting == nullptr ? 0 : told.mounting->elevation_m()}},
         {theme_name(survey, p), p.name, p.id, std::string(class_of(service_of(p)).name),
          std::string(word_of(p.verdict())), mast_name(survey, told.link), height, distance, whole(p.masts_serving()),
          blocker == nullptr ? std::string() : theme_of(blocker->theme, survey.metadata),
          blocker == nullptr ? std::string() : blocker->name}});
  }
  return layer;
}

VectorLayer layer_of_facades(const PremisesSurvey& survey) {
  VectorLayer layer{"facades",
                    VectorLayer::Shape::kLines,
                    {{"name", Type::kText},
                     {"service", Type::kText},
                     {"mast", Type::kText},
                     {"least_height_m", Type::kNumber},
                     {"wall_m", Type::kNumber},
                     {"x", Type::kNumber},
                     {"y", Type::kNumber}},
                    {},
                    line_style("service", kWallServices, 0.8)};
  for (const Premises& p : survey.premises) {
    for (const WallPlace& wall : p.walls) {
      VectorLayer::Value mast, height;
      if (wall.mast) mast = survey.masts[*wall.mast].name, height = wall.height_m;
      VectorLayer::Feature feature{{},
                                   {p.name, std::string(class_of(service_of(wall, survey.request.storey)).name), mast,
                                    height, wall.most_m, wall.position.x, wall.position.y}};
      for (const Point3& at : wall.stretch) feature.points.push_back({at.x, at.y, wall.ground_m + wall.most_m});
      layer.features.push_back(std::move(feature));
    }
  }
  return layer;
}

VectorLayer layer_of_best_links(const PremisesSurvey& survey) {
  VectorLayer layer{"links",
                    VectorLayer::Shape::kLines,
                    {{"mast", Type::kText},
                     {"name", Type::kText},
                     {"service", Type::kText},
                     {"height_m", Type::kNumber},
                     {"distance_m", Type::kNumber}},
                    {},
                    line_style("service", std::span(kPremisesServices).first(2), 0.15)};
  for (const Premises& p : survey.premises) {
    if (!p.best) continue;
    const SitePosition& mast = survey.masts[p.links[*p.best].mast];
    const Mounting& m = p.best_mounting();
    layer.features.push_back(
        {{{mast.position.x, mast.position.y, mast.elevation()}, {m.position.x, m.position.y, m.elevation_m()}},
         {mast.name, p.name, std::string(class_of(service_of(p)).name), m.height_m, m.distance_m}});
  }
  return layer;
}

VectorLayer layer_of_masts(const PremisesSurvey& survey) {
  VectorLayer layer{"masts",
                    VectorLayer::Shape::kPoints,
                    {{"name", Type::kText},
                     {"height_m", Type::kNumber},
                     {"ground_m", Type::kNumber},
                     {"serves", Type::kWhole},
                     {"serves_best", Type::kWhole}},
                    {}};
  const std::vector<MastService> services = services_of(survey);
  for (std::size_t i = 0; i < survey.masts.size(); ++i) {
    const SitePosition& mast = survey.masts[i];
    layer.features.push_back(
        {{{mast.position.x, mast.position.y, mast.ground}},
         {mast.name, mast.height, mast.ground, whole(services[i].serves), whole(services[i].best)}});
  }
  return layer;
}

}  // namespace

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

std::string premises_csv(const PremisesSurvey& survey) {
  std::string text =
      fmt::format("theme,name,id,service,verdict,mast,{},masts_in_reach,masts_serving,walls,walls_served,{}\n",
                  kMountingColumns, kBlockerColumns);
  for (const Premises& p : survey.premises) {
    const ToldLink told(p);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(theme_name(survey, p)),
                   csv_cell(p.name), csv_cell(p.id), class_of(service_of(p)).name, word_of(p.verdict()),
                   csv_cell(mast_name(survey, told.link)), mounting_cells(told.mounting), p.links.size(),
                   p.masts_serving(), p.walls.size(), walls_served(p),
                   blocker_cells(survey, told.link == nullptr ? nullptr : pointer_to(told.link->blocker)));
  }
  return text;
}

std::string premises_links_csv(const PremisesSurvey& survey) {
  std::string text =
      fmt::format("theme,name,id,mast,verdict,wall_height_m,pole_m,{},{}\n", kMountingColumns, kBlockerColumns);
  for (const Premises& p : survey.premises) {
    for (const PremisesLink& link : p.links) {
      const auto height = [](const std::optional<Mounting>& m) { return m ? fmt::format("{:.10g}", m->height_m) : ""; };
      const Mounting* const told = link.wall ? &*link.wall : link.roof ? &*link.roof : pointer_to(link.tried);
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}\n", csv_cell(theme_name(survey, p)),
                     csv_cell(p.name), csv_cell(p.id), csv_cell(survey.masts[link.mast].name), word_of(link.verdict),
                     height(link.wall), height(link.roof), mounting_cells(told),
                     blocker_cells(survey, pointer_to(link.blocker)));
    }
  }
  return text;
}

std::string premises_roofs_csv(const PremisesSurvey& survey) {
  std::string text = fmt::format("theme,name,id,{},{}\n", kRoofColumns, kStreetColumns);
  for (const Premises& p : survey.premises) {
    for (const RoofPlace& place : p.roof)
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", csv_cell(theme_name(survey, p)), csv_cell(p.name),
                     csv_cell(p.id), roof_cells(survey, place), street_cells(survey, place));
  }
  return text;
}

std::vector<VectorLayer> premises_layers(const PremisesSurvey& survey) {
  return {layer_of_facades(survey), layer_of_premises(survey), layer_of_best_links(survey), layer_of_masts(survey)};
}

}  // namespace itin::viewshed
