#include "workflows/siting/output/site_map_objects.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/contour_lines.hpp>
#include <itin/parallel.hpp>
#include <viewshed/site_links.hpp>
#include <viewshed/site_wording.hpp>
#include <viewshed/turbine_layout.hpp>

#include "workflows/siting/output/point_tables.hpp"

namespace itin::viewshed {

namespace {

using profile::SheetKey;
using profile::SheetSymbol;
using Sample = SheetKey::Sample;

constexpr Rgba kSearchArea{20, 90, 160, 255}, kForbidden{190, 30, 30, 255}, kSetback{200, 110, 0, 255};
constexpr Rgba kBackhaul{160, 55, 0, 255}, kExistingSite{110, 50, 130, 255}, kHubMark{25, 25, 25, 255};

MapObjects dashed_lines(std::vector<std::vector<Point2>> outlines, const Rgba& colour, std::string what) {
  profile::SheetLines lines{{}, colour, 0.4, true};
  for (std::vector<Point2>& outline : outlines) lines.lines.push_back({std::move(outline), ""});
  return {{std::move(lines)}, {{Sample::kDashes, {colour}, std::move(what)}}};
}

/// Returns the outlines of an area; none where there is none.
std::vector<std::vector<Point2>> outlines_of(const std::optional<Window>& area) {
  std::vector<std::vector<Point2>> outlines;
  const auto add = [&](Window::Ring ring) {
    ring.push_back(ring.front());
    outlines.push_back(std::move(ring));
  };
  if (!area) return outlines;
  for (const Window::Polygon& part : area->parts()) {
    add(part.outer);
    for (const Window::Ring& hole : part.holes) add(hole);
  }
  return outlines;
}

/// Returns the outlines of the ground on which no turbine stands because dwellings are near, as fine as maps show them.
std::vector<std::vector<Point2>> outlines_of_setback(const SitePlan& r) {
  constexpr double kAcross = 400;
  if (!r.request.turbines || !r.request.turbines->dwellings) return {};
  const SiteDwellings& given = *r.request.turbines->dwellings;
  const Dwellings dwellings(given.points, given.polygons);
  const Box area = shown_area(r);
  const RasterGrid grid = RasterGrid::aligned(area, std::max(area.width(), area.height()) / kAcross);
  std::vector<float> metres(grid.cell_count());
  parallel_for(static_cast<std::size_t>(grid.rows()), [&](std::size_t row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      const RasterGrid::Cell cell{column, static_cast<std::int64_t>(row)};
      const Point2 centre = grid.centre(cell.column, cell.row);
      metres[grid.index(cell)] = static_cast<float>(dwellings.metres_to(centre, given.setback + 4 * grid.cell_width()));
    }
  });
  return contour_lines(grid, metres, given.setback);
}

MapObjects setback_objects(const SitePlan& r) {
  const auto& turbines = r.request.turbines;
  const double setback = turbines && turbines->dwellings ? turbines->dwellings->setback : 0;
  return dashed_lines(outlines_of_setback(r), kSetback, fmt::format("{:g} m from dwellings", setback));
}

MapObjects link_objects(const SitePlan& r) {
  const SiteNetwork& network = r.network;
  const LinkRules rules = link_rules(r.request);
  const std::vector<std::size_t> routes = routes_over_links(network, r.routes);
  profile::SheetLines lines{{}, kBackhaul, 0.6, false};
  for (std::size_t i = 0; i < network.links.size() && r.request.has_links(); ++i) {
    const SiteLink& link = network.links[i];
    if (r.request.hub ? routes[i] > 0 : rules.met_by(link.found()))
      lines.lines.push_back({{network.from(link).position, network.to(link).position}, ""});
  }
  const char* const what = r.request.hub ? "Link on a route to the hub" : "Link between sites";
  return {{std::move(lines)}, {{Sample::kLine, {kBackhaul}, what}}};
}

/// Returns the name that an end's mark has on maps. A hub has the names of the sites at its place, too, whose own marks
/// it covers.
std::string label_of(const SiteNetwork& network, std::size_t end) {
  const auto is_hub = [&](std::size_t i) { return network.ends[i].kind == LinkEnd::Kind::kHub; };
  std::string sites;
  for (std::size_t i = 0; i < network.ends.size(); ++i) {
    if (is_hub(i) == is_hub(end) || network.ends[i].place.position != network.ends[end].place.position) continue;
    if (!is_hub(end)) return "";
    sites += network.ends[i].place.name + ", ";
  }
  return sites + network.ends[end].place.name;
}

/// Returns marks for the ends of a network that `is_one` accepts.
template <class IsOne>
MapObjects marks_of_sites(const SiteNetwork& network, SheetSymbol symbol, const Rgba& colour, const std::string& what,
                          const IsOne& is_one) {
  profile::SheetMarks marks{symbol, colour, {}};
  for (std::size_t i = 0; i < network.ends.size(); ++i)
    if (is_one(i)) marks.marks.push_back({network.ends[i].place.position, label_of(network, i)});
  return {{std::move(marks)}, {{Sample::kMark, {colour}, what, symbol}}};
}

/// Returns the box about the part of the search area that has ground, where all candidates are.
Box searched_box(const SitePlan& r) {
  Box candidates;
  for (const SiteCandidate& candidate : r.inputs.candidates) candidates.extend(candidate.place.position);
  const double about = r.request.spacing;
  candidates = {candidates.xmin - about, candidates.ymin - about, candidates.xmax + about, candidates.ymax + about};
  return intersection(candidates, r.request.search_area->bounds());
}

bool has_no_object(const MapObjects& objects) {
  if (objects.layers.empty()) return true;
  const profile::SheetLayer& layer = objects.layers.front();
  if (const auto* lines = std::get_if<profile::SheetLines>(&layer)) return lines->lines.empty();
  return std::get<profile::SheetMarks>(layer).marks.empty();
}

}  // namespace

