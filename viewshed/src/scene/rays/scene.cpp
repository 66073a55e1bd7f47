#include "scene/rays/scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "line/set_bits.hpp"
#include "line/sight_line.hpp"
#include "scene/rays/embree.hpp"
#include "scene/rays/ray_sieve.hpp"

namespace itin::viewshed {

namespace {

constexpr double kRounding = 0x1p-24;
/// How many roundings the boxes allow for, and the sieve within them.
constexpr double kRoundingsOfBoxes = 16, kRoundingsOfSieve = 64;

/// What the callbacks see of a packet; Embree hands back the pointer to the first member.
class Packet {
 public:
  Packet(const SightLines& of_lines, double drop, double grazing) : lines(of_lines), drop_(drop), grazing_(grazing) {}

  /// Line `i` in double precision.
  const SightLine& exact(unsigned i) {
    std::optional<SightLine>& line = exact_[i];
    if (!line)
      line.emplace(Point3{lines.from_x[i], lines.from_y[i], lines.from_z[i]},
                   Point3{lines.to_x[i], lines.to_y[i], lines.to_z[i]}, drop_, grazing_);
    return *line;
  }

  RayContext context;
  const SightLines& lines;
  std::array<std::uint32_t, SightLines::kSize> by{};  ///< triangles that hide a line
  unsigned hidden = 0;                                ///< one bit per line
  Scene::Stretches* stretches = nullptr;              ///< gets all parts that are hidden, where they are asked for

 private:
  double drop_, grazing_;
  std::array<std::optional<SightLine>, SightLines::kSize> exact_;
};

}  // namespace

class Scene::Impl {
 public:
  Impl(const Tin& tin, const Earth& earth, double grazing, Instructions instructions)
      : tin_(tin),
        drop_(earth.drop_coefficient() * tin.grid.resolution),
        grazing_(grazing / tin.grid.resolution),
        centre_(centre_of(tin)),
        sieve_(ray_sieve(instructions)) {
    measure();
    tree_.emplace(static_cast<std::uint32_t>(tin.triangles.size()), this, BoxTree::Functions{bounds, meet});
  }

  unsigned hidden(const SightLines& lines) const {
    Packet packet(lines, drop_, grazing_);
    cast(lines.active, packet);
    return packet.hidden;
  }

  unsigned hidden_together(const SightLines& lines, Occluder& occluder) const {
    if (drop_ < 0) return 0;
    Packet packet(lines, drop_, grazing_);
    unsigned result = 0, open = lines.active;
    const auto hide_group = [&](unsigned group, std::uint32_t triangle) {
      const unsigned four = 0xfU << 4 * group;
      if ((open & four) == 0) return;
      for (unsigned i = 4 * group; i < 4 * group + 4; ++i)
        if (!hides(packet.exact(i), triangle)) return;
      result |= 1U << group;
      open &= ~four;
      occluder.triangle = triangle;
    };
    if (const auto last = occluder.triangle)
      for (unsigned group = 0; group < SightLines::kSize / 4; ++group) hide_group(group, *last);
    if (open == 0) return result;
    cast(open, packet);
    for (unsigned i = 0; i < SightLines::kSize; ++i)
      if ((packet.hidden >> i / 4 * 4 & 0xfU) == 0xfU) hide_group(i / 4, packet.by[i]);
    return result;
  }

  void find_hidden(const SightLines& lines, Stretches& result) const {
    for (std::vector<Stretch>& stretches : result) stretches.clear();
    Packet packet(lines, drop_, grazing_);
    packet.stretches = &result;
    cast(lines.active, packet);
  }

