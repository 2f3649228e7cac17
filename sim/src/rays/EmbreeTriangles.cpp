#include <cstddef>

#include "Embree.hpp"
#include "TriangleScene.hpp"

namespace ortung {

using embree::kPacket;

struct TriangleDevice::Parts {
  embree::Device device = embree::makeDevice();
};

TriangleDevice::TriangleDevice() : parts_(std::make_unique<Parts>()) {}
TriangleDevice::~TriangleDevice() = default;

struct TriangleScene::Parts {
  embree::Scene scene;  ///< null: it has no triangles
};

TriangleScene::TriangleScene(const TriangleDevice& device, const std::vector<FloatVector>& corners)
    : parts_(std::make_unique<Parts>()) {
  if (corners.empty()) return;
  std::vector<std::array<std::uint32_t, 3>> triangles(corners.size() / 3);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) triangles[i] = {3 * i, 3 * i + 1, 3 * i + 2};
  const embree::Device& with = device.parts_->device;
  parts_->scene = embree::makeScene(with);
  embree::attachTriangles(with, parts_->scene, corners, triangles);
  embree::commit(with, parts_->scene);
}

TriangleScene::~TriangleScene() = default;

void TriangleScene::meet(const FloatVector& origin, std::span<const FloatVector> rays,
                         std::span<float> ranges, std::span<std::uint32_t> hits) const {
  if (!parts_->scene) return;
  RTCIntersectContext context = embree::makeContext();
  alignas(64) std::array<int, kPacket> valid;
  alignas(64) RTCRayHit16 packet{};
  for (unsigned i = 0; i < kPacket; ++i) {
    packet.ray.org_x[i] = origin[0];
    packet.ray.org_y[i] = origin[1];
    packet.ray.org_z[i] = origin[2];
    packet.ray.mask[i] = ~0U;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t n = std::min<std::size_t>(kPacket, rays.size() - first);
    bool isAny = false;
    for (std::size_t i = 0; i < kPacket; ++i) {
      const bool isCast = i < n && ranges[first + i] > 0.0F;
      isAny = isAny || isCast;
      valid[i] = isCast ? -1 : 0;
      if (!isCast) continue;
      packet.ray.dir_x[i] = rays[first + i][0];
      packet.ray.dir_y[i] = rays[first + i][1];
      packet.ray.dir_z[i] = rays[first + i][2];
      packet.ray.tfar[i] = ranges[first + i];
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (!isAny) continue;
    rtcIntersect16(valid.data(), parts_->scene.get(), &context, &packet);
    for (std::size_t i = 0; i < n; ++i) {
      if (valid[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      ranges[first + i] = packet.ray.tfar[i];
      hits[first + i] = packet.hit.primID[i];
    }
  }
}

}  // namespace ortung
