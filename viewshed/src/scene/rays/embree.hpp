// Wraps Embree: a tree of boxes, the packets of rays that are cast at it, and what versions 3 and 4 call differently.
// All tests run with version 3.13. With version 4 only this was checked: embree.cpp and scene.cpp compile against the
// headers of 4.4.1, without a warning.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>

#if ITIN_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "line/sight_lines.hpp"

namespace itin::viewshed {

#if ITIN_EMBREE_MAJOR >= 4
using RayContext = RTCRayQueryContext;
#else
using RayContext = RTCIntersectContext;
#endif

/// Casts the rays of a packet whose `valid` is -1 at a scene. `context` is the first member of what the scene's own
/// functions see.
void cast_packet(RTCScene scene, const std::array<int, SightLines::kSize>& valid, RayContext& context, RTCRay16& rays);

class BoxTree {
 public:
  /// What is called with `owner` as geometryUserPtr: for the bounds of each box, and for the rays that may meet one.
  struct Functions {
    RTCBoundsFunction bounds;
    RTCOccludedFunctionN occluded;
  };
  /// Makes a tree of `boxes` boxes. Throws std::bad_alloc.
  BoxTree(std::uint32_t boxes, void* owner, const Functions& functions);

  void cast(const std::array<int, SightLines::kSize>& valid, RayContext& context, RTCRay16& rays) const {
    cast_packet(scene_.get(), valid, context, rays);
  }

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

}  // namespace itin::viewshed
