#include "scene/rays/embree.hpp"

#include <algorithm>
#include <cmath>
#include <new>

namespace itin::viewshed {

EmbreeScene::EmbreeScene() : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::bad_alloc();
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
}

Geometry EmbreeScene::triangles(const std::vector<float>& vertices, const std::vector<std::uint32_t>& indices,
                                void* owner) {
  Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* const v = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size() / 3));
  auto* const t = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), indices.size() / 3));
  if (!v || !t) throw std::bad_alloc();
  std::copy(vertices.begin(), vertices.end(), v);
  std::copy(indices.begin(), indices.end(), t);
  rtcSetGeometryUserData(geometry.get(), owner);
  return geometry;
}

void EmbreeScene::attach(const Geometry& geometry) {
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
}

void EmbreeScene::commit() {
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
}

void RayFrame::cast(const SightLines& lines, unsigned active, RTCRay16& rays,
                    std::array<int, SightLines::kSize>& valid) const {
  for (unsigned i = 0; i < SightLines::kSize; ++i) {
    const double fx = lines.from_x[i] - centre.x, fy = lines.from_y[i] - centre.y;
    const double tx = lines.to_x[i] - centre.x, ty = lines.to_y[i] - centre.y;
    const double fz = lines.from_z[i] - centre.z - drop * (fx * fx + fy * fy);
    const double tz = lines.to_z[i] - centre.z - drop * (tx * tx + ty * ty);
    const double length = std::sqrt((tx - fx) * (tx - fx) + (ty - fy) * (ty - fy) + (tz - fz) * (tz - fz));
    const double up = raise + raise_per_length * length;
    rays.org_x[i] = static_cast<float>(fx);
    rays.org_y[i] = static_cast<float>(fy);
    rays.org_z[i] = static_cast<float>(fz + up);
    // The direction is taken from the rounded origin, so that the other end is where it should be.
    rays.dir_x[i] = static_cast<float>(tx - static_cast<double>(rays.org_x[i]));
    rays.dir_y[i] = static_cast<float>(ty - static_cast<double>(rays.org_y[i]));
    rays.dir_z[i] = static_cast<float>(tz + up - static_cast<double>(rays.org_z[i]));
    rays.tnear[i] = 0;
    rays.tfar[i] = 1;
    rays.time[i] = 0;
    rays.mask[i] = 0xffffffff;
    rays.id[i] = i;
    rays.flags[i] = 0;
    valid[i] = (active >> i & 1) != 0 ? -1 : 0;
  }
}

void occluded(RTCScene scene, const std::array<int, SightLines::kSize>& valid, RayContext& context, RTCRay16& rays) {
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

}  // namespace itin::viewshed
