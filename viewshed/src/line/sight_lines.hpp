// A packet of sight lines: what scenes decide at a time.
#pragma once

#include <array>

#include <itin/geometry.hpp>

namespace itin::viewshed {

/// The ends of a packet's lines, in grid units (heights too).
struct SightLines {
  static constexpr unsigned kSize = 16;
  alignas(64) std::array<double, kSize> from_x{}, from_y{}, from_z{};
  alignas(64) std::array<double, kSize> to_x{}, to_y{}, to_z{};
  unsigned active = 0;  ///< one bit per line; ends of active lines differ horizontally

  /// Lets all lines start at one eye.
  void start_at(const Point3& eye) {
    from_x.fill(eye.x);
    from_y.fill(eye.y);
    from_z.fill(eye.z);
  }
};

/// Packets are four by four cells: the closer together, the fewer boxes of a scene they meet.
inline constexpr unsigned kPacketSide = 4;
static_assert(kPacketSide * kPacketSide == SightLines::kSize);

}  // namespace itin::viewshed