 private:
  static Point3 centre_of(const Tin& tin) {
    const Box box = tin.bounds();
    if (tin.vertices.empty()) return {};
    const auto [low, high] = std::minmax_element(tin.vertices.begin(), tin.vertices.end(),
                                                 [](const GridPoint& a, const GridPoint& b) { return a.z < b.z; });
    const Point2 middle{(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
    return {std::round((middle.x - tin.grid.origin.x) / tin.grid.resolution),
            std::round((middle.y - tin.grid.origin.y) / tin.grid.resolution),
            std::round((double{1} * low->z + high->z) / 2)};
  }

  /// A place about the centre, lowered by the Earth's curvature.
  Point3 about_centre(double x, double y, double z) const {
    x -= centre_.x, y -= centre_.y;
    return {x, y, z - centre_.z - drop_ * (x * x + y * y)};
  }
  Point3 about_centre(const GridPoint& p) const { return about_centre(p.x, p.y, p.z); }

  void measure() {
    double height = 0, lowest = 0;
    for (const GridPoint& v : tin_.vertices) {
      const Point3 p = about_centre(v);
      lowest = std::min(lowest, p.z);
      half_width_ = std::max({half_width_, std::abs(p.x), std::abs(p.y)});
      height = std::max(height, std::abs(p.z));
    }
    corners_.reserve(tin_.triangles.size());
    for (const Triangle& t : tin_.triangles)
      height = std::max(height, double{1} * corners_.emplace_back(corners_of(t)).bulge);
    top_ = 2 * height + 1;
    half_width_ += 1;
    margin_ = static_cast<float>(kRoundingsOfBoxes * kRounding * half_width_);
    bounds_.place = static_cast<float>(kRoundingsOfSieve * kRounding * half_width_);
    bounds_.height = static_cast<float>(kRoundingsOfSieve * kRounding * top_);
    bounds_.rounding = static_cast<float>(kRoundingsOfSieve * kRounding);
    bounds_.grazing = static_cast<float>(grazing_);
    bounds_.floor = static_cast<float>(lowest - 1) - bounds_.height;
    bounds_.finds_hidden = drop_ >= 0;
  }

  SieveCorners corners_of(const Triangle& triangle) const {
    SieveCorners result;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const GridPoint &a = tin_.vertices[triangle[k]], &b = tin_.vertices[triangle[k == 2 ? 0 : k + 1]];
      const Point3 p = about_centre(a);
      result.x[k] = static_cast<float>(p.x), result.y[k] = static_cast<float>(p.y);
      result.z[k] = static_cast<float>(p.z);
      const double dx = double{1} * b.x - a.x, dy = double{1} * b.y - a.y;
      longest = std::max(longest, dx * dx + dy * dy);
    }
    result.bulge = static_cast<float>(std::max(drop_, 0.0) * longest * (1.0 / 3 + 1e-6));
    return result;
  }

  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
    const SieveCorners& at = self.corners_[arguments->primID];
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = std::min({at.x[0], at.x[1], at.x[2]}) - self.margin_;
    box.upper_x = std::max({at.x[0], at.x[1], at.x[2]}) + self.margin_;
    box.lower_y = std::min({at.y[0], at.y[1], at.y[2]}) - self.margin_;
    box.upper_y = std::max({at.y[0], at.y[1], at.y[2]}) + self.margin_;
    box.lower_z = self.bounds_.floor - self.bounds_.height;
    box.upper_z = std::max({at.z[0], at.z[1], at.z[2]}) + at.bulge;
  }

  static void meet(const RTCOccludedFunctionNArguments* arguments) {
    const auto& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
    self.ask(arguments->primID, *reinterpret_cast<Packet*>(arguments->context), *arguments);
  }

  /// Asks of each ray near a triangle whether that hides its line; it then has ended.
  void ask(std::uint32_t triangle, Packet& packet, const RTCOccludedFunctionNArguments& arguments) const {
    const SiftedRays sifted = sieve_(arguments, corners_[triangle], bounds_);
    for_each_bit(sifted.near, [&](unsigned ray) {
      const unsigned line = RTCRayN_id(arguments.ray, arguments.N, ray);
      if (packet.stretches != nullptr) return add_stretch(packet.exact(line), triangle, (*packet.stretches)[line]);
      if ((sifted.hidden >> ray & 1U) == 0 && !hides(packet.exact(line), triangle)) return;
      packet.hidden |= 1U << line;
      packet.by[line] = triangle;
      RTCRayN_tfar(arguments.ray, arguments.N, ray) = -std::numeric_limits<float>::infinity();
    });
  }

