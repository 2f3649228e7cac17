#pragma once

#include <optional>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

class Workers;

/// How well a belief explains readings: 1 perfectly, 0 no better than nowhere; nothing if none of
/// them tells any pose from nowhere. Every reading has one voice: a scan of many beams must not
/// drown the landmarks that contradict it.
/// @param weights of the samples, sum 1
ORTUNG_API std::optional<double> fitOf(std::span<const Weigher* const> readings,
                                       const SampleSet& samples, std::span<const double> weights,
                                       Workers* workers = nullptr);

/// Says how well the belief fares, from how well it explains readings: as the fit falls behind its
/// own past (as Thrun, Burgard, Fox, table 8.3, with a fit in place of a likelihood, which has no
/// scale), or is poor in itself. Not thread-safe.
class ORTUNG_API Recovery {
 public:
  explicit Recovery(const MclConfig& config);
  /// @param fit of one moment's readings where they are expected, in [0, 1]
  /// @param stands odometry has said so since the readings before
  void follow(double fit, bool stands = false);
  /// Of another belief: how well readings fit where they fit best stays known, for that is of the
  /// sensors and the map.
  void beginAnew() {
    known_ = false;
    unusual_ = 0;
  }
  /// Whether the newest readings fit worse than usual: the robot may have left the track.
  /// Where odometry that stands has long been wrong, what is expected is always poor; then it
  /// counts that they fit nowhere in the belief.
  bool isDoubtful() const;
  /// Whether the fit has fallen for some time: it may be anywhere.
  bool callsForSearch() const;
  bool hasRecovered() const;
  /// The newest best fit, and the average of the last ones, as shares of what is usual.
  double fitOfUsual() const { return best_ ? last_ / *best_ : 1.0; }
  double fitOfUsualLately() const { return best_ ? lately_ / *best_ : 1.0; }
  /// Number of readings in a row that fitted worse than usual.
  int unusual() const { return unusual_; }
  /// @param fit of the same moment's readings where they fit the belief best: with the weights that
  ///   they have given it. How wide a belief has become on a long way does not matter then.
  void followBest(double fit);
  /// Whether readings that fit so well where they fit best fit as they use to.
  bool isUsual(double best) const;

 private:
  bool fitsBadly() const;  ///< whether readings fit badly where the robot was expected
  double rateFast_;
  double rateSlow_;
  double now_ = 0.0;
  bool stands_ = false;
  double fast_ = 0.0;
  double slow_ = 0.0;
  int unusual_ = 0;             ///< number of readings in a row that fitted worse than usual
  double last_ = 0.0;           ///< newest best fit
  double lately_ = 0.0;         ///< its short-term average
  std::optional<double> best_;  ///< usual best fit: most are no better
  bool known_ = false;
};

}  // namespace ortung