Box shown_area(const SitePlan& r) {
  Box area = r.rasters.grid.bounds();
  const double about = 0.03 * std::max(area.width(), area.height());
  for (const LinkEnd& end : r.network.ends) {
    const Point2 p = end.place.position;
    area.extend(Point2{p.x - about, p.y - about});
    area.extend(Point2{p.x + about, p.y + about});
  }
  if (r.request.search_area) {
    const Box searched = searched_box(r);
    area.extend(Box{searched.xmin - about, searched.ymin - about, searched.xmax + about, searched.ymax + about});
  }
  return area;
}

std::vector<MapObjects> site_map_objects(const Store& store, const SitePlan& r) {
  using enum LinkEnd::Kind;
  const SiteNetwork& network = r.network;
  const SiteWording wording = wording_of(r.request);
  const std::vector<std::size_t> through = routes_through_ends(network, r.routes);
  const auto is = [&](std::size_t i, LinkEnd::Kind kind) { return network.ends[i].kind == kind; };
  std::vector<MapObjects> objects{
      building_objects(store, r.request.themes, shown_area(r)),
      dashed_lines(outlines_of(r.request.search_area), kSearchArea, "Search area"),
      dashed_lines(outlines_of(r.request.forbidden), kForbidden, "No " + wording.one + " here"), setback_objects(r),
      link_objects(r)};
  for (MapObjects& points : objects_of_points(r)) objects.push_back(std::move(points));
  const auto add = [&](SheetSymbol symbol, const Rgba& colour, const std::string& what, const auto& is_one) {
    objects.push_back(marks_of_sites(network, symbol, colour, what, is_one));
  };
  const bool wind = r.request.turbines.has_value();
  add(wind ? SheetSymbol::kTurbine : SheetSymbol::kExistingMast, kExistingSite, "Existing " + wording.one,
      [&](std::size_t i) { return is(i, kExisting); });
  add(wind ? SheetSymbol::kTurbine : SheetSymbol::kMast, kMastColour, "Chosen " + wording.one,
      [&](std::size_t i) { return is(i, kChosen) && through[i] == 0; });
  add(SheetSymbol::kRelay, kMastColour, "Chosen site that relays others",
      [&](std::size_t i) { return is(i, kChosen) && through[i] > 0; });
  add(SheetSymbol::kHub, kHubMark, "Hub", [&](std::size_t i) { return is(i, kHub); });
  std::erase_if(objects, has_no_object);
  return objects;
}

}  // namespace itin::viewshed
