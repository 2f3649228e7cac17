#pragma once

#include <optional>
#include <span>
#include <vector>

#include "Hypothesis.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung {

/// Places that the belief has had beside the estimate's, until readings rule them out.
///
/// Where the world looks the same from several poses (both halves of a soccer field to a laser,
/// offices of one kind), samples leave all of these places but one sooner or later, by the chance
/// of resampling alone. So each of them is followed as a pose: it moves as the robot does, climbs
/// to where the readings fit best near it, and is compared there with the estimate. It is ruled out
/// once what readings have said against it exceeds what they say by chance. In a building the same
/// place on another floor needs no climbing: it is compared at the estimate's own place there, so
/// that equal floors are never told apart by how well their poses are known. Not thread-safe.
class ORTUNG_API Lookalikes {
 public:
  /// @param building borrowed
  explicit Lookalikes(const Building& building) : building_(building) {}

  /// One time step's readings, once they have weighed the belief.
  struct Moment {
    Pose2 estimate;                 ///< of the belief, field frame
    std::optional<Pose2> odometry;  ///< odometry's pose; nothing: there is none that is trusted
    double travelled = 0.0;         ///< since the readings before [m]; a turn of 1 rad is 1 m
    Random random;
  };

  void forget();
  bool isEmpty() const { return places_.empty(); }
  /// Returns how many poses compare() weighs.
  std::size_t poses() const;
  /// Moves the places as the robot does. If the estimate is at one of them now, they change roles.
  void follow(const Moment& moment);
  /// Compares the places with the estimate. @pre follow(moment)
  void compare(const Moment& moment, const Evidence& evidence);
  /// Adds the belief's places, if they are new. @param places the estimate's is the first one
  void add(std::span<const PoseEstimate> places);
  /// Returns the estimate's share of the probability of all places, in (0, 1]; 1 without others.
  double shareOfEstimate() const;
  /// Returns the shares of floors of the probability of all places, of sum 1.
  /// @pre the building has floors, and follow() was called
  std::vector<double> floorShares() const;
  /// Returns the floor of the estimate at the last readings. @pre as above
  std::size_t floor() const { return building_.floorAt(estimate_.x); }
  /// Returns how far the places are from the estimate that may not be left out with a probability
  /// of more than @p rest.
  PoseDistance reach(double rest) const;

 private:
  /// What readings say for a place against the estimate: sums of log-likelihood ratios and of their
  /// squared deviations from the mean (Welford 1962), over the last hundred or so.
  struct Place {
    Pose2 pose;
    double sum = 0.0;      ///< [nats]
    double squares = 0.0;  ///< [nats^2]
    double count = 0.0;
    double before = 0.0;  ///< what the belief's samples said against it, at most 0 [nats]

    void add(double ratio, double part);
    /// Returns ln of its probability by that of the estimate, as far as chance does not explain it.
    double odds() const;
  };
  void alignFloors();
  std::vector<double> heights(const Evidence& evidence, Random random);
  void exchange(const Pose2& left, const Pose2& estimate);
  void tidy();

  const Building& building_;
  Pose2 estimate_;  ///< at the last readings
  std::optional<Pose2> odometry_;
  std::vector<Place> places_;
};

}  // namespace ortung
