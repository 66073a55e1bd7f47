#include "envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <itin/certificate.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>

#include "embree.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kChunk = 1 << 12;

void for_each_chunk(std::size_t count, const auto& body) {
  parallel_for((count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) body(i);
  });
}

GridBox box_of(const Tin& tin, const Triangle& t) {
  GridBox box;
  for (const std::uint32_t v : t) box.extend(tin.vertices[v].x, tin.vertices[v].y);
  return box;
}

/// Of each vertex: the bounds over all its triangles.
std::vector<HeightBounds> vertex_bounds(const Store& store, int level, const Tin& tin) {
  std::vector<HeightBounds> result(tin.vertices.size());
  if (level == 0) return result;
  const Certificate certificate = store.certificate(level, tin.bounds());
  std::vector<HeightBounds> of_triangle(tin.triangles.size());
  for_each_chunk(of_triangle.size(), [&](std::size_t t) {
    if (const auto bounds = certificate.over(box_of(tin, tin.triangles[t]))) of_triangle[t] = *bounds;
  });
  constexpr auto kMax = std::numeric_limits<std::int32_t>::max(), kMin = std::numeric_limits<std::int32_t>::min();
  std::fill(result.begin(), result.end(), HeightBounds{kMax, kMin});
  for (std::size_t t = 0; t < of_triangle.size(); ++t) {
    for (const std::uint32_t v : tin.triangles[t]) {
      result[v].lo = std::min(result[v].lo, of_triangle[t].lo);
      result[v].hi = std::max(result[v].hi, of_triangle[t].hi);
    }
  }
  return result;
}

/// Grid units up a grid unit along.
double slope_of(const Tin& tin, const Triangle& t) {
  const GridPoint &a = tin.vertices[t[0]], &b = tin.vertices[t[1]], &c = tin.vertices[t[2]];
  const double ux = double{1} * b.x - a.x, uy = double{1} * b.y - a.y, uz = double{1} * b.z - a.z;
  const double vx = double{1} * c.x - a.x, vy = double{1} * c.y - a.y, vz = double{1} * c.z - a.z;
  const double area = ux * vy - uy * vx;
  return std::hypot(uy * vz - uz * vy, uz * vx - ux * vz) / area;
}

/// Raises the surface by what it may rise within delta(l) of a place: a ray in single precision may run that far beside
/// its line. Twice, for the slopes of triangles next to a vertex's own.
void raise_against_drift(const std::vector<Point2>& observers, Tin& tin) {
  std::vector<float> slope(tin.vertices.size());
  for (const Triangle& t : tin.triangles) {
    const auto s = static_cast<float>(slope_of(tin, t));
    for (const std::uint32_t v : t) slope[v] = std::max(slope[v], s);
  }
  const Box box = tin.bounds();
  const double half = std::max(box.width(), box.height()) / 2 / tin.grid.resolution;
  for_each_chunk(tin.vertices.size(), [&](std::size_t v) {
    const Point3 p = tin.point(static_cast<std::uint32_t>(v));
    double farthest = 0;
    for (const Point2& o : observers) farthest = std::max(farthest, std::hypot(p.x - o.x, p.y - o.y));
    const double drift = rounding_error(half, farthest / tin.grid.resolution + 1);
    tin.vertices[v].z += static_cast<std::int32_t>(std::ceil(2 * drift * static_cast<double>(slope[v])));
  });
}

bool within(const Tin& tin, const Triangle& t, const FineDisc& disc) {
  return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
    const Point3 p = tin.point(v);
    return std::hypot(p.x - disc.centre.x, p.y - disc.centre.y) < disc.radius;
  });
}

class Builder {
 public:
  Builder(const Store& store, const ThemeChoice& themes, Progress& progress)
      : store_(store), themes_(themes), progress_(progress) {}

