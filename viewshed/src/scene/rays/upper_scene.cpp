#include "scene/rays/upper_scene.hpp"

#include <algorithm>
#include <tuple>

#include "scene/rays/embree.hpp"
#include "scene/rays/walls.hpp"

namespace itin::viewshed {

namespace {

/// Where a line goes beneath the surface, or comes out.
struct Event {
  double along;
  bool enters;
  std::uint32_t piece;  ///< of the surface
};
using Events = std::array<std::vector<Event>, SightLines::kSize>;

/// The data that the filters see; Embree hands back the pointer to the first member.
struct PacketContext {
  RayContext context;
  const SightLines* lines;
  Events* events = nullptr;  ///< collect every crossing instead of stopping at the first
};

/// Calls take(packet, line, hit number) for each hit; the hit is kept where it returns true.
template <class Take>
void filter(const RTCFilterFunctionNArguments* arguments, const Take& take) {
  auto& packet = *reinterpret_cast<PacketContext*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) continue;
    const unsigned line = RTCRayN_id(arguments->ray, arguments->N, i);
    if (!take(packet, line, i)) arguments->valid[i] = 0;
  }
}

/// Piece by piece: each is one sheet, so that lines go beneath it and come out by turns. Whatever is missed on one side
/// of a crossing is made up for: an end without a start begins at the crossing before.
void join(std::vector<Event>& events, bool starts_under, bool ends_under, std::vector<Stretch>& stretches) {
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    return std::tuple(a.piece, a.along, !a.enters) < std::tuple(b.piece, b.along, !b.enters);
  });
  stretches.clear();
  // Beneath some piece from end to end, perhaps, without a crossing.
  if (starts_under && ends_under) stretches.push_back({0, 1});
  if (starts_under) stretches.push_back({0, 0});
  if (ends_under) stretches.push_back({1, 1});
  for (auto event = events.begin(); event != events.end();) {
    const std::uint32_t piece = event->piece;
    bool under = false;
    double since = 0;
    for (; event != events.end() && event->piece == piece; ++event) {
      if (!event->enters) stretches.push_back({since, event->along});
      if (!event->enters || !under) since = event->along;
      under = event->enters;
    }
    if (under) stretches.push_back({since, 1});
  }
}

}  // namespace

class UpperScene::Impl {
 public:
  Impl(const Tin& tin, std::vector<std::uint32_t> pieces, const Earth& earth)
      : tin_(tin), pieces_(std::move(pieces)), boundary_(boundary_edges(tin)) {
    const double drop = earth.drop_coefficient() * tin.grid.resolution;
    Tessellation tessellation = tessellate(tin, drop);
    const double sag = drop == 0 ? 0 : kSag;
    frame_ = {tessellation.centre, drop, -(sag / tin.grid.resolution + rounding_error(tessellation.half_height, 0)),
              -kRounding * kRoundings};
    attach_surface(tessellation);
    parents_ = std::move(tessellation.parents);
    attach_walls(walls_under(tin, boundary_, tessellation, drop));
    embree_.commit();
  }

  unsigned touched(const SightLines& lines) const {
    PacketContext packet;
    return cast(lines, packet);
  }

