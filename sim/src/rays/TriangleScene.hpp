#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace ortung {

using FloatVector = std::array<float, 3>;

/// The device of the ray tracing library that scenes are built with. Thread-safe.
class TriangleDevice {
 public:
  /// @throws std::runtime_error when the ray tracing library fails
  TriangleDevice();
  ~TriangleDevice();
  TriangleDevice(const TriangleDevice&) = delete;
  TriangleDevice& operator=(const TriangleDevice&) = delete;

 private:
  friend class TriangleScene;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Triangles that rays meet. Immutable, hence thread-safe.
class TriangleScene {
 public:
  /// @param device must outlive the scene @param corners three for each triangle [m]
  /// @throws std::runtime_error when the ray tracing library fails
  TriangleScene(const TriangleDevice& device, const std::vector<FloatVector>& corners);
  ~TriangleScene();
  TriangleScene(const TriangleScene&) = delete;
  TriangleScene& operator=(const TriangleScene&) = delete;

  /// Shortens the ranges of the rays that meet a triangle, and writes its number.
  /// @param origin where all rays begin [m]
  /// @param rays directions of length 1
  /// @param ranges in: how far each ray goes, 0: it is left out; out: where it meets a triangle [m]
  /// @param hits out: the triangle's number; unchanged where none is met
  void meet(const FloatVector& origin, std::span<const FloatVector> rays, std::span<float> ranges,
            std::span<std::uint32_t> hits) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
