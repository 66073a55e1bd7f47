#include "features/plan/plan_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <geos_c.h>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <itin/sort_unique.hpp>

#include "base/stoppable.hpp"
#include "features/plan/odd_faces.hpp"
#include "features/plan/planarity.hpp"

namespace itin {

namespace {

constexpr double kGridSize = 1;
constexpr double kMitreLimit = 5;

bool asked_to_stop() {
  const Progress* const progress = stopper();
  return progress != nullptr && progress->cancelled();
}

/// Interrupts GEOS if that was asked for. GEOS calls it from within its loops.
void interrupt_if_asked() {
  if (asked_to_stop()) GEOS_interruptRequest();
}

/// GEOS's handle, which keeps its state; there is one per thread.
class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {
    GEOSContext_setErrorMessageHandler_r(
        handle_, [](const char* message, void* text) { *static_cast<std::string*>(text) = message; }, &error_);
    GEOSContext_setNoticeMessageHandler_r(
        handle_, [](const char*, void*) {}, nullptr);
    GEOS_interruptRegisterCallback(interrupt_if_asked);
  }
  ~Geos() { GEOS_finish_r(handle_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  operator GEOSContextHandle_t() const { return handle_; }
  const std::string& error() const { return error_; }

 private:
  GEOSContextHandle_t handle_;
  std::string error_;
};

const Geos& geos() {
  thread_local const Geos geos;
  return geos;
}

struct Destroy {
  void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(geos(), g); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

[[noreturn]] void fail() {
  // A request may also reach the overlay of another thread that is about to look for one.
  const bool interrupted = geos().error().starts_with("InterruptedException");
  if (interrupted || asked_to_stop()) throw Cancelled();
  throw OverlayError("polygon overlay: " + geos().error());
}

Geometry checked(GEOSGeometry* g) {
  Geometry geometry(g);
  if (!g) fail();
  stop_if_asked();
  return geometry;
}

GEOSCoordSequence* sequence(const GridRing& ring, bool close) {
  const std::size_t count = ring.size() + (close ? 1 : 0);
  GEOSCoordSequence* s = GEOSCoordSeq_create_r(geos(), static_cast<unsigned>(count), 2);
  for (std::size_t i = 0; i < count; ++i) {
    const Position& p = ring[i % ring.size()];
    GEOSCoordSeq_setXY_r(geos(), s, static_cast<unsigned>(i), p.x, p.y);
  }
  return s;
}

Geometry to_geos(const GridPolygon& polygon) {
  const auto ring = [](const GridRing& r) { return GEOSGeom_createLinearRing_r(geos(), sequence(r, true)); };
  std::vector<GEOSGeometry*> holes;
  for (const GridRing& hole : polygon.holes) holes.push_back(ring(hole));
  return checked(
      GEOSGeom_createPolygon_r(geos(), ring(polygon.outline), holes.data(), static_cast<unsigned>(holes.size())));
}

Geometry collection(int type, std::vector<Geometry> parts) {
  std::vector<GEOSGeometry*> raw;
  for (Geometry& part : parts) raw.push_back(part.release());
  return checked(GEOSGeom_createCollection_r(geos(), type, raw.data(), static_cast<unsigned>(raw.size())));
}

Geometry to_geos(const GridPolygons& polygons) {
  std::vector<Geometry> parts;
  parts.reserve(polygons.size());
  for (const GridPolygon& polygon : polygons) parts.push_back(to_geos(polygon));
  if (parts.size() == 1) return std::move(parts.front());
  return collection(GEOS_MULTIPOLYGON, std::move(parts));
}

std::int64_t doubled_area(const GridRing& ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += doubled_area(ring[0], ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

GridRing ring_from(const GEOSGeometry* g, bool counterclockwise) {
  const GEOSCoordSequence* s = GEOSGeom_getCoordSeq_r(geos(), g);
  unsigned count = 0;
  GEOSCoordSeq_getSize_r(geos(), s, &count);
  GridRing ring;
  for (unsigned i = 0; i + 1 < count; ++i) {
    double x = 0, y = 0;
    GEOSCoordSeq_getXY_r(geos(), s, i, &x, &y);
    const Position p{static_cast<std::int32_t>(std::llround(x)), static_cast<std::int32_t>(std::llround(y))};
    if (ring.empty() || ring.back() != p) ring.push_back(p);
  }
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  const std::int64_t area = doubled_area(ring);
  if (area == 0) return {};
  if ((area > 0) != counterclockwise) std::reverse(ring.begin(), ring.end());
  return ring;
}

void add_polygons(const GEOSGeometry* g, GridPolygons& out) {
  const int type = GEOSGeomTypeId_r(geos(), g);
  if (type == GEOS_POLYGON) {
    if (GEOSisEmpty_r(geos(), g)) return;
    GridPolygon polygon{ring_from(GEOSGetExteriorRing_r(geos(), g), true), {}};
    if (polygon.outline.empty()) return;
    for (int i = 0; i < GEOSGetNumInteriorRings_r(geos(), g); ++i) {
      GridRing hole = ring_from(GEOSGetInteriorRingN_r(geos(), g, i), false);
      if (!hole.empty()) polygon.holes.push_back(std::move(hole));
    }
    out.push_back(std::move(polygon));
  } else if (type >= GEOS_MULTIPOINT) {
    // Lines and points have no area and are passed over.
    for (int i = 0; i < GEOSGetNumGeometries_r(geos(), g); ++i) add_polygons(GEOSGetGeometryN_r(geos(), g, i), out);
  }
}

GridPolygons from_geos(const Geometry& g) {
  GridPolygons polygons;
  add_polygons(g.get(), polygons);
  return polygons;
}

/// Leaves out what has become lines on the grid beside polygons, which GEOS does not take again.
Geometry polygonal(Geometry g) {
  return GEOSGeomTypeId_r(geos(), g.get()) == GEOS_GEOMETRYCOLLECTION ? to_geos(from_geos(g)) : std::move(g);
}

Geometry on_grid(const Geometry& g) {
  return checked(GEOSGeom_setPrecision_r(geos(), g.get(), kGridSize, 0));
}

Geometry buffered(const Geometry& g, double distance, int cap) {
  GEOSBufferParams* parameters = GEOSBufferParams_create_r(geos());
  GEOSBufferParams_setJoinStyle_r(geos(), parameters, GEOSBUF_JOIN_MITRE);
  GEOSBufferParams_setMitreLimit_r(geos(), parameters, kMitreLimit);
  GEOSBufferParams_setEndCapStyle_r(geos(), parameters, cap);
  GEOSGeometry* result = GEOSBufferWithParams_r(geos(), g.get(), parameters, distance);
  GEOSBufferParams_destroy_r(geos(), parameters);
  return on_grid(checked(result));
}

}  // namespace

double area(const GridPolygon& polygon) {
  std::int64_t sum = 0;
  for_each_ring(polygon, [&](const GridRing& ring) { sum += doubled_area(ring); });
  return static_cast<double>(sum) / 2;
}

double area(const GridPolygons& polygons) {
  double sum = 0;
  for (const GridPolygon& polygon : polygons) sum += area(polygon);
  return sum;
}

Side side_of(const GridPolygon& polygon, Position p) {
  bool inside = false, border = false;
  for_each_edge(polygon, [&](Position a, Position b) {
    if (b < a) std::swap(a, b);
    const int side = orientation(a, b, p);
    border |= side == 0 && p >= a && p <= b;  // collinear: the order by x, then y, is that along the line
    if ((a.y > p.y) != (b.y > p.y)) inside ^= (b.y > a.y) == (side > 0);
  });
  return border ? Side::border : inside ? Side::inside : Side::outside;
}

bool covers(const GridPolygons& polygons, Point2 p) {
  bool inside = false;
  for (const GridPolygon& polygon : polygons) {
    for_each_edge(polygon, [&](Position a, Position b) {
      if ((a.y > p.y) == (b.y > p.y)) return;
      if (p.x < a.x + (p.y - a.y) / (double{1} * b.y - a.y) * (double{1} * b.x - a.x)) inside = !inside;
    });
  }
  return inside;
}

namespace {

/// The rings without repeated positions, and without rings that can enclose no area.
std::vector<GridRing> bare_rings(const std::vector<GridRing>& rings) {
  std::vector<GridRing> result;
  for (GridRing ring : rings) {
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    if (ring.size() >= 3) result.push_back(std::move(ring));
  }
  return result;
}

std::vector<GridEdge> edges_of_rings(const std::vector<GridRing>& rings) {
  std::vector<GridEdge> edges;
  for (const GridRing& ring : rings)
    for_each_edge(GridPolygon{ring, {}}, [&](Position a, Position b) { edges.emplace_back(a, b); });
  return edges;
}

void require_few_crossings(const std::vector<GridEdge>& edges) {
  const std::uint64_t most = most_conflicts(edges.size()), found = count_conflicts(edges, kCountedConflicts);
  if (found <= most) return;
  throw OverlayError(fmt::format(
      "crosses itself {}{} times, and more than {} crossings of {} edges are not taken apart",
      found > kCountedConflicts ? "more than " : "", std::min(found, kCountedConflicts), most, edges.size()));
}

bool valid(const Geometry& g) {
  const char answer = GEOSisValid_r(geos(), g.get());
  if (answer == 2) fail();
  return answer == 1;
}

}  // namespace

EvenOdd even_odd(const std::vector<GridRing>& rings) {
  const std::vector<GridRing> bare = bare_rings(rings);
  require_few_crossings(edges_of_rings(bare));
  std::vector<Geometry> shells;
  EvenOdd result;
  for (const GridRing& ring : bare) {
    shells.push_back(to_geos(GridPolygon{ring, {}}));
    if (valid(shells.back())) continue;
    shells.back() = to_geos(odd_faces(ring));
    result.repaired = true;
  }
  // The areas are combined by parity: what two rings both enclose is outside. They are combined in pairs, which suits
  // many rings.
  for (std::size_t step = 1; step < shells.size(); step *= 2) {
    for (std::size_t i = 0; i + step < shells.size(); i += 2 * step)
      shells[i] =
          polygonal(checked(GEOSSymDifferencePrec_r(geos(), shells[i].get(), shells[i + step].get(), kGridSize)));
  }
  if (!shells.empty()) result.polygons = from_geos(on_grid(shells.front()));
  return result;
}

namespace {

/// The union of two areas. What has become a line on the grid is left out, which GEOS would not take again.
GridPolygons joined(const GridPolygons& a, const GridPolygons& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return from_geos(checked(GEOSUnionPrec_r(geos(), to_geos(a).get(), to_geos(b).get(), kGridSize)));
}

}  // namespace

EvenOdd union_of(std::vector<std::vector<GridRing>> parts) {
  sort_unique(parts);
  std::vector<GridRing> all;
  for (const std::vector<GridRing>& part : parts) all.insert(all.end(), part.begin(), part.end());
  require_few_crossings(edges_of_rings(bare_rings(all)));
  EvenOdd result;
  std::vector<GridPolygons> areas;
  for (const std::vector<GridRing>& part : parts) {
    EvenOdd own = even_odd(part);
    result.repaired |= own.repaired;
    areas.push_back(std::move(own.polygons));
  }
  // In pairs, which suits many parts.
  for (std::size_t step = 1; step < areas.size(); step *= 2)
    for (std::size_t i = 0; i + step < areas.size(); i += 2 * step) areas[i] = joined(areas[i], areas[i + step]);
  if (!areas.empty()) result.polygons = std::move(areas.front());
  return result;
}

std::vector<PlanFace> faces_of(const std::vector<GridEdge>& edges) {
  std::vector<Geometry> lines;
  lines.reserve(edges.size());
  for (const GridEdge& e : edges)
    lines.push_back(checked(GEOSGeom_createLineString_r(geos(), sequence({e.first, e.second}, false))));
  std::vector<const GEOSGeometry*> raw;
  for (const Geometry& line : lines) raw.push_back(line.get());
  const Geometry faces = checked(GEOSPolygonize_r(geos(), raw.data(), static_cast<unsigned>(raw.size())));
  std::vector<PlanFace> result;
  for (int i = 0; i < GEOSGetNumGeometries_r(geos(), faces.get()); ++i) {
    const GEOSGeometry* face = GEOSGetGeometryN_r(geos(), faces.get(), i);
    GridPolygons polygons;
    add_polygons(face, polygons);
    if (polygons.empty()) continue;
    const Geometry inside = checked(GEOSPointOnSurface_r(geos(), face));
    PlanFace f{std::move(polygons.front()), {}};
    GEOSGeomGetX_r(geos(), inside.get(), &f.inside.x);
    GEOSGeomGetY_r(geos(), inside.get(), &f.inside.y);
    result.push_back(std::move(f));
  }
  return result;
}

GridPolygons united(const GridPolygons& faces) {
  if (faces.size() < 2) return faces;
  // Edges between two faces go. Every face to the left of a remaining edge is inside. Nothing may be snapped again:
  // edges that pass a vertex closely would move.
  std::set<GridEdge> border;
  for (const GridPolygon& face : faces) {
    for_each_edge(face, [&](Position from, Position to) {
      if (border.erase({to, from}) == 0) border.insert({from, to});
    });
  }
  GridPolygons result;
  for (PlanFace& face : faces_of({border.begin(), border.end()})) {
    const GridRing& outline = face.polygon.outline;
    if (border.contains({outline[0], outline[1]})) result.push_back(std::move(face.polygon));
  }
  return result;
}

GridPolygons merged(const GridPolygons& polygons) {
  return from_geos(checked(GEOSUnaryUnionPrec_r(geos(), to_geos(polygons).get(), kGridSize)));
}

GridPolygons eroded(const GridPolygons& polygons, double distance) {
  if (polygons.empty()) return {};
  return from_geos(buffered(to_geos(polygons), -distance, GEOSBUF_CAP_FLAT));
}

GridPolygons common_part(const GridPolygons& a, const GridPolygons& b) {
  if (a.empty() || b.empty()) return {};
  return from_geos(checked(GEOSIntersectionPrec_r(geos(), to_geos(a).get(), to_geos(b).get(), kGridSize)));
}

GridPolygons thickened(const std::vector<Position>& line, double thickness) {
  GridRing bare = line;
  bare.erase(std::unique(bare.begin(), bare.end()), bare.end());
  if (bare.size() < 2) return {};
  std::vector<GridEdge> edges;
  for (std::size_t i = 1; i < bare.size(); ++i) edges.emplace_back(bare[i - 1], bare[i]);
  require_few_crossings(edges);
  const Geometry g = checked(GEOSGeom_createLineString_r(geos(), sequence(bare, false)));
  return from_geos(buffered(g, thickness / 2, GEOSBUF_CAP_FLAT));
}

Rectangle enclosing_rectangle(const GridRing& ring) {
  // A smallest rectangle has a side on an edge of the convex hull; trying every edge of the ring finds it too.
  Rectangle best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Position a = ring[i], b = ring[(i + 1) % ring.size()];
    const double length = std::hypot(double{1} * b.x - a.x, double{1} * b.y - a.y);
    const Point2 u{(double{1} * b.x - a.x) / length, (double{1} * b.y - a.y) / length};
    Box box;
    for (const Position& p : ring) {
      const double x = double{1} * p.x - a.x, y = double{1} * p.y - a.y;
      box.extend(Point2{x * u.x + y * u.y, y * u.x - x * u.y});
    }
    if (box.width() * box.height() >= least) continue;
    least = box.width() * box.height();
    const double s = (box.xmin + box.xmax) / 2, t = (box.ymin + box.ymax) / 2;
    best.centre = {a.x + s * u.x - t * u.y, a.y + s * u.y + t * u.x};
    const bool along = box.width() >= box.height();
    best.axis = along ? u : Point2{-u.y, u.x};
    best.half_length = std::max(box.width(), box.height()) / 2;
    best.half_width = std::min(box.width(), box.height()) / 2;
  }
  return best;
}

}  // namespace itin
