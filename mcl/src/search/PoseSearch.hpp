#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "Annealing.hpp"
#include "FieldCover.hpp"
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
  /// Returns the coarse grid of a search of the field.
  const std::shared_ptr<const FieldCover>& cover() const { return cover_; }

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
  /// @param random goes on
  static SampleSet someAround(const Ring& ring, std::size_t n, Random& random);

  /// Draws @p n poses in proportion to p(s|l).
  /// @param candidates initial number of candidates for each of them, at least 1
  /// @param ring ring to draw from; nothing: all poses where the robot can stand
  /// @param isOver hastens the draw, here and below
  Drawn draw(std::size_t n, double candidates, const Weigh& weigh, const Random& random,
             const std::optional<Ring>& ring = std::nullopt, const IsOver& isOver = {}) const;
  /// Draws in proportion to p(s|l) in rings around the places that a search of the field has found
  /// (FieldSearch), assuming that p(s|l) is zero elsewhere. So far fewer candidates are needed than
  /// for the whole floor. `logEvidence` is that of the whole floor.
  /// @param rings at least one, all of the same size; they must not overlap
  Drawn drawFrom(std::span<const Ring> rings, std::size_t n, double candidates, const Weigh& weigh,
                 const Random& random, const IsOver& isOver = {}) const;

  /// A draw that may be spread over several updates.
  struct Drawing {
    Annealing::Draw draw;
    double logShare;  ///< ln of the share of the floor that the candidates are from
    /// @pre draw.isDone()
    Drawn take();
  };
  /// A drawing from rings, as drawFrom() does, whose candidates may be gathered in several calls.
  class Inside {
   public:
    /// @param search borrowed
    Inside(const PoseSearch& search, std::span<const Ring> rings, std::size_t n, double candidates,
           const Random& random);
    /// Tries more candidates. @param most greatest number of them @returns whether all are tried
    bool gather(std::size_t most);
    /// @pre all are tried
    Drawing drawing(const Weigh& weigh);

   private:
    void endRing();

    const PoseSearch& search_;
    std::vector<Ring> rings_;
    Annealing::Within within_;
    std::size_t n_;
    std::size_t each_;  ///< candidates per ring
    Random random_;
    std::size_t ring_ = 0;   ///< number of the present ring
    std::size_t tried_ = 0;  ///< candidates tried in it
    std::size_t had_ = 0;    ///< candidates before it
    Random places_;          ///< random numbers of its candidates
    double volume_ = 0.0;    ///< [m^2 rad]
    SampleSet set_;
  };
  /// A drawing from all poses outside of some rings, whose candidates may be gathered in several
  /// calls.
  class Beside {
   public:
    /// @param search borrowed
    Beside(const PoseSearch& search, std::span<const Ring> rings, std::size_t n, double candidates,
           const Random& random);
    /// Tries more candidates. @param most greatest number of them @returns whether all are tried
    bool gather(std::size_t most);
    /// @pre all are tried
    Drawing drawing(const Weigh& weigh);

   private:
    const PoseSearch& search_;
    Annealing::Within within_;
    std::size_t n_;
    std::size_t all_;
    std::size_t tried_ = 0;
    Random random_;
    Random places_;  ///< random numbers of the candidates
    SampleSet set_;
  };

 private:
  using Within = Annealing::Within;
  void addAnywhere(std::size_t n, Random& random, SampleSet& set) const;
  static Within within(std::span<const Ring> rings);
  Within standable(Within also) const;

  const FieldRegion& region_;
  std::vector<std::uint32_t> standable_;  ///< cells
  std::shared_ptr<const FieldCover> cover_;
};

}  // namespace ortung
