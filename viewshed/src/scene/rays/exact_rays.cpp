#include "scene/rays/exact_rays.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bounds/surface_heights.hpp"
#include "line/infinity.hpp"
#include "line/set_bits.hpp"
#include "scene/rays/drift.hpp"

namespace itin::viewshed {

namespace {

Tin raised(const Tin& surface, const std::vector<Point2>& eyes) {
  Tin upper;
  upper.grid = surface.grid;
  upper.vertices = surface.vertices;
  upper.triangles = surface.triangles;
  raise_against_drift(eyes, upper);
  return upper;
}

}  // namespace

unsigned hidden_exactly(const Scene& surface, const UpperScene& upper, const SightLines& lines, unsigned starts_under,
                        unsigned ends_under) {
  UpperScene::Stretches stretches;
  upper.find_stretches(lines, starts_under, ends_under, stretches);
  unsigned result = 0;
  for_each_bit(lines.active, [&](unsigned i) {
    const bool hidden = std::any_of(stretches[i].begin(), stretches[i].end(),
                                    [&](const Stretch& s) { return surface.hidden_between(lines, i, s.from, s.to); });
    if (hidden) result |= 1U << i;
  });
  return result;
}

ExactRays::ExactRays(const Tin& surface, const Earth& earth, const std::vector<Point2>& eyes)
    : upper_tin_(raised(surface, eyes)),
      location_(location_grid(surface)),
      bins_(surface, location_),
      surface_(surface, earth),
      upper_(upper_tin_, {}, greatest_drift(eyes, upper_tin_), earth) {}

unsigned ExactRays::hidden(const SightLines& lines, Scratch& scratch) const {
  const unsigned hidden = surface_.hidden(lines, scratch.occluder);
  SightLines open = lines;
  open.active &= ~hidden;
  if (open.active == 0) return hidden;
  // All lines start at one eye.
  const auto first = static_cast<unsigned>(std::countr_zero(open.active));
  const double upper_eye = upper_at(lines.from_x[first], lines.from_y[first]);
  unsigned starts_under = 0, ends_under = 0;
  for_each_bit(open.active, [&](unsigned i) {
    const double dx = lines.to_x[i] - lines.from_x[i], dy = lines.to_y[i] - lines.from_y[i],
                 dz = lines.to_z[i] - lines.from_z[i];
    const double clear = 2 * upper_.error_bound(std::sqrt(dx * dx + dy * dy + dz * dz));
    if (lines.from_z[i] < upper_eye + clear) starts_under |= 1U << i;
    if (lines.to_z[i] < upper_at(lines.to_x[i], lines.to_y[i]) + clear) ends_under |= 1U << i;
  });
  const unsigned under = starts_under | ends_under;
  SightLines above = open;
  above.active &= ~under;
  open.active = (open.active & under) | upper_.touched(above);
  return open.active == 0 ? hidden : hidden | hidden_exactly(surface_, upper_, open, starts_under, ends_under);
}

double ExactRays::upper_at(double x, double y) const {
  const Grid& grid = upper_tin_.grid;
  const auto bin = location_.cell_at({grid.origin.x + x * grid.resolution, grid.origin.y + y * grid.resolution});
  if (!bin) return -kInfinity;
  return height_over(upper_tin_, bins_.triangles(location_.index(*bin)), {x, y}).value_or(-kInfinity);
}

}  // namespace itin::viewshed
