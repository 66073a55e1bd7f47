#include "workflows/siting/output/link_tables.hpp"

#include <iterator>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>
#include <viewshed/site_links.hpp>

namespace itin::viewshed {

namespace {

bool is_clear(const SitePlan& r, const SiteLink& link) {
  return link_rules(r.request).met_by(link.found());
}

std::optional<double> fraction_of(const SiteLink& link) {
  return link.found().fresnel ? std::optional(link.found().fresnel->fraction) : std::nullopt;
}

void add_clearance_of(const SiteLink& link, Document& entry) {
  if (link.found().clearance_m) entry["clearance_m"] = *link.found().clearance_m;
  if (const auto fraction = fraction_of(link)) entry["fresnel_fraction"] = *fraction;
}

/// Returns a hop, from the end of its link that comes first on the route.
Document hop_document(const SiteNetwork& network, const RouteHop& hop) {
  const SiteLink& link = network.links[hop.link];
  Document entry{{"from", network.ends[hop.from].place.name},
                 {"to", network.ends[hop.to].place.name},
                 {"distance_m", link.line.distance_m},
                 {"gap_m", link.line.gap_m}};
  add_clearance_of(link, entry);
  return entry;
}

}  // namespace

std::string links_csv(const SitePlan& r) {
  std::string text = "from,to,distance_m,verdict,clearance_m,critical_x,critical_y,critical_z";
  text += r.request.frequency_ghz ? ",fresnel_fraction,clear,gap_m\n" : ",gap_m\n";
  const auto out = std::back_inserter(text);
  for (const SiteLink& link : r.network.links) {
    const profile::LineFindings& found = link.found();
    fmt::format_to(out, "{},{},{:.3f},{}", csv_cell(r.network.from(link).name), csv_cell(r.network.to(link).name),
                   link.line.distance_m, name_of(found.verdict));
    if (found.critical) {
      fmt::format_to(out, ",{:.3f},{:.3f},{:.3f},{:.3f}", *found.clearance_m, found.critical->x, found.critical->y,
                     found.critical->ground_m);
    } else {
      text += ",,,,";
    }
    if (r.request.frequency_ghz)
      fmt::format_to(out, ",{},{}", csv_cell(fraction_of(link), 4), is_clear(r, link) ? "yes" : "no");
    fmt::format_to(out, ",{:.3f}\n", link.line.gap_m);
  }
  return text;
}

std::string routes_csv(const SitePlan& r) {
  const SiteNetwork& network = r.network;
  std::string text = "site,route,route_m,hop,from,to,distance_m,clearance_m,fresnel_fraction,gap_m,worst\n";
  const auto out = std::back_inserter(text);
  for (const SiteRoute& route : r.routes) {
    const std::string site = csv_cell(network.ends[route.site].place.name), words = csv_cell(in_words(network, route));
    if (route.hops.empty()) fmt::format_to(out, "{},{},,,,,,,,,\n", site, words);
    const std::optional<RouteHop> worst = worst_hop(network, route);
    for (std::size_t i = 0; i < route.hops.size(); ++i) {
      const RouteHop& hop = route.hops[i];
      const SiteLink& link = network.links[hop.link];
      fmt::format_to(out, "{},{},{:.3f},{},{},{},{:.3f},{},{},{:.3f},{}\n", site, words, length_m(network, route),
                     i + 1, csv_cell(network.ends[hop.from].place.name), csv_cell(network.ends[hop.to].place.name),
                     link.line.distance_m, csv_cell(link.found().clearance_m, 3), csv_cell(fraction_of(link), 4),
                     link.line.gap_m, worst && worst->link == hop.link ? "yes" : "");
    }
  }
  return text;
}

Document links_document(const SitePlan& r) {
  Document links = Document::array();
  for (const SiteLink& link : r.network.links) {
    Document entry{{"from", r.network.from(link).name},
                   {"to", r.network.to(link).name},
                   {"distance_m", link.line.distance_m},
                   {"verdict", name_of(link.found().verdict)},
                   {"gap_m", link.line.gap_m}};
    add_clearance_of(link, entry);
    if (r.request.frequency_ghz) entry["clear"] = is_clear(r, link);
    links.push_back(std::move(entry));
  }
  return links;
}

Document routes_document(const SitePlan& r) {
  const SiteNetwork& network = r.network;
  Document routes = Document::array();
  for (const SiteRoute& route : r.routes) {
    Document entry{{"site", network.ends[route.site].place.name},
                   {"reaches_hub", !route.hops.empty()},
                   {"hops", Document::array()}};
    for (const RouteHop& hop : route.hops) entry["hops"].push_back(hop_document(network, hop));
    if (!route.hops.empty()) entry["length_m"] = length_m(network, route);
    if (const auto worst = worst_hop(network, route)) entry["worst_hop"] = hop_document(network, *worst);
    routes.push_back(std::move(entry));
  }
  return routes;
}

VectorLayer links_layer(const SitePlan& r) {
  using Type = VectorLayer::Type;
  VectorLayer layer{"links",
                    VectorLayer::Shape::kLines,
                    {{"from_id", Type::kText},
                     {"to_id", Type::kText},
                     {"distance_m", Type::kNumber},
                     {"verdict", Type::kText},
                     {"clearance_m", Type::kNumber},
                     {"fresnel_fraction", Type::kNumber},
                     {"gap_m", Type::kNumber},
                     {"routes", Type::kWhole}},
                    {}};
  const std::vector<std::size_t> routes = routes_over_links(r.network, r.routes);
  for (std::size_t i = 0; i < r.network.links.size(); ++i) {
    const SiteLink& link = r.network.links[i];
    const SitePosition &a = r.network.from(link), &b = r.network.to(link);
    VectorLayer::Value clearance, fraction, over;
    if (link.found().clearance_m) clearance = *link.found().clearance_m;
    if (const auto known = fraction_of(link)) fraction = *known;
    if (r.request.hub) over = static_cast<std::int64_t>(routes[i]);
    layer.features.push_back(
        {{{a.position.x, a.position.y, a.elevation()}, {b.position.x, b.position.y, b.elevation()}},
         {a.name, b.name, link.line.distance_m, std::string(name_of(link.found().verdict)), clearance, fraction,
          link.line.gap_m, over}});
  }
  return layer;
}

}  // namespace itin::viewshed
