#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

class Workers;

/// Samples sorted into bins of (x, y, heading), in the order in which bins first occur, so the
/// result depends on the samples alone.
class ORTUNG_API PoseBins {
 public:
  /// @param workers borrowed, may be null; the result does not depend on them
  PoseBins(const MclConfig& config, const SampleView& samples, Workers* workers = nullptr);

  std::size_t count() const { return bins_.size(); }
  /// Whether headings are within a quarter of a turn, so that their mean is that of numbers.
  bool isNarrow() const;
  /// Bin of each sample.
  std::span<const std::uint32_t> binOf() const { return binOf_; }
  /// How many bins some of the samples fill.
  std::size_t countOf(std::span<const std::uint32_t> samples) const;
  /// For each bin the number of its cluster: bins that touch (also at corners) hang together.
  std::vector<std::uint32_t> clusters() const;

 private:
  struct Bin {
    std::int32_t x;
    std::int32_t y;
    std::int32_t turn;
    bool operator==(const Bin&) const = default;
  };
  bool sortDensely(const SampleView& samples, Workers* workers);
  std::uint32_t insert(const Bin& bin);
  std::int64_t find(const Bin& bin) const;
  std::size_t slotOf(const Bin& bin) const;
  std::size_t placeOf(const Bin& bin) const {
    return (static_cast<std::size_t>(bin.y - low_.y) * columns_ +
            static_cast<std::size_t>(bin.x - low_.x)) *
               static_cast<std::size_t>(turns_) +
           static_cast<std::size_t>(bin.turn);
  }

  Bin binOfPlace(std::uint32_t place) const;

  int turns_;  ///< bins a turn
  float perMetre_;
  float perRadian_;
  /// Sets that lie together have a table of all bins between the outermost; others are hashed.
  Bin low_{};
  std::size_t columns_ = 0;  ///< number of the table's columns; zero: hashed
  std::size_t rows_ = 0;
  std::vector<Bin> bins_;
  std::vector<std::uint32_t> binOf_;
  std::vector<std::uint32_t> table_;  ///< bin + 1, or 0; open addressing if hashed
};

/// Samples needed so that the sampled distribution is closer than `kldError` to the true one with
/// probability `kldQuantile`, when it fills @p bins bins (Fox, "Adapting the sample size in
/// particle filters through KLD-sampling", 2003, eq. 7); within [minSamples, maxSamples].
ORTUNG_API std::size_t kldSamples(const MclConfig& config, std::size_t bins);

/// Mean and covariance of each cluster whose share of the belief is @p least at least, and of the
/// heaviest one in any case; heaviest first.
/// @param bins of the samples
ORTUNG_API std::vector<PoseEstimate> clustersOf(const PoseBins& bins, const SampleView& samples,
                                                std::span<const double> weights, double least,
                                                Workers* workers = nullptr);

/// The heaviest cluster's mean and covariance.
ORTUNG_API PoseEstimate estimateOf(const PoseBins& bins, const SampleView& samples,
                                   std::span<const double> weights, Workers* workers = nullptr);
ORTUNG_API PoseEstimate estimateOf(const MclConfig& config, const SampleView& samples,
                                   std::span<const double> weights);

}  // namespace ortung
