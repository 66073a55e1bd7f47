#include "scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>

#if ITIN_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "boundary.hpp"
#include "surface_heights.hpp"
#include "tessellation.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

namespace {

constexpr double kRounding = 0x1p-24;
constexpr double kRoundings = 16;  ///< of Embree's edge functions; see the header

#if ITIN_EMBREE_MAJOR >= 4
using RayContext = RTCRayQueryContext;
#else
using RayContext = RTCIntersectContext;
#endif

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct GeometryRelease {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, GeometryRelease>;

/// What the filters below see of a packet; Embree hands back the pointer to the first member.
struct PacketContext {
  RayContext context;
  const SightLines* lines;
  const SightLine* exact;
  Occluder* occluder;
  unsigned doubtful = 0;  ///< one bit a line: Embree took a triangle for hiding that does not
};

enum class Hit { kHides, kPasses, kDoubtful };

/// Keeps those of Embree's hits that hide, by `judge(packet, line, primitive)`.
template <class Judge>
void filter(const RTCFilterFunctionNArguments* arguments, const Judge& judge) {
  auto& packet = *reinterpret_cast<PacketContext*>(arguments->context);
  const unsigned size = arguments->N;
  for (unsigned i = 0; i < size; ++i) {
    if (arguments->valid[i] == 0) continue;
    const unsigned line = RTCRayN_id(arguments->ray, size, i);
    const Hit hit = judge(packet, line, RTCHitN_primID(arguments->hit, size, i));
    if (hit == Hit::kDoubtful) packet.doubtful |= 1U << line;
    if (hit != Hit::kHides) arguments->valid[i] = 0;
  }
}

/// About as many bins as triangles, so that a few triangles lie in each.
RasterGrid location_grid(const Tin& tin) {
  const Box box = tin.bounds();
  if (box.empty()) return {{0, 0}, 1, 1, 1, 1};
  const double size = std::max({box.width(), box.height(), tin.grid.resolution});
  const double side = std::clamp(std::floor(std::sqrt(tin.triangles.size())), 1.0, 512.0);
  // A hundredth more than needed, so that the eastern and southern edges lie inside.
  const double bin = size * 1.01 / side;
  return {{box.xmin, box.ymax}, bin, bin, static_cast<std::int64_t>(side), static_cast<std::int64_t>(side)};
}

}  // namespace

class Scene::Impl {
 public:
  Impl(const Tin& tin, const Earth& earth, NoData nodata, double ceiling)
      : tin_(tin),
        drop_(earth.drop_coefficient() * tin.grid.resolution),
        sag_(drop_ == 0 ? 0 : kSag),
        tessellation_(tessellate(tin, drop_)),
        location_(location_grid(tin)),
        bins_(tin, location_),
        boundary_(boundary_edges(tin)),
        curtains_(nodata == NoData::kBlock),
        device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::bad_alloc();
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    attach_surface();
    attach_walls(ceiling);
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
    // Fewer, larger arrays for the ray casting that follows; Embree has its own copy of what it needs.
    tessellation_.indices = {};
  }

