#include "SensorEffects.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr std::size_t kGroup =
    32;  ///< number of bytes in a group, a multiple of every vector width

inline std::uint32_t mixed(std::uint32_t before, std::uint32_t here, std::uint32_t after,
                           std::uint32_t share) {
  constexpr std::uint32_t kEven = 0x00FF00FF;
  constexpr std::uint32_t kHalf = 0x00800080;
  const std::uint32_t keeps = 256 - 2 * share;
  const std::uint32_t even =
      ((before & kEven) * share + (here & kEven) * keeps + (after & kEven) * share + kHalf) >> 8;
  const std::uint32_t odd = ((before >> 8 & kEven) * share + (here >> 8 & kEven) * keeps +
                             (after >> 8 & kEven) * share + kHalf);
  return (even & kEven) | (odd & ~kEven);
}

/// Exposes one group of bytes, with additions and multiplications only, so that all instruction
/// sets agree.
ORTUNG_INLINE void expose(const float* gains, const float* losses, float squared,
                          const float* numbers, float noise, float shot, std::uint8_t* bytes) {
  for (std::size_t i = 0; i < kGroup; ++i) {
    const float light = static_cast<float>(bytes[i]) * (gains[i] - losses[i] * squared);
    const float value = light + numbers[i] * (noise + shot * light) + 0.5F;
    const float bounded = value < 0.0F ? 0.0F : value > 255.0F ? 255.0F : value;
    bytes[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(bounded));
  }
}

struct Row {
  const float* gains;
  const float* losses;
  const float* numbers;
  float squared, noise, shot;
  std::uint8_t* bytes;
  std::size_t groups;
};

ORTUNG_INLINE void exposeRow(const Row& row) {
  for (std::size_t g = 0; g < row.groups; ++g) {
    const std::size_t i = g * kGroup;
    expose(row.gains + i, row.losses + i, row.squared, row.numbers + i, row.noise, row.shot,
           row.bytes + i);
  }
}

void exposePortable(const Row& row) { exposeRow(row); }
#ifdef ORTUNG_X86
ORTUNG_AVX2 void exposeAvx2(const Row& row) { exposeRow(row); }
ORTUNG_AVX512 void exposeAvx512(const Row& row) { exposeRow(row); }
#else
constexpr auto exposeAvx2 = exposePortable, exposeAvx512 = exposePortable;
#endif

void exposeBest(const Row& row) {
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return exposeAvx512(row);
    case InstructionSet::kAvx2:
      return exposeAvx2(row);
    case InstructionSet::kPortable:
      break;
  }
  exposePortable(row);
}

}  // namespace

void blur(std::span<std::uint32_t> pixels, ImageSize size, std::uint32_t share,
          std::vector<std::uint32_t>& above) {
  if (share == 0) return;
  const auto width = static_cast<std::size_t>(size.width);
  const auto height = static_cast<std::size_t>(size.height);
  above.assign(pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(width));
  for (std::size_t row = 0; row < height; ++row) {
    std::uint32_t* const here = pixels.data() + row * width;
    const std::uint32_t* const below = row + 1 < height ? here + width : here;
    for (std::size_t i = 0; i < width; ++i) {
      const std::uint32_t was = here[i];
      here[i] = mixed(above[i], was, below[i], share);
      above[i] = was;
    }
    std::uint32_t before = here[0];
    for (std::size_t i = 0; i < width; ++i) {
      const std::uint32_t was = here[i];
      here[i] = mixed(before, was, here[std::min(i + 1, width - 1)], share);
      before = was;
    }
  }
}

EffectRows::EffectRows(const SensorEffects& effects, ImageSize size)
    : effects_(effects), size_(size) {
  const std::size_t bytes = 3 * static_cast<std::size_t>(size.width);
  const std::size_t padded = (bytes + kGroup - 1) / kGroup * kGroup;
  gains_.resize(padded);
  losses_.resize(padded);
  numbers_.resize(padded);
  const double x = 0.5 * (size.width - 1.0);
  const double y = 0.5 * (size.height - 1.0);
  const double corner = std::max(x * x + y * y, 1.0);
  for (std::size_t i = 0; i < bytes; ++i) {
    const double gain = effects.gains[i % 3];
    const double dx = static_cast<double>(i / 3) - x;
    gains_[i] = static_cast<float>(gain * (1.0 - effects.vignetting * dx * dx / corner));
    losses_[i] = static_cast<float>(gain * effects.vignetting / corner);
  }
}

void EffectRows::apply(int row, const std::optional<Noise>& noise, std::span<std::uint8_t> rgb) {
  if (noise) {
    const std::uint64_t stride = gains_.size();  // even, as the random numbers come in pairs
    fillGaussian(noise->seed, noise->stream, stride * static_cast<std::uint64_t>(row), numbers_);
  } else {
    std::fill(numbers_.begin(), numbers_.end(), 0.0F);
  }
  const auto dy = static_cast<float>(row - 0.5 * (size_.height - 1.0));
  const std::size_t groups = rgb.size() / kGroup;
  const float shot = effects_.shotNoise / 255.0F;
  exposeBest({gains_.data(), losses_.data(), numbers_.data(), dy * dy, effects_.noise, shot,
              rgb.data(), groups});
  const std::size_t done = groups * kGroup;
  std::uint8_t rest[kGroup] = {};
  std::copy(rgb.begin() + static_cast<std::ptrdiff_t>(done), rgb.end(), rest);
  exposeBest({gains_.data() + done, losses_.data() + done, numbers_.data() + done, dy * dy,
              effects_.noise, shot, rest, done < gains_.size() ? std::size_t{1} : std::size_t{0}});
  std::copy_n(rest, rgb.size() - done, rgb.begin() + static_cast<std::ptrdiff_t>(done));
}

}  // namespace ortung
