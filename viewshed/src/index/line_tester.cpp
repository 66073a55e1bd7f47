#include "index/line_tester.hpp"

#include <itin/grazing.hpp>

#include "bounds/boundary.hpp"
#include "line/set_bits.hpp"
#include "line/sight_line.hpp"
#include "plan/memory.hpp"

namespace itin::viewshed {

namespace {

/// With more lines per triangle than this, rays are worth their scene. As measured over a town and over lidar, a line
/// decided by rays saves half a microsecond or more, and a triangle of the scene takes as long.
constexpr std::uint64_t kLinesPerTriangle = 1;

bool casts_rays(std::uint64_t triangles, std::uint64_t lines) {
  return lines > kLinesPerTriangle * triangles;
}

HeightPyramid pyramid_over(const RetrievedSurface& surface) {
  return surface.lattice ? HeightPyramid(surface.lattice->lattice()) : HeightPyramid(surface.tin);
}

}  // namespace

LineTester::LineTester(const RetrievedSurface& surface, const Earth& earth, std::uint64_t lines)
    : surface_(surface), pyramid_(pyramid_over(surface_)) {
  drop_ = earth.drop_coefficient() * units().resolution;
  grazing_ = kGrazing / units().resolution;
  if (!surface_.lattice && casts_rays(surface_.tin.triangles.size(), lines)) rays_.emplace(surface_.tin, earth);
}

std::uint64_t LineTester::bytes(std::uint64_t points, std::uint64_t lines) {
  constexpr std::uint64_t kTin = 300;
  return points * (casts_rays(2 * points, lines) ? kTin + kBytesPerPointOfRays : kTin);
}

std::vector<RimEdge> LineTester::rim() const {
  return surface_.lattice ? surface_.lattice->lattice().rim() : rim_of(surface_.tin, boundary_edges(surface_.tin));
}

unsigned LineTester::hidden(const SightLines& lines) const {
  if (rays_) return rays_->hidden(lines);
  unsigned result = 0;
  for_each_bit(lines.active, [&](unsigned i) {
    if (hidden({lines.from_x[i], lines.from_y[i], lines.from_z[i]}, {lines.to_x[i], lines.to_y[i], lines.to_z[i]}))
      result |= 1U << i;
  });
  return result;
}

bool LineTester::hidden(const Point3& from, const Point3& to) const {
  const SightLine line(from, to, drop_, grazing_);
  LineBundle bundle(line);
  bool hidden = false;
  pyramid_.search(bundle, [&](std::uint32_t triangle) {
    const auto [a, b, c] = pyramid_.corners(triangle);
    if (hidden || line.beside(a, b, c) || !line.hidden_by(a, b, c)) return;
    hidden = true;
    bundle.reach = -1;  // nothing is left to search
  });
  return hidden;
}

}  // namespace itin::viewshed
