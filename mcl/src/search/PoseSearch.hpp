#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "Annealing.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// The inverse use of p(s|l): draws poses that the present readings speak for, out of all poses
/// where the robot can stand. Not thread-safe.
class ORTUNG_API PoseSearch {
 public:
  using Weigh = Annealing::Weigh;
  using Drawn = Annealing::Drawn;

  /// @param region borrowed
  explicit PoseSearch(const FieldRegion& region);

  /// How many cells the robot can stand on.
  std::size_t cells() const { return standable_.size(); }

  /// @p n poses spread evenly over all poses where the robot can stand; their weights are 0.
  SampleSet anywhere(std::size_t n, Random random) const;

  /// Poses around one.
  struct Ring {
    Pose2 pose;
    double radius;  ///< [m]
    double turn;    ///< greatest turn to either side [rad]
  };
  static bool isWithin(const Ring& ring, float x, float y, float theta);
  /// @p n poses spread evenly over a ring, whether or not the map says that a robot can stand
  /// there.
  static SampleSet around(const Ring& ring, std::size_t n, Random random);

  /// @p n poses by p(s|l).
  /// @param candidates how many are tried for each of them at the beginning, at least 1
  /// @param ring to draw from; none: all poses where the robot can stand
  Drawn draw(std::size_t n, double candidates, const Weigh& weigh, const Random& random,
             const std::optional<Ring>& ring = std::nullopt) const;
  /// The same, of the places that a search of the field has found (FieldSearch), and evenly from
  /// where the robot can stand in rings of one size around each: all that p(s|l) has if elsewhere
  /// it is nothing. So few poses do where an even spread needs many. `logEvidence` is that of the
  /// whole floor.
  /// @param rings one at least, none of which meet
  Drawn drawFrom(std::span<const Ring> rings, std::size_t n, double candidates, const Weigh& weigh,
                 const Random& random) const;

  /// The same, to be spread over time.
  struct Drawing {
    Annealing::Draw draw;
    double logShare;  ///< ln of the share of the floor that is drawn from
    /// @pre draw.isDone()
    Drawn take();
  };
  Drawing drawingFrom(std::span<const Ring> rings, std::size_t n, double candidates,
                      const Weigh& weigh, const Random& random) const;
  /// Of all poses outside the rings.
  Drawing drawingBeside(std::span<const Ring> rings, std::size_t n, double candidates,
                        const Weigh& weigh, const Random& random) const;

 private:
  using Within = Annealing::Within;
  static Within within(std::span<const Ring> rings);
  Within standable(Within also) const;

  const FieldRegion& region_;
  std::vector<std::uint32_t> standable_;  ///< cells
};

}  // namespace ortung
