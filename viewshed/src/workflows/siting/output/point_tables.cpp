#include "workflows/siting/output/point_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_wording.hpp>

#include "files/vector_styles.hpp"

namespace itin::viewshed {

namespace {

/// The classes of PointService, in its order.
constexpr std::array<ServiceClass, 7> kPointServices{{{"served", "Point served", {0, 114, 178}},
                                                      {"too few", "Point served by too few sites", {86, 180, 233}},
                                                      {"undecided", "Point undecided", {140, 140, 140}},
                                                      {"zone cut", "Point in sight, Fresnel zone cut", {230, 159, 0}},
                                                      {"hidden", "Point hidden from all sites", {150, 30, 30}},
                                                      {"out of reach", "Point beyond the radius", {205, 205, 205}},
                                                      {"no ground", "Point without ground data", {40, 40, 40}}}};

std::string site_of(const SitePlan& r, const PointResult& result) {
  return result.line ? r.network.ends[result.line->site].place.name : "";
}

VectorLayer::Value number_or_nothing(const std::optional<double>& number) {
  return number ? VectorLayer::Value(*number) : VectorLayer::Value();
}

}  // namespace

const char* name_of(PointService service) {
  return kPointServices[static_cast<std::size_t>(service)].name;
}

std::string points_csv(const SitePlan& r) {
  std::string text =
      "id,x,y,height_m,weight,service,site,sites_serving,distance_m,tightest_clearance_m,fresnel_fraction,tightest_m\n";
  for (const PointResult& p : r.points) {
    fmt::format_to(std::back_inserter(text), "{},{:.3f},{:.3f},{},{},{},{},{}", csv_cell(p.point.name),
                   p.place.position.x, p.place.position.y, p.place.height, p.point.weight, name_of(p.service),
                   csv_cell(site_of(r, p)), p.serving);
    if (p.line) {
      fmt::format_to(std::back_inserter(text), ",{:.3f},{},{},{}\n", p.line->distance_m,
                     csv_cell(p.line->tightest_clearance_m, 3), csv_cell(p.line->fresnel_fraction, 4),
                     csv_cell(p.line->tightest_m, 3));
    } else {
      text += ",,,,\n";
    }
  }
  return text;
}

VectorLayer points_layer(const SitePlan& r) {
  using Type = VectorLayer::Type;
  VectorLayer layer{"demand",
                    VectorLayer::Shape::kPoints,
                    {{"id", Type::kText},
                     {"height_m", Type::kNumber},
                     {"weight", Type::kNumber},
                     {"service", Type::kText},
                     {"site", Type::kText},
                     {"sites_serving", Type::kWhole},
                     {"distance_m", Type::kNumber},
                     {"tightest_clearance_m", Type::kNumber},
                     {"fresnel_fraction", Type::kNumber},
                     {"tightest_m", Type::kNumber}},
                    {},
                    point_style("service", kPointServices)};
  for (const PointResult& p : r.points) {
    const Point2 at = p.place.position;
    const ServingLine none, &line = p.line ? *p.line : none;
    layer.features.push_back(
        {{{at.x, at.y, p.place.ground}},
         {p.point.name, p.place.height, p.point.weight, std::string(name_of(p.service)), site_of(r, p),
          static_cast<std::int64_t>(p.serving), p.line ? VectorLayer::Value(line.distance_m) : VectorLayer::Value(),
          number_or_nothing(line.tightest_clearance_m), number_or_nothing(line.fresnel_fraction),
          number_or_nothing(line.tightest_m)}});
  }
  return layer;
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

std::vector<MapDots> dots_of_points(const SitePlan& r) {
  constexpr double kDotsAcross = 200;  // dots along the map's longer side
  const Box box = r.rasters.grid.bounds();
  const double side = std::max(box.width(), box.height()) / kDotsAcross;
  std::array<MapDots, kPointServices.size()> dots;
  std::set<std::tuple<std::int64_t, std::int64_t, PointService>> taken;
  for (const PointResult& p : r.points) {
    const Point2 at = p.place.position;
    if (!taken.emplace(std::llround(at.x / side), std::llround(at.y / side), p.service).second) continue;
    dots[static_cast<std::size_t>(p.service)].places.push_back(at);
  }
  std::vector<MapDots> all;
  for (std::size_t i = 0; i < dots.size(); ++i)
    if (!dots[i].places.empty())
      all.push_back({kPointServices[i].text, kPointServices[i].colour, std::move(dots[i].places)});
  return all;
}

}  // namespace itin::viewshed
