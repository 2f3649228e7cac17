#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// The inverse use of p(s|l): draws poses that the present readings speak for, out of all poses
/// where the robot can stand. Annealed importance sampling (Neal 2001; Del Moral, Doucet, Jasra
/// 2006): poses drawn evenly are weighed by p^b with a small b, then b rises to 1 while Metropolis
/// steps let every pose climb to the top of its hill. So a sharp reading is found with few
/// candidates, and the mean of p over all poses is estimated on the way. Not thread-safe.
class ORTUNG_API PoseSearch {
 public:
  /// ln p(s|l) of all samples of a set.
  using Weigh = std::function<void(const SampleSet&, std::vector<float>&)>;

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
    double turn;    ///< to either side [rad]
  };
  /// @p n poses spread evenly over a ring, whether or not the map says that a robot can stand
  /// there.
  static SampleSet around(const Ring& ring, std::size_t n, Random random);

  struct Drawn {
    SampleSet samples;   ///< with what is left of ln p beyond the last b as `logWeight`
    double logEvidence;  ///< ln of the mean of p over all poses that were drawn from
  };
  /// @p n poses by p(s|l).
  /// @param candidates how many are tried for each of them at the beginning, at least 1
  /// @param ring to draw from; none: all poses where the robot can stand
  Drawn draw(std::size_t n, double candidates, const Weigh& weigh, const Random& random,
             const std::optional<Ring>& ring = std::nullopt) const;
  /// The same, of the places that a search of the field has found (FieldSearch), and evenly from
  /// rings of one size around each: all that p(s|l) has if elsewhere it is nothing. So few poses do
  /// where an even spread needs many. `logEvidence` is that of the whole floor.
  /// @param rings one at least, none of which meet
  Drawn drawFrom(std::span<const Ring> rings, std::size_t n, double candidates, const Weigh& weigh,
                 const Random& random) const;
  /// @p n poses by p(s|l), out of @p from and what is close by: a belief that is weighed where the
  /// readings are far sharper than the belief, so that few of its samples would be left.
  /// @param from weights are not looked at
  static Drawn drawNear(SampleSet from, std::size_t n, const Weigh& weigh, const Random& random);

 private:
  /// Whether a climbing pose may go there.
  using Within = std::function<bool(float x, float y, float theta)>;
  static Within within(std::span<const Ring> rings);
  static Drawn anneal(SampleSet set, std::size_t n, const Weigh& weigh, const Random& random,
                      const Within& within);
  static void climb(SampleSet& set, std::vector<float>& fit, double exponent, const Weigh& weigh,
                    Random random, const Within& within);

  const FieldRegion& region_;
  std::vector<std::uint32_t> standable_;  ///< cells
};

}  // namespace ortung
