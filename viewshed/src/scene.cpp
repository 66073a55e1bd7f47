#include "scene.hpp"

#include <cmath>
#include <new>

#if ITIN_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "boundary.hpp"
#include "tessellation.hpp"

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
};

/// Keeps those of Embree's candidate hits for which `hides(line, primitive)` holds.
template <class Hides>
void filter(const RTCFilterFunctionNArguments* arguments, const Hides& hides) {
  const unsigned size = arguments->N;
  for (unsigned i = 0; i < size; ++i) {
    if (arguments->valid[i] == 0) continue;
    const unsigned line = RTCRayN_id(arguments->ray, size, i);
    if (!hides(line, RTCHitN_primID(arguments->hit, size, i))) arguments->valid[i] = 0;
  }
}

}  // namespace

class Scene::Impl {
 public:
  Impl(const Tin& tin, const Earth& earth, NoData nodata, double ceiling)
      : tin_(tin),
        drop_(earth.drop_coefficient() * tin.grid.resolution),
        sag_(drop_ == 0 ? 0 : kSag),
        tessellation_(tessellate(tin, drop_)),
        device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::bad_alloc();
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    attach_surface();
    if (nodata == NoData::kBlock) {
      boundary_ = boundary_edges(tin);
      attach_curtains(ceiling);
    }
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
    // Fewer, larger arrays for the ray casting that follows; Embree has its own copy of what it needs.
    tessellation_.indices = {};
  }

  unsigned hidden(const SightLines& lines) const {
    alignas(64) RTCRay16 rays;
    alignas(64) std::array<int, SightLines::kSize> valid;
    cast_from(lines, rays, valid);
    std::array<SightLine, SightLines::kSize> exact = exact_lines(lines, std::make_index_sequence<SightLines::kSize>());
    PacketContext packet;
    packet.lines = &lines;
    packet.exact = exact.data();
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
    unsigned result = 0;
    for (unsigned i = 0; i < SightLines::kSize; ++i) result |= static_cast<unsigned>(rays.tfar[i] < 0) << i;
    return result & lines.active;
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

  /// Single precision, lowered by the Earth's curvature and the error bound.
  void cast_from(const SightLines& lines, RTCRay16& rays, std::array<int, SightLines::kSize>& valid) const {
    const double cx = tessellation_.centre.x, cy = tessellation_.centre.y, cz = tessellation_.centre.z;
    const double constant = error_bound(0) / tin_.grid.resolution;
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const double fx = lines.from_x[i] - cx, fy = lines.from_y[i] - cy;
      const double tx = lines.to_x[i] - cx, ty = lines.to_y[i] - cy;
      const double fz = lines.from_z[i] - cz - drop_ * (fx * fx + fy * fy);
      const double tz = lines.to_z[i] - cz - drop_ * (tx * tx + ty * ty);
      const double length = std::sqrt((tx - fx) * (tx - fx) + (ty - fy) * (ty - fy) + (tz - fz) * (tz - fz));
      const double lowering = constant + kRounding * kRoundings * length;
      rays.org_x[i] = static_cast<float>(fx);
      rays.org_y[i] = static_cast<float>(fy);
      rays.org_z[i] = static_cast<float>(fz - lowering);
      // From the rounded origin, so that the other end is where it should be.
      rays.dir_x[i] = static_cast<float>(tx - static_cast<double>(rays.org_x[i]));
      rays.dir_y[i] = static_cast<float>(ty - static_cast<double>(rays.org_y[i]));
      rays.dir_z[i] = static_cast<float>(tz - lowering - static_cast<double>(rays.org_z[i]));
      rays.tnear[i] = 0;
      rays.tfar[i] = 1;
      rays.time[i] = 0;
      rays.mask[i] = 0xffffffff;
      rays.id[i] = i;
      rays.flags[i] = 0;
      valid[i] = (lines.active >> i & 1) != 0 ? -1 : 0;
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
      const auto& packet = *reinterpret_cast<const PacketContext*>(arguments->context);
      filter(arguments,
             [&](unsigned line, std::uint32_t triangle) { return self.hides(packet.exact[line], triangle); });
    });
    attach(geometry);
  }

  bool hides(const SightLine& line, std::uint32_t piece) const {
    const std::uint32_t triangle = tessellation_.parents.empty() ? piece : tessellation_.parents[piece];
    const Triangle& t = tin_.triangles[triangle];
    return line.hidden_by(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
  }

  /// Two triangles along each boundary edge, from below everything to above everything.
  void attach_curtains(double ceiling) {
    const double metre = 1 / tin_.grid.resolution;
    const auto bottom = static_cast<float>(-(2 * tessellation_.half_height + metre));
    const auto top = static_cast<float>(ceiling * metre - tessellation_.centre.z + tessellation_.half_height + metre);
    std::vector<float> vertices;
    std::vector<std::uint32_t> indices;
    for (const BoundaryEdge& edge : boundary_) {
      const auto first = static_cast<std::uint32_t>(vertices.size() / 3);
      for (const std::uint32_t end : {edge.from, edge.to}) {
        const float x = tessellation_.vertices[3 * std::size_t{end}],
                    y = tessellation_.vertices[3 * std::size_t{end} + 1];
        vertices.insert(vertices.end(), {x, y, bottom, x, y, top});
      }
      indices.insert(indices.end(), {first, first + 2, first + 3, first, first + 3, first + 1});
    }
    const Geometry geometry = triangles(vertices, indices);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), [](const RTCFilterFunctionNArguments* arguments) {
      const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
      const auto& packet = *reinterpret_cast<const PacketContext*>(arguments->context);
      filter(arguments, [&](unsigned line, std::uint32_t side) {
        return self.comes_back(*packet.lines, line, self.boundary_[side / 2]);
      });
    });
    attach(geometry);
  }

  /// Whether a line that left the surface returns to it across the edge. Leaving alone hides nothing: a target on the
  /// edge of the data, or a line along that edge, is not behind a curtain.
  bool comes_back(const SightLines& lines, unsigned i, const BoundaryEdge& edge) const {
    const GridPoint &a = tin_.vertices[edge.from], &b = tin_.vertices[edge.to];
    const auto side_of_edge = [&](double x, double y) {
      return (static_cast<double>(b.x) - a.x) * (y - a.y) - (static_cast<double>(b.y) - a.y) * (x - a.x);
    };
    const auto side_of_line = [&](const GridPoint& p) {
      return (lines.to_x[i] - lines.from_x[i]) * (p.y - lines.from_y[i]) -
             (lines.to_y[i] - lines.from_y[i]) * (p.x - lines.from_x[i]);
    };
    return side_of_edge(lines.from_x[i], lines.from_y[i]) < 0 && side_of_edge(lines.to_x[i], lines.to_y[i]) > 0 &&
           (side_of_line(a) < 0) != (side_of_line(b) < 0);
  }

  const Tin& tin_;
  double drop_;  ///< grid units of drop a squared grid unit
  double sag_;
  Tessellation tessellation_;
  std::vector<BoundaryEdge> boundary_;  ///< with curtains only
  Device device_;
  EmbreeScene scene_;
};

Scene::Scene(const Tin& tin, const Earth& earth, NoData nodata, double ceiling)
    : impl_(std::make_unique<Impl>(tin, earth, nodata, ceiling)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

unsigned Scene::hidden(const SightLines& lines) const {
  return impl_->hidden(lines);
}
double Scene::error_bound(double length) const {
  return impl_->error_bound(length);
}
double Scene::lateral_error_bound(double length) const {
  return impl_->lateral_error_bound(length);
}

}  // namespace itin::viewshed
