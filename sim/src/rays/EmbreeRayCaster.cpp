#include <algorithm>
#include <cmath>
#include <limits>

#include "Embree.hpp"
#include "RayCaster.hpp"
#include "RoundGeometry.hpp"

namespace ortung {
namespace {

using embree::kPacket;

FloatRay rayOf(RTCRayN* ray, unsigned n, unsigned i) {
  return {{RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i), RTCRayN_org_z(ray, n, i)},
          {RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i), RTCRayN_dir_z(ray, n, i)},
          RTCRayN_tnear(ray, n, i),
          RTCRayN_tfar(ray, n, i)};
}

void boundRound(const RTCBoundsFunctionArguments* args) {
  const auto box = static_cast<const RoundGeometry*>(args->geometryUserPtr)->boundsOf(args->primID);
  *args->bounds_o = {box[0][0], box[0][1], box[0][2], 0.0f, box[1][0], box[1][1], box[1][2], 0.0f};
}

void intersectRound(const RTCIntersectFunctionNArguments* args) {
  const auto& round = *static_cast<const RoundGeometry*>(args->geometryUserPtr);
  RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const auto t = round.hit(args->primID, rayOf(ray, args->N, i));
    if (!t) continue;
    RTCRayN_tfar(ray, args->N, i) = *t;
    RTCHitN_geomID(hit, args->N, i) = args->geomID;
    RTCHitN_primID(hit, args->N, i) = args->primID;
  }
}

void occludeRound(const RTCOccludedFunctionNArguments* args) {
  const auto& round = *static_cast<const RoundGeometry*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i)
    if (args->valid[i] != 0 && round.hit(args->primID, rayOf(args->ray, args->N, i)))
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
}

void attachRound(const embree::Device& device, const embree::Scene& scene, RoundGeometry& round) {
  if (round.size() == 0) return;
  const embree::Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(round.size()));
  rtcSetGeometryUserData(geometry.get(), &round);
  rtcSetGeometryBoundsFunction(geometry.get(), boundRound, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), intersectRound);
  rtcSetGeometryOccludedFunction(geometry.get(), occludeRound);
  embree::attach(scene, geometry);
}

/// Cosines and sines of 0, step, 2 step, ... by recursion; the error stays at some 1e-15.
struct Turns {
  std::array<double, kPacket> cosine;
  std::array<double, kPacket> sine;
  explicit Turns(double step) {
    const double c = std::cos(step);
    const double s = std::sin(step);
    cosine[0] = 1.0;
    sine[0] = 0.0;
    for (unsigned i = 1; i < kPacket; ++i) {
      cosine[i] = cosine[i - 1] * c - sine[i - 1] * s;
      sine[i] = sine[i - 1] * c + cosine[i - 1] * s;
    }
  }
};

/// Moves hits on outlines of maps to the surface behind them. An occupied cell of a map made from
/// scans means that the surface is somewhere in it, so its middle is a better estimate than its
/// near side.
void moveToSurfaces(const std::vector<Mesh::Depth>& depths, double maxRange, std::size_t n,
                    RTCRayHit16& packet) {
  constexpr unsigned kWalls = 0;  // the first geometry attached to the scene
  for (std::size_t i = 0; i < n; ++i) {
    if (packet.hit.geomID[i] != kWalls) continue;
    double depth = 0.0;
    for (const Mesh::Depth& map : depths) {
      if (packet.hit.primID[i] >= map.firstTriangle) depth = map.depth;
    }
    const auto across = static_cast<double>(std::abs(packet.ray.dir_x[i] * packet.hit.Ng_x[i] +
                                                     packet.ray.dir_y[i] * packet.hit.Ng_y[i]));
    const auto normal = static_cast<double>(std::hypot(packet.hit.Ng_x[i], packet.hit.Ng_y[i]));
    // For rays nearly along a wall the distance to the surface behind is long: at most two depths
    // of it count.
    const double way = across > 0.5 * normal ? depth * normal / across : 2.0 * depth;
    packet.ray.tfar[i] =
        static_cast<float>(std::min(maxRange, static_cast<double>(packet.ray.tfar[i]) + way));
  }
}

}  // namespace

struct RayCaster::Scenes {
  embree::Device device = embree::makeDevice();
  Point2 middle;
  RoundGeometry round;
  embree::Scene upright;  ///< what horizontal rays can meet
  embree::Scene caps;     ///< horizontal surfaces; null if there are none
  std::vector<Mesh::Depth> depths;

