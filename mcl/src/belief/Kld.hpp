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

/// Sorts samples into bins of (x, y, heading). Bins are numbered in the order in which they first
/// occur, so the result depends on the samples alone.
class ORTUNG_API PoseBins {
 public:
  /// @param workers borrowed, may be null; the result does not depend on them
  PoseBins(const MclConfig& config, const SampleView& samples, Workers* workers = nullptr);

  std::size_t count() const { return bins_.size(); }
  /// Returns whether all headings are within a quarter of a turn, so that their mean is the mean of
  /// the numbers.
  bool isNarrow() const;
  /// Returns the number of a sample's bin.
  std::uint32_t binOf(std::size_t sample) const {
    return columns_ > 0 ? table_[placeOf_[sample]] - 1 : placeOf_[sample];
  }
  /// Returns how many bins the samples with these indices occupy.
  std::size_t countOf(std::span<const std::uint32_t> samples, Workers* workers = nullptr) const;
  /// Returns the number of the cluster of each bin: bins that touch, at corners, too, are in the
  /// same cluster.
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

  int turns_;  ///< number of heading bins per turn
  float perMetre_;
  float perRadian_;
  /// Lowest bin. Compact sets use a dense table of all bins in their bounding box; others use a
  /// hash table.
  Bin low_{};
  std::size_t columns_ = 0;  ///< number of columns of the dense table; zero: the table is hashed
  std::size_t rows_ = 0;
  std::vector<Bin> bins_;
  /// Of each sample: its bin's place in the dense table, or the number of its bin if hashed.
  std::vector<std::uint32_t> placeOf_;
  /// Number of the bin + 1, or 0 if empty; open addressing if hashed.
  std::vector<std::uint32_t> table_;
};

/// Returns the number of samples with which the KL divergence of the sampled distribution from the
/// true one stays below `kldError` with the probability of the quantile `kldQuantile`, if it
/// occupies @p bins bins (Fox, "Adapting the sample size in particle filters through KLD-sampling",
/// 2003, eq. 7); within [minSamples, maxSamples].
ORTUNG_API std::size_t kldSamples(const MclConfig& config, std::size_t bins);

/// Returns mean and covariance of each cluster whose share of the belief is at least @p least, and
/// of the heaviest one in any case; heaviest first.
/// @param bins bins of @p samples
ORTUNG_API std::vector<PoseEstimate> clustersOf(const PoseBins& bins, const SampleView& samples,
                                                std::span<const double> weights, double least,
                                                Workers* workers = nullptr);

/// Returns the mean and covariance of the heaviest cluster.
ORTUNG_API PoseEstimate estimateOf(const PoseBins& bins, const SampleView& samples,
                                   std::span<const double> weights, Workers* workers = nullptr);
ORTUNG_API PoseEstimate estimateOf(const MclConfig& config, const SampleView& samples,
                                   std::span<const double> weights);

}  // namespace ortung
