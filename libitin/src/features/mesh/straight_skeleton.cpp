// The one place that knows CGAL's straight skeletons: they take longer to compile than all other features together.
#include <algorithm>
#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/create_straight_skeleton_from_polygon_with_holes_2.h>

#include "features/mesh/roof.hpp"

namespace itin {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;

/// Makes CGAL report by exceptions alone as long as it lives.
class QuietCgal {
 public:
  QuietCgal() : error_(CGAL::set_error_handler(ignore)), warning_(CGAL::set_warning_handler(ignore)) {}
  ~QuietCgal() {
    CGAL::set_error_handler(error_);
    CGAL::set_warning_handler(warning_);
  }
  QuietCgal(const QuietCgal&) = delete;
  QuietCgal& operator=(const QuietCgal&) = delete;

 private:
  static void ignore(const char*, const char*, const char*, int, const char*) {}
  CGAL::Failure_function error_, warning_;
};

/// The ring relative to the origin, the outline's first vertex: inexact constructions do best near zero.
Polygon local(const GridRing& ring, Position origin) {
  Polygon polygon;
  for (const Position& p : ring)
    polygon.push_back(
        {static_cast<double>(std::int64_t{p.x} - origin.x), static_cast<double>(std::int64_t{p.y} - origin.y)});
  return polygon;
}

bool plausible(const SkeletonArc& arc, double farthest) {
  const auto fine = [&](Point2 p, double rise) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(rise) && rise >= 0 && rise <= farthest;
  };
  return fine(arc.a, arc.rise_a) && fine(arc.b, arc.rise_b);
}

}  // namespace

std::optional<std::vector<SkeletonArc>> straight_skeleton(const GridPolygon& plan) {
  static const QuietCgal quiet;  // for good: handlers belong to the process, and threads come and go
  const Position origin = plan.outline.front();
  CGAL::Polygon_with_holes_2<Kernel> polygon(local(plan.outline, origin));
  for (const GridRing& hole : plan.holes) polygon.add_hole(local(hole, origin));
  const CGAL::Bbox_2 box = polygon.bbox();
  const double farthest = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  try {
    const auto skeleton = CGAL::create_interior_straight_skeleton_2(polygon, Kernel());
    if (!skeleton) return std::nullopt;
    std::vector<SkeletonArc> arcs;
    for (auto h = skeleton->halfedges_begin(); h != skeleton->halfedges_end(); ++h) {
      if (!h->is_bisector() || h->id() > h->opposite()->id()) continue;
      const auto a = h->opposite()->vertex(), b = h->vertex();
      SkeletonArc arc{{a->point().x() + origin.x, a->point().y() + origin.y},
                      {b->point().x() + origin.x, b->point().y() + origin.y},
                      a->time(),
                      b->time()};
      if (!plausible(arc, farthest)) return std::nullopt;
      arcs.push_back(arc);
    }
    return arcs;
  } catch (const CGAL::Failure_exception&) {
    return std::nullopt;
  }
}

}  // namespace itin
