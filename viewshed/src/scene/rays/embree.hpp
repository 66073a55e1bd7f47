// Wraps Embree: scenes of triangles in single precision, and packets of sight lines as rays.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#if ITIN_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "line/sight_lines.hpp"
#include "scene/rays/tessellation.hpp"

namespace itin::viewshed {

inline constexpr double kRounding = 0x1p-24;
inline constexpr double kRoundings = 16;  ///< how many Embree's edge functions make; see scene.hpp

/// The bound u (4 extent + 16 length).
constexpr double rounding_error(double extent, double length) {
  return kRounding * (4 * extent + kRoundings * length);
}

#if ITIN_EMBREE_MAJOR >= 4
using RayContext = RTCRayQueryContext;
#else
using RayContext = RTCIntersectContext;
#endif

struct GeometryRelease {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, GeometryRelease>;

class EmbreeScene {
 public:
  /// Throws std::bad_alloc.
  EmbreeScene();

  /// Makes a geometry of three floats per vertex and three indices per triangle; filters get `owner` as
  /// geometryUserPtr.
  Geometry triangles(const std::vector<float>& vertices, const std::vector<std::uint32_t>& indices, void* owner);
  void attach(const Geometry& geometry);
  /// Throws std::bad_alloc when Embree ran out of memory.
  void commit();
  RTCScene scene() const { return scene_.get(); }

 private:
  struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease> scene_;
};

/// Turns a packet into rays about `centre`, lowered by the Earth's curvature. Both ends are raised by `raise`, and by
/// `raise_per_length` times the line's length, grid units. `valid` is -1 for the lines of `active`, 0 for the others.
struct RayFrame {
  GridPoint centre;
  double drop = 0;
  double raise = 0;
  double raise_per_length = 0;

  void cast(const SightLines& lines, unsigned active, RTCRay16& rays, std::array<int, SightLines::kSize>& valid) const;
};

/// Finds the rays that something occludes: their tfar becomes negative. `context` is the first member of what filters
/// see.
void occluded(RTCScene scene, const std::array<int, SightLines::kSize>& valid, RayContext& context, RTCRay16& rays);

}  // namespace itin::viewshed