  void find_stretches(const SightLines& lines, unsigned starts_under, unsigned ends_under, Stretches& result) const {
    Events events;
    PacketContext packet;
    packet.events = &events;
    cast(lines, packet);
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      if ((lines.active >> i & 1) == 0) continue;
      join(events[i], (starts_under >> i & 1) != 0, (ends_under >> i & 1) != 0, result[i]);
    }
  }
  double error_bound(double length) const { return -(frame_.raise + frame_.raise_per_length * length); }

 private:
  unsigned cast(const SightLines& lines, PacketContext& packet) const {
    if (lines.active == 0) return 0;
    alignas(64) RTCRay16 rays;
    alignas(64) std::array<int, SightLines::kSize> valid;
    frame_.cast(lines, lines.active, rays, valid);
    packet.lines = &lines;
    occluded(embree_.scene(), valid, packet.context, rays);
    unsigned result = 0;
    for (unsigned i = 0; i < SightLines::kSize; ++i)
      result |= static_cast<unsigned>(valid[i] != 0 && rays.tfar[i] < 0) << i;
    return result;
  }

  /// `triangle` of the Tin.
  bool collect(const RTCFilterFunctionNArguments* arguments, PacketContext& packet, unsigned line, unsigned i,
               std::uint32_t triangle, bool enters) const {
    if (packet.events == nullptr) return true;
    const auto piece = std::upper_bound(pieces_.begin(), pieces_.end(), triangle) - pieces_.begin();
    (*packet.events)[line].push_back(
        {RTCRayN_tfar(arguments->ray, arguments->N, i), enters, static_cast<std::uint32_t>(piece)});
    return false;
  }

  void attach_surface(const Tessellation& tessellation) {
    const Geometry geometry = embree_.triangles(tessellation.vertices, tessellation.indices, this);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), [](const RTCFilterFunctionNArguments* arguments) {
      const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
      filter(arguments, [&](PacketContext& packet, unsigned line, unsigned i) {
        RTCRayN* const ray = arguments->ray;
        RTCHitN* const hit = arguments->hit;
        const unsigned n = arguments->N;
        const float nz = RTCHitN_Ng_z(hit, n, i);
        const float along = RTCRayN_dir_x(ray, n, i) * RTCHitN_Ng_x(hit, n, i) +
                            RTCRayN_dir_y(ray, n, i) * RTCHitN_Ng_y(hit, n, i) + RTCRayN_dir_z(ray, n, i) * nz;
        // The surface's upper side is the outer one, whichever way Embree's normals point.
        const std::uint32_t part = RTCHitN_primID(hit, n, i);
        const std::uint32_t triangle = self.parents_.empty() ? part : self.parents_[part];
        return self.collect(arguments, packet, line, i, triangle, nz >= 0 ? along <= 0 : along >= 0);
      });
    });
    embree_.attach(geometry);
  }

  void attach_walls(const Walls& walls) {
    if (walls.indices.empty()) return;
    const Geometry geometry = embree_.triangles(walls.vertices, walls.indices, this);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), [](const RTCFilterFunctionNArguments* arguments) {
      const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
      filter(arguments, [&](PacketContext& packet, unsigned line, unsigned i) {
        const BoundaryEdge& edge = self.boundary_[RTCHitN_primID(arguments->hit, arguments->N, i) / 2];
        const GridPoint &a = self.tin_.vertices[edge.from], &b = self.tin_.vertices[edge.to];
        const SightLines& l = *packet.lines;
        const double outwards = (l.to_x[line] - l.from_x[line]) * (static_cast<double>(b.y) - a.y) -
                                (l.to_y[line] - l.from_y[line]) * (static_cast<double>(b.x) - a.x);
        return self.collect(arguments, packet, line, i, edge.triangle, outwards <= 0);
      });
    });
    embree_.attach(geometry);
  }

  const Tin& tin_;
  std::vector<std::uint32_t> pieces_;
  std::vector<std::uint32_t> parents_;  ///< of the pieces of cut triangles
  std::vector<BoundaryEdge> boundary_;
  RayFrame frame_;
  EmbreeScene embree_;
};

UpperScene::UpperScene(const Tin& tin, std::vector<std::uint32_t> pieces, const Earth& earth)
    : impl_(std::make_unique<Impl>(tin, std::move(pieces), earth)) {}
UpperScene::UpperScene(UpperScene&&) noexcept = default;
UpperScene& UpperScene::operator=(UpperScene&&) noexcept = default;
UpperScene::~UpperScene() = default;

unsigned UpperScene::touched(const SightLines& lines) const {
  return impl_->touched(lines);
}
void UpperScene::find_stretches(const SightLines& lines, unsigned starts_under, unsigned ends_under,
                                Stretches& result) const {
  impl_->find_stretches(lines, starts_under, ends_under, result);
}
double UpperScene::error_bound(double length) const {
  return impl_->error_bound(length);
}

}  // namespace itin::viewshed
