#pragma once

#include <cstdint>
#include <span>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Counter-based random numbers: Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy
/// as 1, 2, 3", SC 2011). A number depends on seed, stream and its place in the stream alone, so a
/// result never depends on how work was shared between threads.
/// The distributions are its own, since those of the standard library differ between vendors.
/// Not thread-safe.
class ORTUNG_API Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint32_t next();  ///< draws 32 uniform bits
  double uniform();      ///< draws a uniform number from [0, 1)
  /// Draws a uniform number from [low, high).
  double uniform(double low, double high);
  std::uint64_t below(std::uint64_t n);  ///< draws a whole number from [0, n), uniform; @pre n > 0
  double gaussian();                     ///< draws from N(0, 1)

  /// Returns an independent generator of the same seed.
  Random fork(std::uint64_t stream) const;

 private:
  void refill();
  std::uint64_t seed_;
  std::uint64_t stream_;
  std::uint64_t block_ = 0;
  std::uint32_t words_[4] = {};
  int used_ = 4;
  double spare_ = 0.0;
  bool hasSpare_ = false;
};

/// Fills @p out with numbers in [0, 1): out[i] depends on seed, stream and first + i alone.
ORTUNG_API void fillUniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                            std::span<float> out);

/// Fills @p out with Gaussian numbers (mean 0, sigma 1), addressed as in fillUniform().
/// @pre first is even
ORTUNG_API void fillGaussian(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                             std::span<float> out);

}  // namespace ortung
