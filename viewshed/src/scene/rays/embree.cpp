#include "scene/rays/embree.hpp"

#include <new>

namespace itin::viewshed {

void cast_packet(RTCScene scene, const std::array<int, SightLines::kSize>& valid, RayContext& context, RTCRay16& rays) {
#if ITIN_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&context);
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  arguments.context = &context;
  rtcOccluded16(valid.data(), scene, &rays, &arguments);
#else
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid.data(), scene, &context, &rays);
#endif
}

BoxTree::BoxTree(std::uint32_t boxes, void* owner, const Functions& functions) : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::bad_alloc();
  scene_.reset(rtcNewScene(device_.get()));
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, boxes);
  rtcSetGeometryUserData(geometry, owner);
  rtcSetGeometryBoundsFunction(geometry, functions.bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, functions.occluded);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  // A better tree takes longer to make than it saves, even with hundreds of lines to a box: most of a line's time is
  // spent on exact tests, whose number the tree does not change.
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
}

}  // namespace itin::viewshed