  /// Returns the scenes that a ray can meet.
  std::array<RTCScene, 2> scenesFor(bool isLevel) const {
    return {upright.get(), isLevel ? nullptr : caps.get()};
  }
};

RayCaster::RayCaster(const Mesh& mesh) : scenes_(std::make_unique<Scenes>()) {
  scenes_->middle = mesh.middle;
  scenes_->depths = mesh.depths;
  scenes_->round = RoundGeometry(mesh.round, mesh.middle);
  const embree::Device& device = scenes_->device;
  scenes_->upright = embree::makeScene(device);
  embree::attachTriangles(device, scenes_->upright, mesh.walls.vertices, mesh.walls.corners);
  attachRound(device, scenes_->upright, scenes_->round);
  embree::commit(device, scenes_->upright);
  if (mesh.caps.corners.empty()) return;
  scenes_->caps = embree::makeScene(device);
  embree::attachTriangles(device, scenes_->caps, mesh.caps.vertices, mesh.caps.corners);
  embree::commit(device, scenes_->caps);
}

RayCaster::~RayCaster() = default;

void RayCaster::castFan(const RayFan& fan, std::span<float> ranges) const {
  const auto scenes = scenes_->scenesFor(fan.elevation == 0.0);
  const double level = std::cos(fan.elevation);
  const Turns turns(fan.angleStep);  // the same within all packets
  RTCIntersectContext context = embree::makeContext();
  alignas(64) std::array<int, kPacket> valid;
  alignas(64) RTCRayHit16 packet;
  for (unsigned i = 0; i < kPacket; ++i) {
    packet.ray.org_x[i] = static_cast<float>(fan.x - scenes_->middle.x);
    packet.ray.org_y[i] = static_cast<float>(fan.y - scenes_->middle.y);
    packet.ray.org_z[i] = static_cast<float>(fan.z);
    packet.ray.dir_z[i] = static_cast<float>(std::sin(fan.elevation));
    packet.ray.tnear[i] = 0.0f;
    packet.ray.time[i] = 0.0f;
    packet.ray.mask[i] = ~0u;
    packet.ray.id[i] = 0;
    packet.ray.flags[i] = 0;
  }
  for (std::size_t first = 0; first < ranges.size(); first += kPacket) {
    const std::size_t n = std::min<std::size_t>(kPacket, ranges.size() - first);
    const double angle = fan.firstAngle + static_cast<double>(first) * fan.angleStep;
    const double c = level * std::cos(angle);
    const double s = level * std::sin(angle);
    for (unsigned i = 0; i < kPacket; ++i) {
      valid[i] = i < n ? -1 : 0;
      packet.ray.dir_x[i] = static_cast<float>(c * turns.cosine[i] - s * turns.sine[i]);
      packet.ray.dir_y[i] = static_cast<float>(s * turns.cosine[i] + c * turns.sine[i]);
      packet.ray.tfar[i] = static_cast<float>(fan.maxRange);
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    for (const RTCScene scene : scenes) {
      if (scene != nullptr) rtcIntersect16(valid.data(), scene, &context, &packet);
      if (scene == scenes.front() && !scenes_->depths.empty())
        moveToSurfaces(scenes_->depths, fan.maxRange, n, packet);
    }
    std::copy_n(packet.ray.tfar, n, ranges.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

bool RayCaster::isBlocked(const std::array<double, 3>& from, const std::array<double, 3>& direction,
                          double stop) const {
  RTCRay ray{};
  ray.org_x = static_cast<float>(from[0] - scenes_->middle.x);
  ray.org_y = static_cast<float>(from[1] - scenes_->middle.y);
  ray.org_z = static_cast<float>(from[2]);
  ray.dir_x = static_cast<float>(direction[0]);
  ray.dir_y = static_cast<float>(direction[1]);
  ray.dir_z = static_cast<float>(direction[2]);
  ray.tfar = static_cast<float>(stop);
  ray.mask = ~0u;
  RTCIntersectContext context = embree::makeContext();
  for (const RTCScene scene : scenes_->scenesFor(direction[2] == 0.0)) {
    if (scene != nullptr) rtcOccluded1(scene, &context, &ray);
    if (ray.tfar < 0.0f) return true;  // Embree reports a hit by -infinity
  }
  return false;
}

}  // namespace ortung
