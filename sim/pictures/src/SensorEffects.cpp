#include "SensorEffects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "ortung/base/InstructionSet.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr std::size_t kGroup = 32;          ///< bytes in a group, a multiple of all vector widths
constexpr std::size_t kRun = 6 * kGroup;    ///< bytes whose noise stands in a row in the table
constexpr std::size_t kNumbers = 1U << 16;  ///< places in the table at which a run may begin

/// Gaussian numbers (mean 0, sigma 1). Runs of them from random places make the noise of a picture:
/// drawing a number for each byte would take longer than drawing the picture.
const std::vector<float>& gaussianNumbers() {
  static const std::vector<float> kTable = [] {
    std::vector<float> numbers(kNumbers + kRun);
    fillGaussian(1, 0, 0, numbers);
    return numbers;
  }();
  return kTable;
}

/// Mixes two bytes at once with their neighbours. Shares are of 256, so that a sum fits 16 bits.
ORTUNG_INLINE std::uint16_t mixed(std::uint16_t before, std::uint16_t here, std::uint16_t after,
                                  std::uint16_t share, std::uint16_t rest) {
  constexpr std::uint16_t kLow = 0xFF;
  const auto sum = [&](int a, int b, int c) {
    return static_cast<std::uint16_t>((a + c) * share + b * rest + 128);
  };
  const std::uint16_t low = sum(before & kLow, here & kLow, after & kLow);
  const std::uint16_t high = sum(before >> 8, here >> 8, after >> 8);
  return static_cast<std::uint16_t>(low >> 8 | (high & ~kLow));
}

constexpr std::size_t kPixels = 16;  ///< pixels that are blurred together

using Group = std::array<std::uint16_t, 2 * kPixels>;

/// Mixes pixels of up to a group. They are copied, so that the compiler knows that nothing else
/// changes.
ORTUNG_INLINE void mixGroup(const std::uint32_t* before, const std::uint32_t* here,
                            const std::uint32_t* after, std::size_t bytes, std::uint32_t share,
                            std::uint32_t* out) {
  Group a, b, c;
  std::memcpy(a.data(), before, bytes);
  std::memcpy(b.data(), here, bytes);
  std::memcpy(c.data(), after, bytes);
  const auto part = static_cast<std::uint16_t>(share);
  const auto rest = static_cast<std::uint16_t>(256 - 2 * share);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = mixed(a[i], b[i], c[i], part, rest);
  std::memcpy(out, b.data(), bytes);
}

/// Mixes each of @p count pixels with those before and after it, which stand in rows of their own.
ORTUNG_INLINE void mixRow(const std::uint32_t* before, const std::uint32_t* here,
                          const std::uint32_t* after, std::size_t count, std::uint32_t share,
                          std::uint32_t* out) {
  std::size_t i = 0;
  for (; i + kPixels <= count; i += kPixels)
    mixGroup(before + i, here + i, after + i, sizeof(Group), share, out + i);
  if (i < count)
    mixGroup(before + i, here + i, after + i, (count - i) * sizeof *out, share, out + i);
}

/// A row of pixels between those above and below.
struct Rows {
  const std::uint32_t* above;
  const std::uint32_t* here;
  const std::uint32_t* below;
  std::size_t width;
  std::uint32_t* between;  ///< room for a pixel more at each end
  std::uint32_t* out;
};

ORTUNG_INLINE void blurRow(const Rows& rows, std::uint32_t share) {
  const std::size_t width = rows.width;
  std::uint32_t* const between = rows.between;
  mixRow(rows.above, rows.here, rows.below, width, share, between + 1);
  between[0] = between[1];
  between[width + 1] = between[width];
  mixRow(between, between + 1, between + 2, width, share, rows.out);
}

void blurPortable(const Rows& rows, std::uint32_t share) { blurRow(rows, share); }
#ifdef ORTUNG_X86
ORTUNG_AVX2 void blurAvx2(const Rows& rows, std::uint32_t share) { blurRow(rows, share); }
ORTUNG_AVX512 void blurAvx512(const Rows& rows, std::uint32_t share) { blurRow(rows, share); }
#else
constexpr auto blurAvx2 = blurPortable, blurAvx512 = blurPortable;
#endif

void blurBest(const Rows& rows, std::uint32_t share) {
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return blurAvx512(rows, share);
    case InstructionSet::kAvx2:
      return blurAvx2(rows, share);
    case InstructionSet::kPortable:
    case InstructionSet::kNeon:
      break;
  }
  blurPortable(rows, share);
}

