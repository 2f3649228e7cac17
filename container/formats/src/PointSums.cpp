#include "PointSums.hpp"

#include <algorithm>
#include <utility>

#include "IndexPair.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

constexpr std::size_t kLanes = 16;  ///< poses of one vectorized loop
static_assert(PointSums::kBlock % kLanes == 0);

/// Finds the cells of points, by point and pose.
struct PointCells {
  ORTUNG_INLINE static void run(FramedLookup lookup, const PlacingPoses* poses, const float* px,
                                const float* py, std::size_t points, std::uint32_t* cells) {
    const auto& [x, y, sine, cosine, size] = *poses;
    for (std::size_t lane = 0; lane < size; lane += kLanes) {
      for (std::size_t k = 0; k < points; ++k) {
        std::uint32_t* found = cells + k * PointSums::kBlock;
        for (std::size_t i = lane; i < lane + kLanes; ++i)
          found[i] = lookup.index(x[i] + cosine[i] * px[k] - sine[i] * py[k],
                                  y[i] + sine[i] * px[k] + cosine[i] * py[k]);
      }
    }
  }
};

}  // namespace

/// Adds every fourth of kCount points that are placed to one sum of each pose.
template <std::size_t kCount>
void PointSums::add(std::size_t point, std::size_t size, Sums& sums) const {
  const std::uint8_t* levels = field_.levels();
  const std::uint32_t* cells = cells_.data() + point % kPoints * kBlock;
  std::array<const float*, kCount> logs;
  for (std::size_t k = 0; k < kCount; ++k) logs[k] = logByLevel_[point + k * kSums];
  for (std::size_t i = 0; i < size; i += 2) {
    float one = sums[i];
    float other = sums[i + 1];
    for (std::size_t k = 0; k < kCount; ++k) {
      const auto [first, second] = IndexPair::at(cells + k * kSums * kBlock + i);
      one += logs[k][levels[first]];
      other += logs[k][levels[second]];
    }
    sums[i] = one;
    sums[i + 1] = other;
  }
}

PointSums::Sums PointSums::of(PlacingPoses& poses) {
  const std::size_t lanes = (poses.size + kLanes - 1) / kLanes * kLanes;
  for (auto* values : {&poses.x, &poses.y, &poses.sine, &poses.cosine})
    std::fill(values->begin() + poses.size, values->begin() + lanes, 0.0F);
  std::array<Sums, kSums> sums{};
  const std::size_t count = x_.size();
  const std::size_t whole = count - count % kSums;
  for (std::size_t first = 0; first < count; first += kPoints) {
    const std::size_t size = std::min(kPoints, count - first);
    runWidest<PointCells>(field_.lookup(), &std::as_const(poses), x_.data() + first,
                          y_.data() + first, size, cells_.data());
    if (size == kPoints) {
      for (std::size_t k = 0; k < kSums; ++k) add<kPoints / kSums>(first + k, poses.size, sums[k]);
      continue;
    }
    for (std::size_t k = first; k < count; ++k)
      add<1>(k, poses.size, sums[k < whole ? k % kSums : 0]);
  }
  for (std::size_t i = 0; i < poses.size; ++i)
    sums[0][i] = (sums[0][i] + sums[1][i]) + (sums[2][i] + sums[3][i]);
  return sums[0];
}

}  // namespace ortung
