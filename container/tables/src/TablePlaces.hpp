#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ortung/base/Angles.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/tables/PositionTable.hpp"
#include "ortung/tables/SensorModel.hpp"

/// Where residuals of distances and bearings, between the centres of cells, are in GaussianTables:
/// loops over samples for runWidest().
namespace ortung {

inline constexpr std::int32_t kNoLevel = CellTable::kNone;

/// Levels of the cells around a pose.
struct FourLevels {
  std::int32_t first;  ///< of the cell below and left
  std::int32_t right;
  std::int32_t up;
  std::int32_t both;

  /// Returns the greatest one: kNoLevel, if there is none of one of them.
  ORTUNG_INLINE std::int32_t most() const {
    const std::int32_t below = first > right ? first : right;
    const std::int32_t above = up > both ? up : both;
    return below > above ? below : above;
  }
};

/// Levels of one table around poses: those of the two lower cells in memory's order, and those of
/// the upper ones.
struct TableCorners {
  static constexpr bool kMarksUnknown = true;
  const std::uint32_t* lower;
  const std::uint32_t* upper;

  ORTUNG_INLINE FourLevels at(std::size_t k) const {
    return {left(lower[k]), right(lower[k]), left(upper[k]), right(upper[k])};
  }
  static TableCorners alike(const std::uint32_t* own) { return {own, own}; }

 private:
  static constexpr bool kIsLittle = std::endian::native == std::endian::little;
  ORTUNG_INLINE static std::int32_t left(std::uint32_t word) {
    return static_cast<std::int32_t>(kIsLittle ? word & 0xFFFF : word >> 16);
  }
  ORTUNG_INLINE static std::int32_t right(std::uint32_t word) {
    return static_cast<std::int32_t>(kIsLittle ? word >> 16 : word & 0xFFFF);
  }
};

/// Levels of a landmark around poses, in one half of its entries by cell.
template <int kShift>
struct LandmarkCorners {
  static constexpr bool kMarksUnknown = false;  // LandmarkLevels says where cells know nothing
  const std::uint32_t* first;
  const std::uint32_t* right;
  const std::uint32_t* up;
  const std::uint32_t* both;

  ORTUNG_INLINE FourLevels at(std::size_t k) const {
    return {levelOf(first[k]), levelOf(right[k]), levelOf(up[k]), levelOf(both[k])};
  }
  static LandmarkCorners alike(const std::uint32_t* own) { return {own, own, own, own}; }

 private:
  ORTUNG_INLINE static std::int32_t levelOf(std::uint32_t entry) {
    return static_cast<std::int32_t>(entry >> kShift & 0xFFFF);
  }
};
using RangeCorners = LandmarkCorners<0>;
using BearingCorners = LandmarkCorners<16>;

/// What is around poses, and where the poses lie between it.
template <class Corners>
struct AroundPoses {
  Corners corners;
  const float* shareX;
  const float* shareY;
  const float* theta;  ///< headings of the poses [rad]

  /// Interpolates; ways are levels from that of the cell below and left.
  ORTUNG_INLINE float between(std::size_t k, std::int32_t first, float toRight, float toUp,
                              float toBoth) const {
    const float below = shareX[k] * toRight;
    const float above = toUp + shareX[k] * (toBoth - toUp);
    return static_cast<float>(first) + below + shareY[k] * (above - below);
  }
};

/// What GaussianTable::placeOf() rounds, in numbers that loops are given: of constants, compilers
/// make choices that take longer.
struct GaussianPlaces {
  float perUnit;  ///< entries of the table per unit of the residual
  float floor = GaussianTable::kFloorPlace;

  /// @param perSigma of the residual: units are metres, or radians
  explicit GaussianPlaces(float perSigma)
      : perUnit(perSigma * static_cast<float>(GaussianTable::placeOf(1.0F))) {}

  /// Returns a residual's place. Nothing expected is as bad as the worst one.
  ORTUNG_INLINE std::uint32_t of(std::int32_t level, float residual) const {
    const float place = std::fabs(residual * perUnit);
    const float bounded = place < floor ? place : floor;  // also for NaN
    const auto nearest = static_cast<std::int32_t>(bounded + 0.5F);
    return static_cast<std::uint32_t>(level == kNoLevel ? GaussianTable::kFloorPlace : nearest);
  }
};

/// Set in places of poses beside a cell of which nothing is known.
inline constexpr std::uint32_t kIsUnknown = 1U << 31;

/// Marks the place of a pose if corners tell what is unknown. @param greatest the greatest level
/// so far
template <class Corners>
ORTUNG_INLINE std::uint32_t marked(std::uint32_t place, const FourLevels& levels,
                                   std::int32_t& greatest) {
  if constexpr (!Corners::kMarksUnknown) return place;
  const std::int32_t most = levels.most();
  greatest = greatest > most ? greatest : most;
  return place | (most == kNoLevel ? kIsUnknown : 0U);
}

struct DistancePlaces {
  template <class Corners>
  ORTUNG_INLINE static void run(AroundPoses<Corners> around, float reading, float metresPerLevel,
                                GaussianPlaces gaussian, std::size_t n, std::uint32_t* places,
                                std::int32_t* most) {
    std::int32_t greatest = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const FourLevels levels = around.corners.at(k);
      const std::int32_t first = levels.first;
      const float level = around.between(k, first, static_cast<float>(levels.right - first),
                                         static_cast<float>(levels.up - first),
                                         static_cast<float>(levels.both - first));
      places[k] =
          marked<Corners>(gaussian.of(first, reading - level * metresPerLevel), levels, greatest);
    }
    *most = greatest;
  }
};

/// Returns levels from one direction to another, by the shorter way. Masks choose, as compilers
/// make branches of choices that follow each other.
ORTUNG_INLINE float shorterWay(std::int32_t way) {
  constexpr auto kDirections =
      static_cast<std::int32_t>(kTurn / BearingTable::kRadiansPerLevel + 0.5);
  constexpr std::int32_t kHalf = kDirections / 2;
  const std::int32_t over = -static_cast<std::int32_t>(way > kHalf) & kDirections;
  const std::int32_t under = -static_cast<std::int32_t>(way < -kHalf) & kDirections;
  return static_cast<float>(way - over + under);
}

struct BearingPlaces {
  template <class Corners>
  ORTUNG_INLINE static void run(AroundPoses<Corners> around, float reading, GaussianPlaces gaussian,
                                std::size_t n, std::uint32_t* places, std::int32_t* most) {
    std::int32_t greatest = 0;
    constexpr float kNoFraction = 12582912.0F;  // 1.5 * 2^23: adding it rounds to whole turns
    constexpr auto kTurnsPerLevel = static_cast<float>(BearingTable::kRadiansPerLevel / kTurn);
    for (std::size_t k = 0; k < n; ++k) {
      const FourLevels levels = around.corners.at(k);
      const std::int32_t first = levels.first;
      const float level =
          around.between(k, first, shorterWay(levels.right - first), shorterWay(levels.up - first),
                         shorterWay(levels.both - first));
      const float turns =
          (reading + around.theta[k]) * (1.0F / kTurnFloat) - level * kTurnsPerLevel;
      const float nearest = (turns + kNoFraction) - kNoFraction;
      places[k] =
          marked<Corners>(gaussian.of(first, (turns - nearest) * kTurnFloat), levels, greatest);
    }
    *most = greatest;
  }
};

}  // namespace ortung
