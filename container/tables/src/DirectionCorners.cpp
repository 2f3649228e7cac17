#include "DirectionCorners.hpp"

#include "ortung/base/Widest.hpp"

namespace ortung {

/// Finds directions, and weights that are rounded so that their sum stays whole.
struct DirectionCorners::Start {
  ORTUNG_INLINE static void run(DirectionCorners* found, const float* theta, const float* shareX,
                                const float* shareY, float firstAngle, std::int32_t directions,
                                std::size_t n) {
    const auto turn = static_cast<float>(directions);
    const auto perRadian = static_cast<float>(directions / kTurn);
    for (std::size_t k = 0; k < n; ++k) {
      const float within = withinTurn((theta[k] + firstAngle) * perRadian, turn);
      const auto before = static_cast<std::int32_t>(within);
      const std::int32_t safe = before < directions ? before : directions - 1;
      found->direction_[k] = safe;
      const float beyond = within - static_cast<float>(safe);
      const float next = beyond < 1.0F ? beyond : 1.0F;
      const float x = shareX[k];
      const float y = shareY[k];
      const float cells[] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
      float sum = 0.0F;
      std::int32_t before8 = 0;
      std::array<std::uint32_t, kWords> words{};
      for (std::size_t i = 0; i < kWeights; ++i) {
        sum += cells[i / 2] * (i % 2 == 0 ? 1 - next : next);
        const std::int32_t upTo =
            i + 1 == kWeights ? LevelsAround::kWhole
                              : static_cast<std::int32_t>(sum * LevelsAround::kWhole + 0.5F);
        words[i / kBytes] |= static_cast<std::uint32_t>(upTo - before8) << shiftOf(i);
        before8 = upTo;
      }
      for (std::size_t w = 0; w < kWords; ++w) found->weights_[w][k] = words[w];
    }
  }
};

void DirectionCorners::start(const SensorPoses& poses, std::size_t n) {
  corners_.start(poses, n);
  runWidest<Start>(this, poses.theta, corners_.sharesX(), corners_.sharesY(), firstAngle_,
                   table_.directions(), n);
}

}  // namespace ortung
