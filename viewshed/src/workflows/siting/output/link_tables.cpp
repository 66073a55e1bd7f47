#include "workflows/siting/output/link_tables.hpp"

#include <optional>
#include <vector>

#include <itin/table_columns.hpp>
#include <profile/line_classes.hpp>
#include <viewshed/site_links.hpp>

namespace itin::viewshed {

namespace {

struct LinkRow {
  const SiteLink& link;
  const SitePosition &from, &to;
  std::size_t routes;  ///< how many lead over it
};

std::vector<LinkRow> link_rows(const SitePlan& r) {
  const std::vector<std::size_t> routes = routes_over_links(r.network, r.routes);
  std::vector<LinkRow> rows;
  for (const SiteLink& link : r.network.links)
    rows.push_back({link, r.network.from(link), r.network.to(link), routes[rows.size()]});
  return rows;
}

std::optional<double> fraction_of(const SiteLink& link) {
  return if_any(link.found().fresnel, &profile::FresnelClearance::fraction);
}

std::vector<TableColumn<LinkRow>> link_columns(const SitePlan& r) {
  const auto from = [](const LinkRow& row) { return row.from.name; };
  const auto to = [](const LinkRow& row) { return row.to.name; };
  const auto gap = [](const LinkRow& row) { return row.link.line.gap_m; };
  const auto critical = [](double profile::ProfilePoint::*coordinate) {
    return [coordinate](const LinkRow& row) { return if_any(row.link.found().critical, coordinate); };
  };
  const bool radio = r.request.frequency_ghz.has_value();
  std::vector<TableColumn<LinkRow>> columns{
      {"from", from, kInCsv | kInDocument},
      {"from_id", from, kInLayer},
      {"to", to, kInCsv | kInDocument},
      {"to_id", to, kInLayer},
      {"distance_m", [](const LinkRow& row) { return row.link.line.distance_m; }, kInAllFormats, "{:.3f}"},
      {"verdict", [](const LinkRow& row) { return name_of(row.link.found().verdict); }},
      {"gap_m", gap, kInDocument},
      {"clearance_m", [](const LinkRow& row) { return row.link.found().clearance_m; }, kInAllFormats, "{:.3f}"},
      {"critical_x", critical(&profile::ProfilePoint::x), kInCsv, "{:.3f}"},
      {"critical_y", critical(&profile::ProfilePoint::y), kInCsv, "{:.3f}"},
      {"critical_z", critical(&profile::ProfilePoint::ground_m), kInCsv, "{:.3f}"},
      {"fresnel_fraction", [](const LinkRow& row) { return fraction_of(row.link); },
       radio ? kInAllFormats : kInLayer | kInDocument, "{:.4f}"}};
  if (radio)
    columns.emplace_back(
        "clear", [rules = link_rules(r.request)](const LinkRow& row) { return rules.met_by(row.link.found()); },
        kInCsv | kInDocument);
  columns.emplace_back("gap_m", gap, kInCsv | kInLayer, "{:.3f}");
  columns.emplace_back(
      "routes",
      [hub = r.request.hub.has_value()](const LinkRow& row) { return hub ? std::optional(row.routes) : std::nullopt; },
      kInLayer);
  return columns;
}

/// A hop of a route, from the end of its link that comes first; or a route that does not reach the hub.
struct HopRow {
  const SiteRoute& route;
  const RouteHop* hop = nullptr;
  std::size_t number = 0;  ///< from 1
};

std::vector<TableColumn<HopRow>> hop_columns(const SitePlan& r) {
  const SiteNetwork& network = r.network;
  const auto end = [&network](std::size_t i) { return network.ends[i].place.name; };
  // What a row without a hop has not.
  const auto of_hop = [](auto value) {
    return [value](const HopRow& row) { return if_any(row.hop, [&](const RouteHop&) { return value(row); }); };
  };
  const auto of_link = [&network, of_hop](auto value) {
    return of_hop([&network, value](const HopRow& row) { return value(network.links[row.hop->link]); });
  };
  const auto gap = of_link([](const SiteLink& link) { return link.line.gap_m; });
  const auto worst = [&network](const HopRow& row) -> std::optional<bool> {
    const std::optional<RouteHop> hop = worst_hop(network, row.route);
    return hop && hop->link == row.hop->link ? std::optional(true) : std::nullopt;
  };
  return {
      {"site", [end](const HopRow& row) { return end(row.route.site); }, kInCsv},
      {"route", [&network](const HopRow& row) { return in_words(network, row.route); }, kInCsv},
      {"route_m", of_hop([&network](const HopRow& row) { return length_m(network, row.route); }), kInCsv, "{:.3f}"},
      {"hop", of_hop([](const HopRow& row) { return row.number; }), kInCsv},
      {"from", of_hop([end](const HopRow& row) { return end(row.hop->from); })},
      {"to", of_hop([end](const HopRow& row) { return end(row.hop->to); })},
      {"distance_m", of_link([](const SiteLink& link) { return link.line.distance_m; }), kInAllFormats, "{:.3f}"},
      {"gap_m", gap, kInDocument},
      {"clearance_m", of_link([](const SiteLink& link) { return link.found().clearance_m; }), kInAllFormats, "{:.3f}"},
      {"fresnel_fraction", of_link(fraction_of), kInAllFormats, "{:.4f}"},
      {"gap_m", gap, kInCsv, "{:.3f}"},
      {"worst", of_hop(worst), kInCsv}};
}

std::vector<HopRow> hops_of(const SiteRoute& route) {
  std::vector<HopRow> rows;
  for (const RouteHop& hop : route.hops) rows.push_back({route, &hop, rows.size() + 1});
  return rows;
}

}  // namespace

std::string links_csv(const SitePlan& r) {
  return csv_of(link_columns(r), link_rows(r));
}

std::string routes_csv(const SitePlan& r) {
  std::vector<HopRow> rows;
  for (const SiteRoute& route : r.routes) {
    if (route.hops.empty()) rows.push_back({route});
    for (const HopRow& row : hops_of(route)) rows.push_back(row);
  }
  return csv_of(hop_columns(r), rows);
}

Document links_document(const SitePlan& r) {
  return documents_of(link_columns(r), link_rows(r));
}

Document routes_document(const SitePlan& r) {
  const SiteNetwork& network = r.network;
  const auto columns = hop_columns(r);
  Document routes = Document::array();
  for (const SiteRoute& route : r.routes) {
    Document entry{{"site", network.ends[route.site].place.name},
                   {"reaches_hub", !route.hops.empty()},
                   {"hops", documents_of(columns, hops_of(route))}};
    if (!route.hops.empty()) entry["length_m"] = length_m(network, route);
    if (const auto worst = worst_hop(network, route)) entry["worst_hop"] = document_of(columns, {route, &*worst});
    routes.push_back(std::move(entry));
  }
  return routes;
}

VectorLayer links_layer(const SitePlan& r) {
  const auto line = [](const LinkRow& row) {
    const auto& [link, a, b, routes] = row;
    return std::vector<Point3>{{a.position.x, a.position.y, a.elevation()},
                               {b.position.x, b.position.y, b.elevation()}};
  };
  return layer_of("links", VectorLayer::Shape::kLines, link_columns(r), link_rows(r), line,
                  line_style("verdict", profile::kVerdictClasses, 0.6));
}

}  // namespace itin::viewshed