  unsigned hidden(const SightLines& lines, Occluder& occluder) const {
    const std::array<SightLine, SightLines::kSize> exact =
        exact_lines(lines, std::make_index_sequence<SightLines::kSize>());
    const unsigned known = hidden_by_one(occluder, exact, lines.active);
    if (known == lines.active) return known;
    alignas(64) RTCRay16 rays;
    alignas(64) std::array<int, SightLines::kSize> valid;
    cast_from(lines, lines.active & ~known, rays, valid);
    PacketContext packet;
    packet.lines = &lines;
    packet.exact = exact.data();
    packet.occluder = &occluder;
#if ITIN_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&packet.context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments.context = &packet.context;
    rtcOccluded16(valid.data(), scene_.get(), &rays, &arguments);
#else
    rtcInitIntersectContext(&packet.context);
    packet.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid.data(), scene_.get(), &packet.context, &rays);
#endif
    unsigned result = known;
    for (unsigned i = 0; i < SightLines::kSize; ++i)
      result |= static_cast<unsigned>(valid[i] != 0 && rays.tfar[i] < 0) << i;
    for (unsigned doubtful = packet.doubtful & ~result; doubtful != 0; doubtful &= doubtful - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(doubtful));
      if (hidden_by_any(lines, i, exact[i])) result |= 1U << i;
    }
    return result;
  }

  std::optional<double> ground(Point2 position) const {
    const auto bin = location_.cell_at(position);
    if (!bin) return std::nullopt;
    const auto height = surface_height(tin_, bins_.triangles(location_.index(*bin)), position);
    return height ? std::optional(*height * tin_.grid.resolution) : std::nullopt;
  }

  const std::vector<BoundaryEdge>& boundary() const {
    return boundary_;
  }
  double error_bound(double length) const {
    return sag_ + kRounding * (4 * tessellation_.half_height * tin_.grid.resolution + kRoundings * length);
  }
  double lateral_error_bound(double length) const {
    return kRounding * (4 * tessellation_.half_width * tin_.grid.resolution + kRoundings * length);
  }

 private:
  template <std::size_t... i>
  std::array<SightLine, sizeof...(i)> exact_lines(const SightLines& l, std::index_sequence<i...>) const {
    return {SightLine({l.from_x[i], l.from_y[i], l.from_z[i]}, {l.to_x[i], l.to_y[i], l.to_z[i]}, drop_,
                      kGrazing / tin_.grid.resolution)...};
  }

  /// Single precision, lowered by the Earth's curvature, raised by the error bound.
  void cast_from(const SightLines& lines, unsigned active, RTCRay16& rays,
                 std::array<int, SightLines::kSize>& valid) const {
    const double cx = tessellation_.centre.x, cy = tessellation_.centre.y, cz = tessellation_.centre.z;
    const double constant = error_bound(0) / tin_.grid.resolution;
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const double fx = lines.from_x[i] - cx, fy = lines.from_y[i] - cy;
      const double tx = lines.to_x[i] - cx, ty = lines.to_y[i] - cy;
      const double fz = lines.from_z[i] - cz - drop_ * (fx * fx + fy * fy);
      const double tz = lines.to_z[i] - cz - drop_ * (tx * tx + ty * ty);
      const double length = std::sqrt((tx - fx) * (tx - fx) + (ty - fy) * (ty - fy) + (tz - fz) * (tz - fz));
      const double raise = constant + kRounding * kRoundings * length;
      rays.org_x[i] = static_cast<float>(fx);
      rays.org_y[i] = static_cast<float>(fy);
      rays.org_z[i] = static_cast<float>(fz + raise);
      // From the rounded origin, so that the other end is where it should be.
      rays.dir_x[i] = static_cast<float>(tx - static_cast<double>(rays.org_x[i]));
      rays.dir_y[i] = static_cast<float>(ty - static_cast<double>(rays.org_y[i]));
      rays.dir_z[i] = static_cast<float>(tz + raise - static_cast<double>(rays.org_z[i]));
      rays.tnear[i] = 0;
      rays.tfar[i] = 1;
      rays.time[i] = 0;
      rays.mask[i] = 0xffffffff;
      rays.id[i] = i;
      rays.flags[i] = 0;
      valid[i] = (active >> i & 1) != 0 ? -1 : 0;
    }
  }

  Geometry triangles(const std::vector<float>& vertices, const std::vector<std::uint32_t>& indices) {
    Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* const v = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size() / 3));
    auto* const t = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), indices.size() / 3));
    if (!v || !t) throw std::bad_alloc();
    std::copy(vertices.begin(), vertices.end(), v);
    std::copy(indices.begin(), indices.end(), t);
    rtcSetGeometryUserData(geometry.get(), this);
    return geometry;
  }

  void attach(const Geometry& geometry) {
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
  }

  void attach_surface() {
    const Geometry geometry = triangles(tessellation_.vertices, tessellation_.indices);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), [](const RTCFilterFunctionNArguments* arguments) {
      const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
      filter(arguments, [&](const PacketContext& packet, unsigned line, std::uint32_t piece) {
        const auto& parents = self.tessellation_.parents;
        const std::uint32_t triangle = parents.empty() ? piece : parents[piece];
        if (!self.hides(packet.exact[line], triangle)) return Hit::kDoubtful;
        packet.occluder->triangle = triangle;
        return Hit::kHides;
      });
    });
    attach(geometry);
  }

  /// Those of the lines that the occluder hides.
  unsigned hidden_by_one(const Occluder& occluder, const std::array<SightLine, SightLines::kSize>& lines,
                         unsigned active) const {
    if (!occluder.triangle) return 0;
    unsigned result = 0;
    for (; active != 0; active &= active - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(active));
      if (hides(lines[i], *occluder.triangle)) result |= 1U << i;
    }
    return result;
  }

  bool hides(const SightLine& line, std::uint32_t triangle) const {
    const Triangle& t = tin_.triangles[triangle];
    return line.hidden_by(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
  }

  /// The slow way, for the few lines that run along an edge: every triangle in the bins under the line, and every
  /// curtain.
  bool hidden_by_any(const SightLines& lines, unsigned i, const SightLine& line) const {
    const auto bin_at = [&](double s) {
      const double x = lines.from_x[i] + s * (lines.to_x[i] - lines.from_x[i]);
      const double y = lines.from_y[i] + s * (lines.to_y[i] - lines.from_y[i]);
      return Point2{location_.column_at(tin_.grid.origin.x + x * tin_.grid.resolution),
                    location_.row_at(tin_.grid.origin.y + y * tin_.grid.resolution)};
    };
    const Point2 from = bin_at(0), to = bin_at(1);
    // Steps of half a bin and the bins about each: more than needed, none left out.
    const double steps = std::ceil(2 * std::max(std::abs(to.x - from.x), std::abs(to.y - from.y))) + 1;
    for (double step = 0; step <= steps; ++step) {
      const Point2 at = bin_at(step / steps);
      for (const double dy : {-0.5, 0.5}) {
        for (const double dx : {-0.5, 0.5}) {
          const double column = std::floor(at.x + dx), row = std::floor(at.y + dy);
          if (column < 0 || row < 0 || column >= location_.columns() || row >= location_.rows()) continue;
          const std::size_t bin = location_.index({static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)});
          for (const std::uint32_t triangle : bins_.triangles(bin))
            if (hides(line, triangle)) return true;
        }
      }
    }
    return curtains_ && std::any_of(boundary_.begin(), boundary_.end(), [&](const BoundaryEdge& edge) {
             return comes_back(lines, i, edge) == Hit::kHides;
           });
  }

  /// Two triangles along each boundary edge, from below everything: up to the edge, so that no line passes under the
  /// surface from one void to another; with curtains up to the ceiling.
  void attach_walls(double ceiling) {
    if (boundary_.empty()) return;
    const double metre = 1 / tin_.grid.resolution;
    const auto bottom = static_cast<float>(-(2 * tessellation_.half_height + metre));
    const auto sky = static_cast<float>(ceiling * metre - tessellation_.centre.z + tessellation_.half_height + metre);
    std::vector<float> vertices;
    std::vector<std::uint32_t> indices;
    for (const BoundaryEdge& edge : boundary_) {
      const auto first = static_cast<std::uint32_t>(vertices.size() / 3);
      const GridPoint &a = tin_.vertices[edge.from], &b = tin_.vertices[edge.to];
      const double length = std::hypot(static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y);
      // The edge may have been cut, and then bulges above the straight wall.
      const auto bulge = static_cast<float>(std::max(drop_, 0.0) * length * length / 4);
      for (const std::uint32_t end : {edge.from, edge.to}) {
        const float* const v = tessellation_.vertices.data() + 3 * std::size_t{end};
        vertices.insert(vertices.end(), {v[0], v[1], bottom, v[0], v[1], curtains_ ? sky : v[2] + bulge});
      }
      indices.insert(indices.end(), {first, first + 2, first + 3, first, first + 3, first + 1});
    }
    const Geometry geometry = triangles(vertices, indices);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), [](const RTCFilterFunctionNArguments* arguments) {
      const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
      filter(arguments, [&](const PacketContext& packet, unsigned line, std::uint32_t side) {
        const BoundaryEdge& edge = self.boundary_[side / 2];
        if (self.hides(packet.exact[line], edge.triangle)) return Hit::kHides;
        return self.curtains_ ? self.comes_back(*packet.lines, line, edge) : Hit::kDoubtful;
      });
    });
    attach(geometry);
  }

  /// Whether a line that left the surface returns to it across the edge. Leaving alone hides nothing: a target on the
  /// edge of the data, or a line along that edge, is not behind a curtain.
  Hit comes_back(const SightLines& lines, unsigned i, const BoundaryEdge& edge) const {
    const GridPoint &a = tin_.vertices[edge.from], &b = tin_.vertices[edge.to];
    const auto side_of_edge = [&](double x, double y) {
      return (static_cast<double>(b.x) - a.x) * (y - a.y) - (static_cast<double>(b.y) - a.y) * (x - a.x);
    };
    const auto side_of_line = [&](const GridPoint& p) {
      return (lines.to_x[i] - lines.from_x[i]) * (p.y - lines.from_y[i]) -
             (lines.to_y[i] - lines.from_y[i]) * (p.x - lines.from_x[i]);
    };
    const bool back =
        side_of_edge(lines.from_x[i], lines.from_y[i]) < 0 && side_of_edge(lines.to_x[i], lines.to_y[i]) > 0;
    if (!back) return Hit::kPasses;
    return (side_of_line(a) < 0) != (side_of_line(b) < 0) ? Hit::kHides : Hit::kDoubtful;
  }

  const Tin& tin_;
  double drop_;  ///< grid units of drop a squared grid unit
  double sag_;
  Tessellation tessellation_;
  RasterGrid location_;
  TriangleBins bins_;
  std::vector<BoundaryEdge> boundary_;
  bool curtains_;
  Device device_;
  EmbreeScene scene_;
};

Scene::Scene(const Tin& tin, const Earth& earth, NoData nodata, double ceiling)
    : impl_(std::make_unique<Impl>(tin, earth, nodata, ceiling)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

unsigned Scene::hidden(const SightLines& lines, Occluder& occluder) const {
  return impl_->hidden(lines, occluder);
}
std::optional<double> Scene::ground(Point2 position) const {
  return impl_->ground(position);
}
const std::vector<BoundaryEdge>& Scene::boundary() const {
  return impl_->boundary();
}
double Scene::error_bound(double length) const {
  return impl_->error_bound(length);
}
double Scene::lateral_error_bound(double length) const {
  return impl_->lateral_error_bound(length);
}

}  // namespace itin::viewshed
