#include "workflows/siting/output/point_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include <itin/feature_style.hpp>
#include <itin/table_columns.hpp>
#include <viewshed/site_wording.hpp>

namespace itin::viewshed {

namespace {

/// The classes of PointService, in its order.
constexpr std::array<FeatureClass, 8> kPointServices{{{"served", "Point served", {0, 114, 178}},
                                                      {"too few", "Point served by too few sites", {86, 180, 233}},
                                                      {"undecided", "Point undecided", {140, 140, 140}},
                                                      {"zone cut", "Point in sight, Fresnel zone cut", {230, 159, 0}},
                                                      {"too weak", "Point whose level is too low", {204, 121, 167}},
                                                      {"hidden", "Point hidden from all sites", {150, 30, 30}},
                                                      {"out of reach", "Point beyond the radius", {205, 205, 205}},
                                                      {"no ground", "Point without ground data", {40, 40, 40}}}};

bool has_sectors(const SitePlan& r) {
  return std::any_of(r.inputs.positions.begin(), r.inputs.positions.end(),
                     [](const SitePosition& site) { return !site.sectors.empty(); });
}

using PointColumns = std::vector<TableColumn<PointResult>>;

PointColumns point_columns(const SitePlan& r) {
  PointColumns columns{
      {"id", [](const PointResult& p) { return p.point.name; }},
      {"x", [](const PointResult& p) { return p.place.position.x; }, kInCsv, "{:.3f}"},
      {"y", [](const PointResult& p) { return p.place.position.y; }, kInCsv, "{:.3f}"},
      {"height_m", [](const PointResult& p) { return p.place.height; }},
      {"weight", [](const PointResult& p) { return p.point.weight; }},
      {"service", [](const PointResult& p) { return name_of(p.service); }},
      {"site", [&r](const PointResult& p) { return p.line ? r.network.ends[p.line->site].place.name : ""; }},
      {"sites_serving", &PointResult::serving}};
  const auto add_of_line = [&](const char* name, auto member, const char* number = "{:.3f}") {
    columns.emplace_back(
        name, [member](const PointResult& p) { return if_any(p.line, member); }, kInAllFormats, number);
  };
  add_of_line("distance_m", &ServingLine::distance_m);
  add_of_line("tightest_clearance_m", &ServingLine::tightest_clearance_m);
  add_of_line("fresnel_fraction", &ServingLine::fresnel_fraction, "{:.4f}");
  if (r.request.by_level()) {
    add_of_line("level_dbm", &ServingLine::level_dbm, "{:.2f}");
    add_of_line("margin_db", &ServingLine::margin_db, "{:.2f}");
  }
  if (r.request.link_budget.rain_rate_mm_h) {
    add_of_line("rain_exceeded_0_01_db", &ServingLine::rain_exceeded_db, "{:.2f}");
    const auto add_of_year = [&](const char* name, auto member, const char* number) {
      columns.emplace_back(
          name, [member](const PointResult& p) { return p.line ? if_any(p.line->availability, member) : std::nullopt; },
          kInAllFormats, number);
    };
    add_of_year("availability_percent", &profile::Availability::percent, "{:.4f}");
    add_of_year("outage_minutes", &profile::Availability::outage_minutes, "{:.2f}");
  }
  if (has_sectors(r)) columns.emplace_back("sector", [](const PointResult& p) { return p.line ? p.line->sector : ""; });
  add_of_line("tightest_m", &ServingLine::tightest_m);
  return columns;
}

}  // namespace

const char* name_of(PointService service) {
  return kPointServices[static_cast<std::size_t>(service)].name;
}

std::string points_csv(const SitePlan& r) {
  return csv_of(point_columns(r), r.points);
}

VectorLayer points_layer(const SitePlan& r) {
  const auto place = [](const PointResult& p) {
    return std::vector<Point3>{{p.place.position.x, p.place.position.y, p.place.ground}};
  };
  return layer_of("demand", VectorLayer::Shape::kPoints, point_columns(r), r.points, place,
                  point_style("service", kPointServices));
}

Document points_document(const SitePlan& r) {
  std::array<std::size_t, kPointServices.size()> counts{};
  for (const PointResult& p : r.points) ++counts[static_cast<std::size_t>(p.service)];
  Document document = Document::object();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    std::string name = kPointServices[i].name;
    std::replace(name.begin(), name.end(), ' ', '_');
    document[name] = counts[i];
  }
  return document;
}

std::vector<MapObjects> objects_of_points(const SitePlan& r) {
  constexpr double kDotsAcross = 200;  // dots along the map's longer side
  const Box box = r.rasters.grid.bounds();
  const double side = std::max(box.width(), box.height()) / kDotsAcross;
  std::array<std::vector<profile::SheetMark>, kPointServices.size()> dots;
  std::set<std::tuple<std::int64_t, std::int64_t, PointService>> taken;
  for (const PointResult& p : r.points) {
    const Point2 at = p.place.position;
    if (!taken.emplace(std::llround(at.x / side), std::llround(at.y / side), p.service).second) continue;
    dots[static_cast<std::size_t>(p.service)].push_back({at, ""});
  }
  constexpr auto kDot = profile::SheetSymbol::kDot;
  std::vector<MapObjects> all;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const FeatureClass& service = kPointServices[i];
    if (dots[i].empty()) continue;
    all.push_back({{profile::SheetMarks{kDot, service.colour, std::move(dots[i])}},
                   {{profile::SheetKey::Sample::kMark, {service.colour}, service.text, kDot}}});
  }
  return all;
}

}  // namespace itin::viewshed
