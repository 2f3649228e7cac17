#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "RayCaster.hpp"

namespace ortung {
namespace {

constexpr std::size_t kPacket = 16;

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Scene = std::unique_ptr<RTCSceneTy, Release>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release>;

/// What the filter below gets to know of a ray; Embree hands back the pointer to `base`.
struct Context {
  RTCIntersectContext base;
  RobotNumber ignore;
};

Context makeContext(RobotNumber ignore) {
  Context context;
  rtcInitIntersectContext(&context.base);
  context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  context.ignore = ignore;
  return context;
}

// Takes back hits of the robot that the rays come from.
void ignoreOwnBody(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const Context*>(args->context);
  const auto* numbers = static_cast<const std::vector<RobotNumber>*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    if ((*numbers)[RTCHitN_primID(args->hit, args->N, i)] == context->ignore) args->valid[i] = 0;
  }
}

void* buffer(const Geometry& geometry, RTCBufferType type, RTCFormat format, std::size_t bytes,
             std::size_t count) {
  void* memory = rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, bytes, count);
  if (memory == nullptr) throw std::runtime_error("Embree: no memory for the world's geometry");
  return memory;
}

Geometry makeTriangles(RTCDevice device, const Mesh& mesh) {
  Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertices = static_cast<std::array<float, 3>*>(buffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  std::copy(mesh.vertices.begin(), mesh.vertices.end(), vertices);
  auto* indices = static_cast<std::array<std::uint32_t, 3>*>(
      buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
             mesh.triangles.size()));
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), indices);
  return geometry;
}

// A cylinder is a cone curve of one segment, which Embree meets exactly, not as a polygon.
Geometry makeCylinders(RTCDevice device, const Point2& middle, const std::vector<Cylinder>& cylinders) {
  Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE));
  auto* ends = static_cast<std::array<float, 4>*>(buffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 2 * cylinders.size()));
  auto* segments = static_cast<std::uint32_t*>(buffer(
      geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, sizeof(std::uint32_t), cylinders.size()));
  for (std::size_t i = 0; i < cylinders.size(); ++i) {
    const Cylinder& c = cylinders[i];
    const auto x = static_cast<float>(c.centre.x - middle.x);
    const auto y = static_cast<float>(c.centre.y - middle.y);
    const auto radius = static_cast<float>(c.radius);
    ends[2 * i] = {x, y, static_cast<float>(c.zLow), radius};
    ends[2 * i + 1] = {x, y, static_cast<float>(c.zHigh), radius};
    segments[i] = static_cast<std::uint32_t>(2 * i);
  }
  return geometry;
}

void attach(RTCScene scene, const Geometry& geometry) {
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene, geometry.get());
}

}  // namespace

struct RayCaster::Scenes {
  Device device;
  Point2 middle;
  Scene walls;
  Scene robots;                      ///< null while there are none
  std::vector<RobotNumber> numbers;  ///< of the robots' cylinders

