#include "scene/rays/scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bounds/boundary.hpp"
#include "bounds/surface_heights.hpp"
#include "bounds/triangle_bins.hpp"
#include "line/set_bits.hpp"
#include "scene/rays/embree.hpp"
#include "scene/rays/tessellation.hpp"
#include "scene/rays/walls.hpp"

namespace itin::viewshed {

namespace {

/// The data of a packet that the filters below see; Embree hands back the pointer to the first member.
struct HiddenPacket {
  RayContext context;
  const SightLines* lines;
  const SightLine* exact;
  std::array<std::uint32_t, SightLines::kSize> by{};  ///< triangles that hide a line
  unsigned by_triangle = 0;                           ///< one bit per line: a triangle in `by` hides it
  unsigned doubtful = 0;  ///< one bit per line: Embree took a triangle for hiding that does not hide
};

/// Keeps Embree's hits that hide, for which hides(packet, line, primitive) is true.
template <class Hides>
void keep_hits_that_hide(const RTCFilterFunctionNArguments* arguments, const Hides& hides) {
  auto& packet = *reinterpret_cast<HiddenPacket*>(arguments->context);
  const unsigned size = arguments->N;
  for (unsigned i = 0; i < size; ++i) {
    if (arguments->valid[i] == 0) continue;
    const unsigned line = RTCRayN_id(arguments->ray, size, i);
    if (hides(packet, line, RTCHitN_primID(arguments->hit, size, i))) continue;
    packet.doubtful |= 1U << line;
    arguments->valid[i] = 0;
  }
}

}  // namespace

class Scene::Impl {
 public:
  Impl(const Tin& tin, const Earth& earth)
      : tin_(tin),
        drop_(earth.drop_coefficient() * tin.grid.resolution),
        sag_(drop_ == 0 ? 0 : kSag),
        tessellation_(tessellate(tin, drop_)),
        location_(location_grid(tin)),
        bins_(tin, location_),
        boundary_(boundary_edges(tin)) {
    attach_surface();
    attach_walls();
    embree_.commit();
    // Frees memory for the ray casting that follows; Embree has its own copy of what it needs.
    tessellation_.indices = {};
  }

  unsigned hidden(const SightLines& lines, Occluder& occluder) const {
    const ExactLines exact = exact_lines(lines, std::make_index_sequence<SightLines::kSize>());
    const unsigned known = hidden_by_one(occluder, exact, lines.active);
    if (known == lines.active) return known;
    HiddenPacket packet;
    unsigned result = known | cast(lines, lines.active & ~known, exact, packet);
    if (packet.by_triangle != 0)
      occluder.triangle = packet.by[static_cast<unsigned>(std::bit_width(packet.by_triangle)) - 1];
    for_each_bit(packet.doubtful & ~result, [&](unsigned i) {
      if (hidden_by_any(lines, i, exact[i], 0, 1)) result |= 1U << i;
    });
    return result;
  }

  unsigned hidden_together(const SightLines& lines, Occluder& occluder) const {
    if (drop_ < 0) return 0;
    const ExactLines exact = exact_lines(lines, std::make_index_sequence<SightLines::kSize>());
    unsigned result = 0, open = lines.active;
    const auto hide_group = [&](unsigned group, const Occluder& by) {
      const unsigned four = 0xfU << 4 * group;
      if ((open & four) == 0 || hidden_by_one(by, exact, four) != four) return;
      result |= 1U << group;
      open &= ~four;
      occluder = by;
    };
    for (unsigned group = 0; group < SightLines::kSize / 4; ++group) hide_group(group, occluder);
    if (open == 0) return result;
    HiddenPacket packet;
    cast(lines, open, exact, packet);
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const unsigned group = i / 4;
      if ((packet.by_triangle >> 4 * group & 0xfU) == 0xfU) hide_group(group, {packet.by[i]});
    }
    return result;
  }

  bool hidden_between(const SightLines& lines, unsigned i, double from, double to) const {
    const SightLine exact({lines.from_x[i], lines.from_y[i], lines.from_z[i]},
                          {lines.to_x[i], lines.to_y[i], lines.to_z[i]}, drop_, kGrazing / tin_.grid.resolution);
    return hidden_by_any(lines, i, exact, from, to);
  }

  std::optional<double> ground(Point2 position) const {
    const auto bin = location_.cell_at(position);
    if (!bin) return std::nullopt;
    const auto height = surface_height(tin_, bins_.triangles(location_.index(*bin)), position);
    return height ? std::optional(*height * tin_.grid.resolution) : std::nullopt;
  }

 private:
  using ExactLines = std::array<SightLine, SightLines::kSize>;

  /// e(l) in metres for a line of `length` metres.
  double error_bound(double length) const {
    return sag_ + rounding_error(tessellation_.half_height * tin_.grid.resolution, length);
  }

  /// The lines of `active` that Embree finds hidden.
  unsigned cast(const SightLines& lines, unsigned active, const ExactLines& exact, HiddenPacket& packet) const {
    alignas(64) RTCRay16 rays;
    alignas(64) std::array<int, SightLines::kSize> valid;
    const RayFrame frame{tessellation_.centre, drop_, error_bound(0) / tin_.grid.resolution, kRounding * kRoundings};
    frame.cast(lines, active, rays, valid);
    packet.lines = &lines;
    packet.exact = exact.data();
    occluded(embree_.scene(), valid, packet.context, rays);
    unsigned result = 0;
    for (unsigned i = 0; i < SightLines::kSize; ++i)
      result |= static_cast<unsigned>(valid[i] != 0 && rays.tfar[i] < 0) << i;
    return result;
  }

