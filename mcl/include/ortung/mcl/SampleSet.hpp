#pragma once

#include <cstddef>
#include <vector>

#include "ortung/base/SampleView.hpp"

namespace ortung {

/// The belief as weighted samples (paper, section 5.2): struct of arrays, all of size N.
struct SampleSet {
  std::vector<float> x;          ///< x in the field frame [m]
  std::vector<float> y;          ///< y in the field frame [m]
  std::vector<float> theta;      ///< heading [rad], not wrapped
  std::vector<float> logWeight;  ///< ln of the weight, up to a common constant

  /// Returns the number of samples.
  std::size_t size() const { return x.size(); }
  /// Sets the number of samples; new ones are all zero.
  void resize(std::size_t n) {
    x.resize(n);
    y.resize(n);
    theta.resize(n);
    logWeight.resize(n);
  }
  /// Returns @p count samples from @p first on. @pre first + count <= size()
  SampleSet part(std::size_t first, std::size_t count) const {
    const auto begin = static_cast<std::ptrdiff_t>(first);
    const auto end = static_cast<std::ptrdiff_t>(first + count);
    return {{x.begin() + begin, x.begin() + end},
            {y.begin() + begin, y.begin() + end},
            {theta.begin() + begin, theta.begin() + end},
            {logWeight.begin() + begin, logWeight.begin() + end}};
  }
  /// Returns all samples from @p first on. @pre first <= size()
  SampleSet from(std::size_t first) const { return part(first, size() - first); }
  /// Returns a view of the poses, valid until the set changes.
  SampleView view() const { return {x, y, theta}; }
};

}  // namespace ortung
