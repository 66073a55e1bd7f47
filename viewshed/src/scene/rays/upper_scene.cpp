#include "scene/rays/upper_scene.hpp"

#include <algorithm>
#include <tuple>

#include "scene/rays/embree.hpp"
#include "scene/rays/walls.hpp"

namespace itin::viewshed {

namespace {

/// A place where a line goes beneath the surface, or comes out.
struct Event {
  double along;
  bool enters;
  std::uint32_t piece;  ///< which piece of the surface
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

/// Joins events into stretches, piece by piece: each piece is one sheet, so that lines go beneath it and come out by
/// turns. An event that is missed on one side of a crossing is made up for: an end without a start begins at the
/// crossing before.
void join(std::vector<Event>& events, bool starts_under, bool ends_under, std::vector<Stretch>& stretches) {
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    return std::tuple(a.piece, a.along, !a.enters) < std::tuple(b.piece, b.along, !b.enters);
  });
  stretches.clear();
  // The line may run beneath some piece from end to end, without a crossing.
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
  Impl(const Tin& tin, std::vector<std::uint32_t> pieces, double drift, const Earth& earth)
      : tin_(tin), pieces_(std::move(pieces)), boundary_(boundary_edges(tin)) {
    const double drop = earth.drop_coefficient() * tin.grid.resolution;
    Tessellation tessellation = tessellate(tin, drop);
    const double sag = drop == 0 ? 0 : kSag;
    frame_ = {tessellation.centre, drop, -(sag / tin.grid.resolution + rounding_error(tessellation.half_height, 0)),
              -kRounding * kRoundings};
    attach<&Impl::of_surface>(tessellation.vertices, tessellation.indices);
    const Barrier walls = walls_under(tin, boundary_, tessellation, drop);
    attach<&Impl::of_wall>(walls.vertices, walls.indices);
    if (drift > 0) {
      const Barrier boxes = boxes_about(tin, boundary_, tessellation, drop, 2 * drift);
      attach<&Impl::of_box>(boxes.vertices, boxes.indices);
    }
    parents_ = std::move(tessellation.parents);
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

  /// A line goes beneath a piece of the surface, or comes out.
  struct Crossing {
    std::size_t piece;
    bool enters;
  };
  /// What hit `i`, of one line of the packet, means.
  using CrossingOf = Crossing (Impl::*)(const RTCFilterFunctionNArguments* arguments, const PacketContext& packet,
                                        unsigned line, unsigned i) const;

  /// Records crossings where the packet collects them, and otherwise keeps the hit.
  template <CrossingOf crossing_of>
  void attach(const std::vector<float>& vertices, const std::vector<std::uint32_t>& indices) {
    if (indices.empty()) return;
    const Geometry geometry = embree_.triangles(vertices, indices, this);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), [](const RTCFilterFunctionNArguments* arguments) {
      const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
      filter(arguments, [&](PacketContext& packet, unsigned line, unsigned i) {
        if (packet.events == nullptr) return true;
        const auto [piece, enters] = (self.*crossing_of)(arguments, packet, line, i);
        (*packet.events)[line].push_back(
            {RTCRayN_tfar(arguments->ray, arguments->N, i), enters, static_cast<std::uint32_t>(piece)});
        return false;
      });
    });
    embree_.attach(geometry);
  }

  Crossing of_surface(const RTCFilterFunctionNArguments* arguments, const PacketContext&, unsigned, unsigned i) const {
    const std::uint32_t part = RTCHitN_primID(arguments->hit, arguments->N, i);
    return {piece_of(parents_.empty() ? part : parents_[part]), goes_beneath(arguments, i)};
  }

  Crossing of_wall(const RTCFilterFunctionNArguments* arguments, const PacketContext& packet, unsigned line,
                   unsigned i) const {
    const std::size_t edge = RTCHitN_primID(arguments->hit, arguments->N, i) / kTrianglesPerWall;
    return {piece_of(boundary_[edge].triangle), goes_inside(*packet.lines, line, outwards(edge, BoxFace::kRight))};
  }

  /// Every box is a piece of its own, after those of the surface.
  Crossing of_box(const RTCFilterFunctionNArguments* arguments, const PacketContext& packet, unsigned line,
                  unsigned i) const {
    const std::uint32_t part = RTCHitN_primID(arguments->hit, arguments->N, i);
    const std::size_t edge = part / kTrianglesPerBox;
    const auto face = static_cast<BoxFace>(part % kTrianglesPerBox / 2);
    return {pieces_.size() + 1 + edge, face == BoxFace::kTop ? goes_beneath(arguments, i)
                                                             : goes_inside(*packet.lines, line, outwards(edge, face))};
  }

  std::size_t piece_of(std::uint32_t triangle) const {
    return static_cast<std::size_t>(std::upper_bound(pieces_.begin(), pieces_.end(), triangle) - pieces_.begin());
  }

  /// Whether a line goes beneath the triangle that it hits, whose outer side is the upper one, whichever way Embree's
  /// normals point.
  static bool goes_beneath(const RTCFilterFunctionNArguments* arguments, unsigned i) {
    RTCRayN* const ray = arguments->ray;
    RTCHitN* const hit = arguments->hit;
    const unsigned n = arguments->N;
    const float nz = RTCHitN_Ng_z(hit, n, i);
    const float along = RTCRayN_dir_x(ray, n, i) * RTCHitN_Ng_x(hit, n, i) +
                        RTCRayN_dir_y(ray, n, i) * RTCHitN_Ng_y(hit, n, i) + RTCRayN_dir_z(ray, n, i) * nz;
    return nz >= 0 ? along <= 0 : along >= 0;
  }
  /// Whether a line goes through an upright face to the inside.
  static bool goes_inside(const SightLines& lines, unsigned line, Point2 outwards) {
    const double dx = lines.to_x[line] - lines.from_x[line], dy = lines.to_y[line] - lines.from_y[line];
    return dx * outwards.x + dy * outwards.y <= 0;
  }
  /// The direction to the outside of an upright face.
  Point2 outwards(std::size_t edge, BoxFace face) const {
    const GridPoint &a = tin_.vertices[boundary_[edge].from], &b = tin_.vertices[boundary_[edge].to];
    const Point2 ahead{static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y};
    if (face == BoxFace::kRight) return {ahead.y, -ahead.x};
    if (face == BoxFace::kLeft) return {-ahead.y, ahead.x};
    return face == BoxFace::kAhead ? ahead : Point2{-ahead.x, -ahead.y};
  }

  const Tin& tin_;
  std::vector<std::uint32_t> pieces_;
  std::vector<std::uint32_t> parents_;  ///< for each piece of a triangle the one it is cut from; empty when none was
  std::vector<BoundaryEdge> boundary_;
  RayFrame frame_;
  EmbreeScene embree_;
};

UpperScene::UpperScene(const Tin& tin, std::vector<std::uint32_t> pieces, double drift, const Earth& earth)
    : impl_(std::make_unique<Impl>(tin, std::move(pieces), drift, earth)) {}
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