  bool hides(const SightLine& line, std::uint32_t triangle) const {
    const Triangle& t = tin_.triangles[triangle];
    return line.hidden_by(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
  }

  void add_stretch(const SightLine& line, std::uint32_t triangle, std::vector<Stretch>& stretches) const {
    if (!hides(line, triangle)) return;
    const Triangle& t = tin_.triangles[triangle];
    const auto over = line.ground_over(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
    if (over) stretches.push_back({over->from, over->to});
  }

  void cast(unsigned active, Packet& packet) const {
    alignas(64) RTCRay16 rays;
    alignas(64) std::array<int, SightLines::kSize> valid;
    unsigned any = 0;
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      valid[i] = (active >> i & 1) != 0 && aim(packet.lines, i, rays) ? -1 : 0;
      any |= static_cast<unsigned>(valid[i]);
    }
    if (any != 0) tree_->cast(valid, packet.context, rays);
  }

  /// Makes ray `i` of the part of line `i` that lies about the surface. Returns whether there is any.
  bool aim(const SightLines& lines, unsigned i, RTCRay16& rays) const {
    const Point3 from = about_centre(lines.from_x[i], lines.from_y[i], lines.from_z[i]);
    const Point3 to = about_centre(lines.to_x[i], lines.to_y[i], lines.to_z[i]);
    const Point3 along{to.x - from.x, to.y - from.y, to.z - from.z};
    double first = 0, last = 1;
    // Keeps the part where a coordinate is below `most`; half a grid unit is far more than doubles are off.
    const auto keep = [&](double start, double step, double most) {
      const double beyond = start - most;
      if (step == 0) {
        if (beyond > 0) last = -1;
      } else if (step > 0) {
        last = std::min(last, -beyond / step);
      } else {
        first = std::max(first, beyond / -step);
      }
    };
    keep(from.x, along.x, half_width_), keep(-from.x, -along.x, half_width_);
    keep(from.y, along.y, half_width_), keep(-from.y, -along.y, half_width_);
    keep(from.z, along.z, top_);
    if (first > last) return false;
    const auto at = [&](double start, double step, double s) { return start + s * step; };
    double first_z = at(from.z, along.z, first), last_z = at(from.z, along.z, last);
    const double lower = kRoundingsOfBoxes * kRounding * (top_ + std::abs(first_z) + std::abs(last_z));
    first_z -= lower, last_z -= lower;
    if (std::min(first_z, last_z) < bounds_.floor) first_z = last_z = bounds_.floor;
    rays.org_x[i] = static_cast<float>(at(from.x, along.x, first));
    rays.org_y[i] = static_cast<float>(at(from.y, along.y, first));
    rays.org_z[i] = static_cast<float>(first_z);
    // The direction is taken from the rounded origin, so that the other end is where it should be.
    rays.dir_x[i] = static_cast<float>(at(from.x, along.x, last) - double{1} * rays.org_x[i]);
    rays.dir_y[i] = static_cast<float>(at(from.y, along.y, last) - double{1} * rays.org_y[i]);
    rays.dir_z[i] = static_cast<float>(last_z - double{1} * rays.org_z[i]);
    rays.tnear[i] = 0;
    rays.tfar[i] = 1;
    rays.time[i] = 0;
    rays.mask[i] = 0xffffffff;
    rays.id[i] = i;
    rays.flags[i] = 0;
    return true;
  }

  const Tin& tin_;
  double drop_;     ///< grid units of drop per squared grid unit
  double grazing_;  ///< grid units
  Point3 centre_;
  // In grid units about the centre: what all the surface is within, and by how much boxes are wider than triangles.
  double half_width_ = 0, top_ = 0;
  float margin_ = 0;
  SieveBounds bounds_;  ///< their floor is below all of the surface; no ray goes below it
  RaySieve sieve_;
  std::vector<SieveCorners> corners_;  ///< each triangle's
  std::optional<BoxTree> tree_;
};

Scene::Scene(const Tin& tin, const Earth& earth, double grazing, Instructions instructions)
    : impl_(std::make_unique<Impl>(tin, earth, grazing, instructions)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

unsigned Scene::hidden(const SightLines& lines) const {
  return impl_->hidden(lines);
}
unsigned Scene::hidden_together(const SightLines& lines, Occluder& occluder) const {
  return impl_->hidden_together(lines, occluder);
}
void Scene::find_hidden(const SightLines& lines, Stretches& result) const {
  impl_->find_hidden(lines, result);
}

}  // namespace itin::viewshed
