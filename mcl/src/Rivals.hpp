#pragma once

#include <optional>
#include <utility>

#include "PoseSearch.hpp"
#include "Recovery.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// What readings say for another place than the belief's: the sum of ln p(s | there) - ln p(s |
/// belief). No single reading decides, however sure its model is: errors of one scan are of one
/// piece, so each counts 4 nats at most. Nor do readings from one place: they count by the way
/// between them. A sequential probability ratio test (Wald 1945) on such bounded terms.
class ORTUNG_API Lead {
 public:
  /// @param ratio [nats]
  /// @param part of the way at which readings are independent, in [0, 1] and more
  void count(double ratio, double part);
  double nats() const { return nats_; }
  void atLeast(double nats);
  bool isEnough() const;  ///< six readings at least that all speak for it
  bool isHopeless() const;

 private:
  double nats_ = 0.0;
};

/// Places that compete with the belief while readings fit it badly. They are followed beside it,
/// and take its place only when they explain several readings on some way better by far: the peaks
/// of one reading's likelihood would compete as if the past said nothing, and carry a robot away
/// that tracks well (people before the scanner, furniture that the map lacks).
///
/// - Around the estimate, in a ring that grows with time: wheels that slip or lie, pushes. Drawn
///   anew at every reading, since odometry would move them wrongly.
/// - Elsewhere: a sample set drawn from one reading, moved by odometry and weighed by all later
///   ones, as the belief is.
/// Not thread-safe.
class ORTUNG_API Rivals {
 public:
  /// A reading's moment.
  struct Moment {
    Timestamp stamp = 0;
    Pose2 predicted;           ///< where the belief expects the robot
    double logEvidence = 0.0;  ///< ln p(readings | belief)
    double way = 0.0;          ///< since the readings before [m]; a turn of 1 rad counts as 1 m
  };
  /// Samples that take this share of the belief from now on.
  struct Takeover {
    SampleSet samples;
    double share;
  };

  /// @param search borrowed
  explicit Rivals(const PoseSearch& search) : search_(search) {}

  void forget();
  /// Those elsewhere, to be moved as the belief is; null: there are none.
  SampleSet* samples() { return elsewhere_ ? &elsewhere_->samples : nullptr; }
  /// @param recovery of the same moment
  std::optional<Takeover> follow(const Moment& moment, const Recovery& recovery,
                                 const PoseSearch::Weigh& weigh, const Random& random);

 private:
  struct Elsewhere {
    explicit Elsewhere(SampleSet drawn) : samples(std::move(drawn)) {}
    SampleSet samples;
    Lead lead;
    double way = 0.0;
    int readings = 0;
  };
  std::optional<Takeover> lookAround(const Moment& moment, const Recovery& recovery,
                                     const PoseSearch::Weigh& weigh, const Random& random);
  std::optional<Takeover> lookElsewhere(const Moment& moment, const Recovery& recovery,
                                        const PoseSearch::Weigh& weigh, const Random& random);

  const PoseSearch& search_;
  std::optional<Timestamp> doubtSince_;
  Lead around_;
  std::optional<Elsewhere> elsewhere_;
};

}  // namespace ortung