struct Run {
  const float* gains;
  const float* losses;
  const float* numbers;
  float squared, noise, shot;
  std::uint8_t* bytes;
  std::size_t groups;
};

/// Exposes groups of bytes, with additions and multiplications only, so that all instruction sets
/// agree. Each group is copied, so that the compiler knows that nothing else changes.
ORTUNG_INLINE void exposeRun(const Run& run) {
  for (std::size_t g = 0; g < run.groups; ++g) {
    const std::size_t first = g * kGroup;
    std::array<std::uint8_t, kGroup> bytes;
    std::memcpy(bytes.data(), run.bytes + first, kGroup);
    const float* const gains = run.gains + first;
    const float* const losses = run.losses + first;
    const float* const numbers = run.numbers + first;
    for (std::size_t i = 0; i < kGroup; ++i) {
      const float light = static_cast<float>(bytes[i]) * (gains[i] - losses[i] * run.squared);
      const float value = light + numbers[i] * (run.noise + run.shot * light) + 0.5F;
      const float bounded = value < 0.0F ? 0.0F : value > 255.0F ? 255.0F : value;
      bytes[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(bounded));
    }
    std::memcpy(run.bytes + first, bytes.data(), kGroup);
  }
}

void exposePortable(const Run& run) { exposeRun(run); }
#ifdef ORTUNG_X86
ORTUNG_AVX2 void exposeAvx2(const Run& run) { exposeRun(run); }
ORTUNG_AVX512 void exposeAvx512(const Run& run) { exposeRun(run); }
#else
constexpr auto exposeAvx2 = exposePortable, exposeAvx512 = exposePortable;
#endif

void exposeBest(const Run& run) {
  switch (instructionSet()) {
    case InstructionSet::kAvx512:
      return exposeAvx512(run);
    case InstructionSet::kAvx2:
      return exposeAvx2(run);
    case InstructionSet::kPortable:
    case InstructionSet::kNeon:
      break;
  }
  exposePortable(run);
}

}  // namespace

std::span<const std::uint32_t> BlurredRows::blur(const std::uint32_t* above,
                                                 const std::uint32_t* here,
                                                 const std::uint32_t* below) {
  const Rows rows{above, here, below, out_.size(), between_.data(), out_.data()};
  blurBest(rows, share_);
  return out_;
}

EffectRows::EffectRows(const SensorEffects& effects, ImageSize size)
    : effects_(effects), size_(size) {
  const std::size_t bytes = 3 * static_cast<std::size_t>(size.width);
  const std::size_t padded = (bytes + kGroup - 1) / kGroup * kGroup;
  gains_.resize(padded);
  losses_.resize(padded);
  places_.resize((bytes + 2 * kRun - 1) / (2 * kRun) * 2);
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
  const std::uint64_t stride = places_.size();  // even, as the random numbers come in groups
  if (noise)
    fillUniform(noise->seed, noise->stream, stride * static_cast<std::uint64_t>(row), places_);
  const auto dy = static_cast<float>(row - 0.5 * (size_.height - 1.0));
  Run run{};
  run.squared = dy * dy;
  run.noise = noise ? effects_.noise : 0.0F;
  run.shot = noise ? effects_.shotNoise / 255.0F : 0.0F;
  const float* const numbers = gaussianNumbers().data();
  for (std::size_t first = 0; first < rgb.size(); first += kRun) {
    const std::size_t count = std::min(kRun, rgb.size() - first);
    const auto place = static_cast<std::size_t>(places_[first / kRun] * float{kNumbers});
    run.gains = gains_.data() + first;
    run.losses = losses_.data() + first;
    run.numbers = numbers + std::min(place, kNumbers - 1);
    run.bytes = rgb.data() + first;
    run.groups = count / kGroup;
    exposeBest(run);
    const std::size_t done = run.groups * kGroup;
    if (done == count) continue;
    std::array<std::uint8_t, kGroup> rest{};
    std::copy_n(run.bytes + done, count - done, rest.begin());
    Run last = run;
    last.gains += done;
    last.losses += done;
    last.numbers += done;
    last.bytes = rest.data();
    last.groups = 1;
    exposeBest(last);
    std::copy_n(rest.begin(), count - done, run.bytes + done);
  }
}

}  // namespace ortung
