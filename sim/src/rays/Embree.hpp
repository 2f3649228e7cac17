#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace ortung::embree {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Scene = std::unique_ptr<RTCSceneTy, Release>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release>;

constexpr unsigned kPacket = 16;  ///< rays that are cast together

inline Device makeDevice() {
  // One thread: worlds are built in milliseconds, and no thread pool is left behind.
  Device device(rtcNewDevice("threads=1"));
  if (!device) throw std::runtime_error("Embree cannot be started");
  return device;
}

inline Scene makeScene(const Device& device) {
  Scene scene(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips through between triangles
  return scene;
}

inline void commit(const Device& device, const Scene& scene) {
  rtcCommitScene(scene.get());
  const RTCError error = rtcGetDeviceError(device.get());
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree cannot build the world, error " + std::to_string(error));
}

inline RTCIntersectContext makeContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

template <class Items>
void fill(const Geometry& geometry, RTCBufferType type, RTCFormat format, const Items& items) {
  void* memory =
      rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, sizeof(items[0]), items.size());
  if (memory == nullptr) throw std::runtime_error("Embree: no memory for the world's geometry");
  std::copy(items.begin(), items.end(), static_cast<typename Items::value_type*>(memory));
}

inline void attach(const Scene& scene, const Geometry& geometry) {
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
}

inline void attachTriangles(const Device& device, const Scene& scene,
                            const std::vector<std::array<float, 3>>& vertices,
                            const std::vector<std::array<std::uint32_t, 3>>& corners) {
  if (corners.empty()) return;
  const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
  fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, corners);
  attach(scene, geometry);
}

}  // namespace ortung::embree