  template <std::size_t... i>
  ExactLines exact_lines(const SightLines& l, std::index_sequence<i...>) const {
    return {SightLine({l.from_x[i], l.from_y[i], l.from_z[i]}, {l.to_x[i], l.to_y[i], l.to_z[i]}, drop_,
                      kGrazing / tin_.grid.resolution)...};
  }

  void attach_surface() {
    const Geometry geometry = embree_.triangles(tessellation_.vertices, tessellation_.indices, this);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), [](const RTCFilterFunctionNArguments* arguments) {
      const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
      keep_hits_that_hide(arguments, [&](HiddenPacket& packet, unsigned line, std::uint32_t piece) {
        const auto& parents = self.tessellation_.parents;
        const std::uint32_t triangle = parents.empty() ? piece : parents[piece];
        if (!self.hides(packet.exact[line], triangle)) return false;
        packet.by[line] = triangle;
        packet.by_triangle |= 1U << line;
        return true;
      });
    });
    embree_.attach(geometry);
  }

  /// Which of the lines the occluder hides.
  unsigned hidden_by_one(const Occluder& occluder, const ExactLines& lines, unsigned active) const {
    if (!occluder.triangle) return 0;
    unsigned result = 0;
    for_each_bit(active, [&](unsigned i) {
      if (hides(lines[i], *occluder.triangle)) result |= 1U << i;
    });
    return result;
  }

  bool hides(const SightLine& line, std::uint32_t triangle) const {
    const Triangle& t = tin_.triangles[triangle];
    return line.hidden_by(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
  }

  /// Asks every triangle in the bins under a part of the line: the slow way, for the few lines that run along an edge.
  bool hidden_by_any(const SightLines& lines, unsigned i, const SightLine& line, double start, double end) const {
    const auto bin_at = [&](double s) {
      const double x = lines.from_x[i] + s * (lines.to_x[i] - lines.from_x[i]);
      const double y = lines.from_y[i] + s * (lines.to_y[i] - lines.from_y[i]);
      return Point2{location_.column_at(tin_.grid.origin.x + x * tin_.grid.resolution),
                    location_.row_at(tin_.grid.origin.y + y * tin_.grid.resolution)};
    };
    const Point2 from = bin_at(start), to = bin_at(end);
    // Steps of half a bin, with the bins about each, take more bins than needed and leave none out.
    const double steps = std::ceil(2 * std::max(std::abs(to.x - from.x), std::abs(to.y - from.y))) + 1;
    std::array<std::size_t, 4> before{kNoBin, kNoBin, kNoBin, kNoBin};
    for (double step = 0; step <= steps; ++step) {
      const Point2 at = bin_at(start + (end - start) * (step / steps));
      std::array<std::size_t, 4> bins = before;
      for (std::size_t corner = 0; corner < 4; ++corner)
        bins[corner] = bin_about(at.x + (corner % 2 == 0 ? -0.5 : 0.5), at.y + (corner < 2 ? -0.5 : 0.5));
      for (const std::size_t bin : bins) {
        if (bin == kNoBin || std::find(before.begin(), before.end(), bin) != before.end()) continue;
        for (const std::uint32_t triangle : bins_.triangles(bin))
          if (hides(line, triangle)) return true;
      }
      before = bins;
    }
    return false;
  }

  static constexpr std::size_t kNoBin = ~std::size_t{0};
  std::size_t bin_about(double x, double y) const {
    const double column = std::floor(x), row = std::floor(y);
    const bool outside = column < 0 || row < 0 || column >= static_cast<double>(location_.columns()) ||
                         row >= static_cast<double>(location_.rows());
    return outside ? kNoBin : location_.index({static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)});
  }

  void attach_walls() {
    if (boundary_.empty()) return;
    const Barrier walls = walls_under(tin_, boundary_, tessellation_, drop_);
    const Geometry geometry = embree_.triangles(walls.vertices, walls.indices, this);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), [](const RTCFilterFunctionNArguments* arguments) {
      const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
      keep_hits_that_hide(arguments, [&](const HiddenPacket& packet, unsigned line, std::uint32_t side) {
        return self.hides(packet.exact[line], self.boundary_[side / kTrianglesPerWall].triangle);
      });
    });
    embree_.attach(geometry);
  }

  const Tin& tin_;
  double drop_;  ///< grid units of drop per squared grid unit
  double sag_;
  Tessellation tessellation_;
  RasterGrid location_;
  TriangleBins bins_;
  std::vector<BoundaryEdge> boundary_;
  EmbreeScene embree_;
};

Scene::Scene(const Tin& tin, const Earth& earth) : impl_(std::make_unique<Impl>(tin, earth)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

unsigned Scene::hidden(const SightLines& lines, Occluder& occluder) const {
  return impl_->hidden(lines, occluder);
}
unsigned Scene::hidden_together(const SightLines& lines, Occluder& occluder) const {
  return impl_->hidden_together(lines, occluder);
}
bool Scene::hidden_between(const SightLines& lines, unsigned line, double from, double to) const {
  return impl_->hidden_between(lines, line, from, to);
}
std::optional<double> Scene::ground(Point2 position) const {
  return impl_->ground(position);
}

}  // namespace itin::viewshed
