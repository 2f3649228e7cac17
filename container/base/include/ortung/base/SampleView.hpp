#pragma once

#include <cstddef>
#include <span>

namespace ortung {

/// Poses of a sample set as three arrays of equal size N (struct of arrays), in the field frame.
/// Angles may have any value: the sample set is not wrapped between steps.
struct SampleView {
  std::span<const float> x;      ///< [m]
  std::span<const float> y;      ///< [m]
  std::span<const float> theta;  ///< [rad]

  std::size_t size() const { return x.size(); }
  /// Returns samples [first, first + count). @pre first + count <= size()
  SampleView part(std::size_t first, std::size_t count) const {
    return {x.subspan(first, count), y.subspan(first, count), theta.subspan(first, count)};
  }
};

}  // namespace ortung