  void add(const Window& window, int level) {
    const double tolerance = store_.metadata().levels[static_cast<std::size_t>(level)].tolerance;
    const Tin piece = triangulate(store_, window, Detail::tolerance(tolerance), progress_, themes_);
    const std::vector<HeightBounds> bounds = vertex_bounds(store_, level, piece);
    const auto first = static_cast<std::uint32_t>(lower_.vertices.size());
    lower_.grid = piece.grid;
    firsts_.push_back(static_cast<std::uint32_t>(lower_.triangles.size()));
    lower_.statistics += piece.statistics;
    for (std::size_t v = 0; v < piece.vertices.size(); ++v) {
      const GridPoint& p = piece.vertices[v];
      lower_.vertices.push_back({p.x, p.y, p.z + bounds[v].lo});
      upper_.push_back(p.z + bounds[v].hi);
    }
    for (const Triangle& t : piece.triangles) lower_.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }

  void mark_outline() { outline_ = boundary_edges(lower_); }

  /// Leaves out what lies within a disc, but for triangles at the outline.
  void clear(const std::vector<FineDisc>& discs) {
    std::vector<std::uint8_t> drop(lower_.triangles.size());
    for_each_chunk(drop.size(), [&](std::size_t t) {
      drop[t] = std::any_of(discs.begin(), discs.end(),
                            [&](const FineDisc& disc) { return within(lower_, lower_.triangles[t], disc); });
    });
    for (const BoundaryEdge& edge : outline_) drop[edge.triangle] = 0;
    std::vector<std::uint32_t> number(drop.size());
    std::uint32_t kept = 0;
    for (std::size_t t = 0; t < drop.size(); ++t) {
      number[t] = kept;
      if (!drop[t]) lower_.triangles[kept++] = lower_.triangles[t];
    }
    for (std::uint32_t& first : firsts_) first = first < number.size() ? number[first] : kept;
    lower_.triangles.resize(kept);
    for (BoundaryEdge& edge : outline_) edge.triangle = number[edge.triangle];
  }

  Envelope finish(const std::vector<Point2>& observers) && {
    Envelope envelope;
    lower_.sources.assign(lower_.vertices.size(), 0);
    envelope.upper = lower_;
    for (std::size_t v = 0; v < upper_.size(); ++v) envelope.upper.vertices[v].z = upper_[v];
    raise_against_drift(observers, envelope.upper);
    envelope.lower = std::move(lower_);
    envelope.outline = std::move(outline_);
    envelope.pieces.assign(firsts_.begin() + 1, firsts_.end());
    return envelope;
  }

 private:
  const Store& store_;
  const ThemeChoice& themes_;
  Progress& progress_;
  Tin lower_;
  std::vector<std::int32_t> upper_;  ///< heights
  std::vector<BoundaryEdge> outline_;
  std::vector<std::uint32_t> firsts_;  ///< triangles, of each piece
};

}  // namespace

int level_within(const StoreMetadata& metadata, double tolerance) {
  int level = 0;
  while (level + 1 < static_cast<int>(metadata.levels.size()) &&
         metadata.levels[static_cast<std::size_t>(level) + 1].tolerance <= tolerance)
    ++level;
  return level;
}

Envelope envelop(const Store& store, const EnvelopeRequest& request, Progress& progress) {
  Builder builder(store, request.themes, progress);
  builder.add(request.window, request.level);
  builder.mark_outline();
  for (int level = request.level - 1; level >= 0; --level) {
    std::vector<FineDisc> discs;
    std::vector<Window::Polygon> parts;
    for (const FineDisc& disc : request.discs) {
      if (disc.level != level) continue;
      discs.push_back(disc);
      parts.push_back(Window::disc(disc.centre, disc.radius).parts().front());
    }
    if (discs.empty()) continue;
    builder.clear(discs);
    builder.add(Window::polygons(std::move(parts)), level);
  }
  Envelope envelope = std::move(builder).finish(request.observers);
  envelope.exact = request.level == 0;
  if (request.bare_ground) {
    envelope.bare_ground = triangulate(store, *request.bare_ground, Detail::tolerance(0), progress);
    envelope.lower.statistics += envelope.bare_ground->statistics;
  }
  return envelope;
}

}  // namespace itin::viewshed
