#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

class Workers;

/// Returns how well a belief explains readings: 1 perfectly, 0 no better than a pose outside of the
/// map; nothing if no reading can distinguish a pose from that. Every reading has the same weight:
/// a scan of many beams must not outvote the landmarks that contradict it.
/// @param weights weights of the samples, with sum 1
/// @param known ln p(readings | sample) of each sample, if that is known: a single reading is then
///   not asked again
ORTUNG_API std::optional<double> fitOf(std::span<const Weigher* const> readings,
                                       const SampleSet& samples, std::span<const double> weights,
                                       Workers* workers = nullptr,
                                       std::span<const float> known = {});

/// Returns the same for the belief that the robot is at one of these poses, for each of them; zero
/// if no reading can distinguish a pose from one outside of the map.
ORTUNG_API std::vector<double> fitsAt(std::span<const Weigher* const> readings,
                                      std::span<const Pose2> poses);

/// Detects localization failures from how well the belief explains readings: if the short-term
/// average of the fit falls below the long-term one (as Thrun, Burgard, Fox, table 8.3, but with a
/// fit in [0, 1] in place of the likelihood, which has no scale), or if the fit is poor in itself.
/// Not thread-safe.
class ORTUNG_API Recovery {
 public:
  explicit Recovery(const MclConfig& config);
  /// Takes the fit of one time step's readings.
  /// @param fit fit of the readings with the predicted belief, in [0, 1]
  /// @param stands whether the robot has been stationary by odometry since the readings before
  void follow(double fit, bool stands = false);
  /// Takes a time step to which process noise has moved the belief, since nothing has said how the
  /// robot moves. Such a belief is wide, and fits badly wherever the robot is, so it counts alone
  /// whether the readings fit anywhere in it.
  void followBlindly() { isBlind_ = true; }
  /// Forgets the averages, for another belief. The usual best fit stays known, since it belongs to
  /// the sensors and the map.
  void beginAnew() {
    known_ = false;
    unusual_ = 0;
  }
  /// Returns whether the newest readings fit worse than usual, so the robot may not be where the
  /// belief is. If odometry has said for long that a moving robot is stationary, the predicted
  /// belief always fits badly; then it counts whether the readings fit anywhere in the belief.
  bool isDoubtful() const;
  /// Returns whether the fit has been low for some time, so the robot may be anywhere.
  bool callsForSearch() const;
  bool hasRecovered() const;
  /// Returns the short-term average of best fits, as a share of the usual one.
  double fitOfUsualLately() const { return best_ ? lately_ / *best_ : 1.0; }
  /// Returns the number of readings in a row that fitted worse than usual.
  int unusual() const { return unusual_; }
  /// Takes the best fit of the same readings.
  /// @param fit fit with the posterior belief, i.e. with the weights that the readings have given
  ///   it. So it does not matter how wide the belief has become over a long distance.
  /// @param part how independent they are of the readings before, in [0, 1]
  void followBest(double fit, double part = 1.0);
  /// Returns whether a best fit is about as good as usual.
  bool isUsual(double best) const;

 private:
  bool isOfScatter(double best) const;
  bool fitsBadly() const;  ///< whether readings fit badly where the robot was expected
  double rateFast_;
  double rateSlow_;
  double now_ = 0.0;
  bool stands_ = false;
  bool isBlind_ = false;
  double fast_ = 0.0;
  double slow_ = 0.0;
  int unusual_ = 0;      ///< number of readings in a row that fitted worse than usual
  double lately_ = 0.0;  ///< its short-term average
  /// Usual best fit: a slow average that falls more slowly than it rises, and only as the robot
  /// gets on: many readings from one place among people say no more than one.
  std::optional<double> best_;
  double scatter_ = 0.0;  ///< by how much best fits usually differ from it
  bool known_ = false;
};

}  // namespace ortung