  Scene makeScene() const {
    Scene scene(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips through between triangles
    return scene;
  }
  void commit(const Scene& scene) const {
    rtcCommitScene(scene.get());
    const RTCError error = rtcGetDeviceError(device.get());
    if (error != RTC_ERROR_NONE)
      throw std::runtime_error("Embree cannot build the world, error " + std::to_string(error));
  }
  /// Whether there are robots that rays of @p ignore can hit.
  bool hasOthers(RobotNumber ignore) const {
    return robots && !(numbers.size() == 1 && numbers[0] == ignore);
  }
};

RayCaster::RayCaster(const Mesh& mesh) : scenes_(std::make_unique<Scenes>()) {
  // One thread: worlds build in milliseconds, and no pool of threads stays behind.
  scenes_->device.reset(rtcNewDevice("threads=1"));
  if (!scenes_->device) throw std::runtime_error("Embree cannot be started");
  scenes_->middle = mesh.middle;
  scenes_->walls = scenes_->makeScene();
  if (!mesh.triangles.empty())
    attach(scenes_->walls.get(), makeTriangles(scenes_->device.get(), mesh));
  if (!mesh.cylinders.empty())
    attach(scenes_->walls.get(), makeCylinders(scenes_->device.get(), mesh.middle, mesh.cylinders));
  scenes_->commit(scenes_->walls);
}

RayCaster::~RayCaster() = default;

void RayCaster::setRobots(const std::vector<RobotBody>& robots) {
  scenes_->robots.reset();
  scenes_->numbers.clear();
  if (robots.empty()) return;
  std::vector<Cylinder> cylinders;
  for (const RobotBody& robot : robots) {
    cylinders.push_back(robot.cylinder);
    scenes_->numbers.push_back(robot.number);
  }
  const Geometry geometry = makeCylinders(scenes_->device.get(), scenes_->middle, cylinders);
  rtcSetGeometryUserData(geometry.get(), &scenes_->numbers);
  rtcSetGeometryIntersectFilterFunction(geometry.get(), ignoreOwnBody);
  rtcSetGeometryOccludedFilterFunction(geometry.get(), ignoreOwnBody);
  Scene scene = scenes_->makeScene();
  attach(scene.get(), geometry);
  scenes_->commit(scene);
  scenes_->robots = std::move(scene);
}

void RayCaster::castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const {
  const auto x = static_cast<float>(fan.x - scenes_->middle.x);
  const auto y = static_cast<float>(fan.y - scenes_->middle.y);
  const double level = std::cos(fan.elevation);
  const auto rise = static_cast<float>(std::sin(fan.elevation));
  const bool withRobots = scenes_->hasOthers(ignore);
  Context context = makeContext(ignore);

  // The angles within a packet are the same in all packets, so only its first ray needs sin and cos.
  std::array<double, kPacket> cosines;
  std::array<double, kPacket> sines;
  for (std::size_t i = 0; i < kPacket; ++i) {
    cosines[i] = level * std::cos(static_cast<double>(i) * fan.angleStep);
    sines[i] = level * std::sin(static_cast<double>(i) * fan.angleStep);
  }
  alignas(64) std::array<int, kPacket> valid;
  alignas(64) RTCRayHit16 packet;
  for (std::size_t first = 0; first < ranges.size(); first += kPacket) {
    const std::size_t n = std::min(kPacket, ranges.size() - first);
    const double angle = fan.firstAngle + static_cast<double>(first) * fan.angleStep;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (std::size_t i = 0; i < kPacket; ++i) {
      valid[i] = i < n ? -1 : 0;
      packet.ray.org_x[i] = x;
      packet.ray.org_y[i] = y;
      packet.ray.org_z[i] = static_cast<float>(fan.z);
      packet.ray.dir_x[i] = static_cast<float>(c * cosines[i] - s * sines[i]);
      packet.ray.dir_y[i] = static_cast<float>(s * cosines[i] + c * sines[i]);
      packet.ray.dir_z[i] = rise;
      packet.ray.tnear[i] = 0.0f;
      packet.ray.tfar[i] = static_cast<float>(fan.maxRange);
      packet.ray.time[i] = 0.0f;
      packet.ray.mask[i] = ~0u;
      packet.ray.id[i] = 0;
      packet.ray.flags[i] = 0;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid.data(), scenes_->walls.get(), &context.base, &packet);
    if (withRobots) rtcIntersect16(valid.data(), scenes_->robots.get(), &context.base, &packet);
    std::copy_n(packet.ray.tfar, n, ranges.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

bool RayCaster::isBlocked(const std::array<double, 3>& from, const std::array<double, 3>& direction,
                          double stop, RobotNumber ignore) const {
  RTCRay ray{};
  ray.org_x = static_cast<float>(from[0] - scenes_->middle.x);
  ray.org_y = static_cast<float>(from[1] - scenes_->middle.y);
  ray.org_z = static_cast<float>(from[2]);
  ray.dir_x = static_cast<float>(direction[0]);
  ray.dir_y = static_cast<float>(direction[1]);
  ray.dir_z = static_cast<float>(direction[2]);
  ray.tfar = static_cast<float>(stop);
  ray.mask = ~0u;
  Context context = makeContext(ignore);
  rtcOccluded1(scenes_->walls.get(), &context.base, &ray);
  const auto met = [&] { return ray.tfar < 0.0f; };  // Embree says so by -infinity
  if (!met() && scenes_->hasOthers(ignore))
    rtcOccluded1(scenes_->robots.get(), &context.base, &ray);
  return met();
}

}  // namespace ortung
