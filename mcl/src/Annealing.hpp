#pragma once

#include <array>
#include <functional>
#include <vector>

#include "ortung/base/Export.hpp"
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
    SampleSet samples;   ///< with what is left of ln p beyond the last b as `logWeight`
    double logEvidence;  ///< ln of the mean of p over all poses that were drawn from
  };

  /// Of poses that are spread evenly. @param within null: everywhere
  Annealing(Weigh weigh, Within within);
  /// Of a belief: each of its samples stands for its surroundings (Silverman 1986), a Gaussian with
  /// the covariance of the whole, made smaller. So climbing does not forget what was known.
  /// @param covariance of (x [m], y [m], theta [rad]) of the belief's heaviest cluster, row-major
  Annealing(Weigh weigh, const std::array<double, 9>& covariance, std::size_t samples);

  /// @p n poses by what @p from stands for times p(s|l). @param from its weights are not looked at
  Drawn draw(SampleSet from, std::size_t n, const Random& random) const;

 private:
  struct Climbing {
    SampleSet set;
    SampleSet origins;  ///< of a belief: where each of them began
    std::vector<float> fit;
  };
  double logPriorOf(const Climbing& some, std::size_t i, float x, float y, float theta) const;
  void climb(Climbing& some, double exponent, Random random) const;

  Weigh weigh_;
  Within within_;
  bool isOfBelief_ = false;
  std::array<double, 9> precision_{};  ///< of a sample's surroundings
  double mostMetres_ = 1.0;            ///< of a step's sigma
  double mostRadians_ = 1.0;
};

}  // namespace ortung
