#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// Annealed importance sampling (Neal 2001; Del Moral, Doucet, Jasra 2006): poses are weighed by
/// p^b with a small b, then b rises to 1 while Metropolis steps let every pose climb to the top of
/// its hill. So a sharp reading is found with few candidates, and the mean of p over all that was
/// drawn from is estimated on the way. Not thread-safe.
class ORTUNG_API Annealing {
 public:
  /// ln p(s|l) of all samples of a set.
  using Weigh = std::function<void(const SampleSet&, std::vector<float>&)>;
  /// Whether a climbing pose may go there.
  using Within = std::function<bool(float x, float y, float theta)>;
  struct Drawn {
    SampleSet samples;   ///< poses; the rest of ln p beyond the last b is their `logWeight`
    double logEvidence;  ///< ln of the mean of p over all poses that were drawn from
  };

  /// Of poses that are spread evenly. @param within null: everywhere
  Annealing(Weigh weigh, Within within);
  /// Of a belief: each of its samples stands for its surroundings (Silverman 1986), a Gaussian with
  /// the covariance of the whole, made smaller. So climbing does not forget what was known.
  /// @param covariance of the belief's heaviest cluster
  Annealing(Weigh weigh, const PoseCovariance& covariance, std::size_t samples);

  class Draw;
  /// @p n poses by what @p from stands for times p(s|l). @param from its weights are not looked at
  Drawn draw(SampleSet from, std::size_t n, const Random& random) const;

 private:
  struct Climbing {
    SampleSet set;
    SampleSet origins;  ///< poses where the samples of a belief began
    std::vector<float> fit;
  };
  double logPriorOf(const Climbing& some, std::size_t i, float x, float y, float theta) const;
  SampleSet proposed(const SampleSet& set, std::size_t step, Random& random) const;
  void accept(Climbing& some, const SampleSet& proposed, std::span<const float> proposedFit,
              double exponent, Random& random) const;

  Weigh weigh_;
  Within within_;
  bool isOfBelief_ = false;
  std::array<double, 9> precision_{};  ///< inverse covariance of a sample's surroundings, row-major
  double mostMetres_ = 1.0;            ///< greatest sigma of a step [m]
  double mostRadians_ = 1.0;
};

/// A drawing that may be spread over time: what is drawn does not depend on how much is done at a
/// time. Not thread-safe.
class ORTUNG_API Annealing::Draw {
 public:
  Draw(Annealing annealing, SampleSet from, std::size_t n, const Random& random);

  /// Weighs the next poses. @param most at least 1 @returns how many it were; 0: it is done
  std::size_t work(std::size_t most);
  bool isDone() const { return isDone_; }
  /// @pre isDone()
  Drawn take() { return {std::move(climbing_.set), logEvidence_}; }

 private:
  void endPass();
  void rise();
  void finish();

  Annealing annealing_;
  std::size_t n_;
  Random random_;
  Random offsets_;
  Random climb_;  ///< random numbers of the present rise
  Climbing climbing_;
  SampleSet weighing_;      ///< poses that are drawn from at first, later those that are proposed
  std::vector<float> fit_;  ///< ln p of the first poses of weighing_
  std::size_t step_ = 0;    ///< number of the present climb's step
  int rises_ = 0;
  double exponent_ = 0.0;
  double logEvidence_ = 0.0;
  bool isDone_ = false;
};

}  // namespace ortung
