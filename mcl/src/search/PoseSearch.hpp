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

/// Sensor resetting: draws poses in proportion to p(s|l) of the present readings, out of all poses
/// where the robot can stand. Not thread-safe.
class ORTUNG_API PoseSearch {
 public:
  using Weigh = Annealing::Weigh;
  using Drawn = Annealing::Drawn;

  /// @param region borrowed
  explicit PoseSearch(const FieldRegion& region);

  /// Returns the number of cells on which the robot can stand.
  std::size_t cells() const { return standable_.size(); }

  /// Draws @p n poses uniformly from all where the robot can stand; their log weights are 0.
  SampleSet anywhere(std::size_t n, Random random) const;

  /// The neighbourhood of a pose.
  struct Ring {
    Pose2 pose;
    double radius;  ///< [m]
    double turn;    ///< greatest difference of headings to either side [rad]
  };
  static bool isWithin(const Ring& ring, float x, float y, float theta);
  /// Draws @p n poses uniformly from a ring, whether or not the map says that a robot can stand
  ///   there.
  static SampleSet around(const Ring& ring, std::size_t n, Random random);

  /// Draws @p n poses in proportion to p(s|l).
  /// @param candidates initial number of candidates for each of them, at least 1
  /// @param ring ring to draw from; nothing: all poses where the robot can stand
  Drawn draw(std::size_t n, double candidates, const Weigh& weigh, const Random& random,
             const std::optional<Ring>& ring = std::nullopt) const;
  /// Draws in proportion to p(s|l) in rings around the places that a search of the field has found
  /// (FieldSearch), assuming that p(s|l) is zero elsewhere. So far fewer candidates are needed than
  /// for the whole floor. `logEvidence` is that of the whole floor.
  /// @param rings at least one, all of the same size; they must not overlap
  Drawn drawFrom(std::span<const Ring> rings, std::size_t n, double candidates, const Weigh& weigh,
                 const Random& random) const;

  /// A draw that may be spread over several updates.
  struct Drawing {
    Annealing::Draw draw;
    double logShare;  ///< ln of the share of the floor that the candidates are from
    /// @pre draw.isDone()
    Drawn take();
  };
  Drawing drawingFrom(std::span<const Ring> rings, std::size_t n, double candidates,
                      const Weigh& weigh, const Random& random) const;
  /// Returns a drawing from all poses outside of the rings.
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
