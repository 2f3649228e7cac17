#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "IsOver.hpp"
#include "Resampling.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// Annealed importance sampling (Neal 2001; Del Moral, Doucet, Jasra 2006): poses are weighed by
/// p^b with a small exponent b, which then rises to 1 while Metropolis steps move each pose towards
/// the nearest peak of the likelihood. So the peak of a sharp likelihood is found with few
/// candidates, and the mean of p over the initial distribution (the evidence) is estimated as well.
/// Not thread-safe.
class ORTUNG_API Annealing {
 public:
  /// Computes ln p(s|l) of all samples of a set.
  using Weigh = std::function<void(const SampleSet&, std::vector<float>&)>;
  /// Returns whether a Metropolis step may lead to this pose.
  using Within = std::function<bool(float x, float y, float theta)>;
  struct Drawn {
    SampleSet samples;   ///< poses; `logWeight` is the part of ln p beyond the last b
    double logEvidence;  ///< ln of the mean of p over the initial distribution
  };

  /// Anneals from a uniform distribution of poses. @param within null: all poses are permitted
  Annealing(Weigh weigh, Within within);
  /// Anneals from a belief: each of its samples represents a kernel (Silverman 1986), a Gaussian
  /// whose covariance is that of the whole belief, scaled down. It is the prior of the Metropolis
  /// steps, so they do not forget what was known.
  /// @param covariance covariance of the belief's heaviest cluster, row-major, [m] and [rad]
  /// @param samples number of samples of the belief
  Annealing(Weigh weigh, const PoseCovariance& covariance, std::size_t samples);

  class Draw;
  /// Draws @p n poses from the initial distribution times p(s|l).
  /// @param from samples of the initial distribution; their weights are not used
  /// @param isOver hastens the draw, see Draw::finish()
  Drawn draw(SampleSet from, std::size_t n, const Random& random, const IsOver& isOver = {}) const;

 private:
  struct Climbing {
    SampleSet set;
    SampleSet origins;  ///< poses from which the samples of a belief began
    std::vector<float> fit;
  };
  double logPriorOf(const Climbing& some, std::size_t i, float x, float y, float theta) const;
  void propose(const SampleSet& set, std::size_t step, Random& random, std::size_t first,
               std::size_t count, SampleSet& proposed) const;
  void accept(Climbing& some, const SampleSet& proposed, std::span<const float> proposedFit,
              double exponent, Random& random, std::size_t first, std::size_t count) const;

  Weigh weigh_;
  Within within_;
  bool isOfBelief_ = false;
  std::array<double, 9> precision_{};  ///< inverse covariance of a sample's kernel, row-major
  double mostMetres_ = 1.0;            ///< greatest sigma of a Metropolis step [m]
  double mostRadians_ = 1.0;
};

/// Annealing that may be spread over several calls. The result does not depend on how much is done
/// in each call. Not thread-safe.
class ORTUNG_API Annealing::Draw {
 public:
  Draw(Annealing annealing, SampleSet from, std::size_t n, const Random& random);

  /// Goes on with the next poses: proposes, weighs or accepts them. Or takes a step of raising the
  /// exponent, which is a look at all of them.
  /// @param most greatest number of them, at least 1
  /// @returns how many were weighed, which is what takes time
  std::size_t work(std::size_t most);
  bool isDone() const { return stage_ == Stage::kDone; }
  /// Returns the number of samples. @pre isDone()
  std::size_t size() const { return climbing_.set.size(); }
  /// Does all that is left. @param isOver leaves out what is left of the annealing, so that what
  ///   the exponents lack of 1 stays in the samples' weights; only initial samples are still
  ///   weighed
  void finish(const IsOver& isOver);
  /// @pre isDone()
  Drawn take() { return {std::move(climbing_.set), logEvidence_}; }

 private:
  enum class Stage : std::uint8_t { kWeigh, kTemper, kRise, kPropose, kAccept, kDone };

  std::size_t weigh(std::size_t most);
  void propose(std::size_t most);
  void accept(std::size_t most);
  void beginStep();
  void beginRise();
  void temper();
  void rise();
  void hasten();
  void end();

  Annealing annealing_;
  std::size_t n_;
  Random random_;
  Random offsets_;
  Random climb_;  ///< random numbers of the Metropolis steps at the present exponent
  Climbing climbing_;
  Stage stage_ = Stage::kWeigh;
  std::size_t next_ = 0;    ///< first pose that the stage has not treated yet
  SampleSet weighing_;      ///< at first the initial samples, later the proposed poses
  std::vector<float> fit_;  ///< ln p of the first poses of weighing_
  std::size_t step_ = 0;    ///< number of the Metropolis step at the present exponent
  int rises_ = 0;
  std::optional<Tempering> tempering_;  ///< by how much the exponent rises
  double exponent_ = 0.0;
  double logEvidence_ = 0.0;
  bool isHastened_ = false;
};

}  // namespace ortung
