#include "ScanCost.hpp"

#ifdef ORTUNG_NEON

#include <arm_neon.h>

#include <algorithm>

namespace ortung {
namespace {

constexpr std::size_t kBeams = 16;           ///< of one vector
constexpr std::size_t kRowsAtOnce = 4;       ///< which share what is loaded of the reading
constexpr std::size_t kPart = 128 * kBeams;  ///< beams whose sums fit 16 bits: two costs a vector

/// What a kernel needs of a reading, in vectors.
struct Constants {
  explicit Constants(const ScanReading& reading)
      : costs(vld1q_u8_x2(reading.costs.data())),
        half(vdupq_n_u16(static_cast<std::uint16_t>((1 << reading.shift) / 2))),
        right(vdupq_n_s16(static_cast<std::int16_t>(-reading.shift))) {}

  uint8x16x2_t costs;  ///< both halves of the table, which one instruction looks up
  uint16x8_t half;     ///< half a unit of steps
  int16x8_t right;     ///< shifts to the left by a negative number
};

/// Returns differences of levels times steps, rounded; 255 at most.
uint8x16_t scaled(uint8x16_t distance, uint8x16_t step, const Constants& with) {
  const uint16x8_t low = vmlal_u8(with.half, vget_low_u8(distance), vget_low_u8(step));
  const uint16x8_t high = vmlal_high_u8(with.half, distance, step);
  return vqmovn_high_u16(vqmovn_u16(vshlq_u16(low, with.right)), vshlq_u16(high, with.right));
}

/// Adds the costs of @p kRows rows, whose vectors stay in registers.
template <bool kHasSteps, std::size_t kRows>
void add(const ScanReading& reading, const Constants& with, std::size_t n,
         const std::uint8_t* const* rows, std::uint32_t* costs) {
  const uint8x16_t last = vdupq_n_u8(kLevelDifferences - 1);
  std::fill_n(costs, kRows, 0U);
  for (std::size_t begin = 0; begin < n; begin += kPart) {
    uint16x8_t sums[kRows] = {};
    const std::size_t end = std::min(n, begin + kPart);
    for (std::size_t j = begin; j < end; j += kBeams) {  // what is read behind n has caps of 0
      const uint8x16_t levels = vld1q_u8(reading.levels.data() + j);
      const uint8x16_t caps = vld1q_u8(reading.caps.data() + j);
      uint8x16_t steps{};
      if constexpr (kHasSteps) steps = vld1q_u8(reading.steps.data() + j);
      for (std::size_t r = 0; r < kRows; ++r) {
        uint8x16_t distance = vabdq_u8(vld1q_u8(rows[r] + j), levels);
        if constexpr (kHasSteps) distance = scaled(distance, steps, with);
        const uint8x16_t cost = vqtbl2q_u8(with.costs, vminq_u8(distance, last));
        sums[r] = vpadalq_u8(sums[r], vminq_u8(cost, caps));
      }
    }
    for (std::size_t r = 0; r < kRows; ++r) costs[r] += vaddlvq_u16(sums[r]);
  }
}

template <bool kHasSteps>
void addAll(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
            std::uint32_t* costs) {
  const Constants with(reading);
  const std::size_t n = usedLength(reading);
  std::size_t i = 0;
  for (; i + kRowsAtOnce <= rows.size(); i += kRowsAtOnce)
    add<kHasSteps, kRowsAtOnce>(reading, with, n, rows.data() + i, costs + i);
  for (; i < rows.size(); ++i) add<kHasSteps, 1>(reading, with, n, rows.data() + i, costs + i);
}

}  // namespace

void scanCostNeon(const ScanReading& reading, std::span<const std::uint8_t* const> rows,
                  std::uint32_t* costs) {
  (reading.steps.empty() ? addAll<false> : addAll<true>)(reading, rows, costs);
}

}  // namespace ortung

#endif
