#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "FramedLevels.hpp"
#include "ortung/base/Export.hpp"

namespace ortung {

/// Poses by what it takes to place points that are given in the poses' frames.
struct PlacingPoses {
  static constexpr std::size_t kBlock = 64;  ///< at most so many
  std::array<float, kBlock> x;               ///< [m]
  std::array<float, kBlock> y;
  std::array<float, kBlock> sine;
  std::array<float, kBlock> cosine;
  std::size_t size = 0;
};

/// Sums up ln p of points over a block of poses at a time: one loop places some points for all
/// poses, and the next one looks up what that means. So looking up waits neither for arithmetic nor
/// for sums, and poses near each other find a point's cells in the same lines of memory.
class ORTUNG_API PointSums {
 public:
  static constexpr std::size_t kBlock = PlacingPoses::kBlock;
  using Sums = std::array<float, kBlock>;

  /// Points in the poses' frames [m], and ln p by level for each. All must outlive this.
  PointSums(const FramedLevels& field, std::span<const float> x, std::span<const float> y,
            std::span<const float* const> logByLevel)
      : field_(field), x_(x), y_(y), logByLevel_(logByLevel) {}

  /// Returns the sums of the first poses.size poses; what lies outside of the field is far from
  /// everything. Changes the poses behind these.
  Sums of(PlacingPoses& poses);

 private:
  /// Sums of a pose: one for each of four points in turn. The last points, fewer than four, go to
  /// the first one.
  static constexpr std::size_t kSums = 4;
  static constexpr std::size_t kPoints = 4 * kSums;  ///< points that are placed in one go

  template <std::size_t kCount>
  void add(std::size_t point, std::size_t size, Sums& sums) const;

  const FramedLevels& field_;
  std::span<const float> x_;
  std::span<const float> y_;
  std::span<const float* const> logByLevel_;
  alignas(64) std::array<std::uint32_t, kPoints * kBlock> cells_;  ///< by point, then by pose
};

}  // namespace ortung
