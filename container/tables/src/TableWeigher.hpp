#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "CellCorners.hpp"
#include "LandmarkLevels.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/tables/PositionTable.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Weighs samples by features that are tables over the position, interpolated as their at() does, a
/// block of samples at a time: looking up is a loop of its own, so that the arithmetic between the
/// lookups vectorizes.
class ORTUNG_API TableWeigher {
 public:
  static constexpr std::size_t kBlock = CellCorners::kBlock;

  /// @param grid of all tables that are asked for
  explicit TableWeigher(const FieldGrid& grid) : corners_(grid) {}

  /// @param n number of poses, at most kBlock. @param out what finish() adds to. Both must live
  /// until then. @param landmarks what addLandmark() looks up, with the same grid
  void start(const SensorPoses& poses, std::size_t n, float* out,
             const LandmarkLevels* landmarks = nullptr);

  /// Takes a distance into account. @param perSigma of the reading [1/m]
  void addDistance(const PositionTable& table, const GaussianTable& gaussian, float reading,
                   float perSigma);

  /// Takes a bearing in the sensor's frame into account. @param perSigma [1/rad]
  void addBearing(const BearingTable& table, const GaussianTable& gaussian, float reading,
                  float perSigma);

  /// What was read of a landmark, and what residuals mean.
  struct Reading {
    const GaussianTable& gaussian;
    float value;     ///< [m or rad]
    float perSigma;  ///< [1/m or 1/rad]
  };
  /// Takes distance and bearing of a landmark into account. @param index of the landmark among
  /// those that were given to start()
  void addLandmark(std::size_t index, float metresPerLevel, const Reading& range,
                   const Reading& bearing);

  /// Adds ln p of all that was taken into account, one after the other, to out[0 .. n).
  void finish();

 private:
  static constexpr std::size_t kFeatures = 4;  ///< features that are looked up in one go
  using Words = std::array<std::uint32_t, kBlock>;

  struct Alone;

  template <class Places, class... Arguments>
  void add(const CellTable& table, const GaussianTable& gaussian, Arguments... arguments);
  template <class Places, class Corners, class OwnOf, class... Arguments>
  void place(const GaussianTable& gaussian, const Corners& corners, OwnOf ownOf,
             Arguments... arguments);
  void take(const std::uint16_t* levels);
  void takeEntries(const std::uint32_t* entries);
  void startList(const LandmarkLevels& landmarks);
  template <class Places, class Corners, class... Arguments>
  void placeAlone(const Alone& alone, Words& places, Arguments... arguments) const;
  Words& nextPlaces(const GaussianTable& gaussian);
  template <std::size_t kCount>
  void lookUp(std::size_t first);
  void lookUpPending();

  CellCorners corners_;
  SensorPoses poses_{};
  std::size_t n_ = 0;
  float* out_ = nullptr;
  bool isPartlyOutside_ = false;  ///< whether poses are outside of the grid
  const LandmarkLevels* landmarks_ = nullptr;
  /// Poses that are not among four cells that know all landmarks.
  std::array<std::uint32_t, kBlock + 1> suspects_;
  std::size_t suspectCount_ = 0;
  Words entryOf_;  ///< where entries of poses begin
  /// What was loaded from around the poses: of a table, levels of the two lower cells in memory's
  /// order, and those of the upper ones; of a landmark, entries of the four cells.
  std::array<Words, 4> words_;
  std::size_t pending_ = 0;  ///< features whose places were found, not yet looked up
  std::array<Words, kFeatures> places_;
  std::array<const GaussianTable*, kFeatures> gaussians_{};
  std::array<float, kBlock> sums_;
};

}  // namespace ortung
