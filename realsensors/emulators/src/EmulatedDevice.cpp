#include "ortung/emulators/EmulatedDevice.hpp"

#include <algorithm>
#include <utility>

namespace ortung {
namespace {

constexpr double kBitsOfByte = 10.0;  ///< bits of a byte, with start and stop bit
constexpr std::size_t kMostWaiting = 10'000;

}  // namespace

EmulatedDevice::~EmulatedDevice() = default;

void EmulatedDevice::send(std::string telegram, Timestamp now) {
  if (output_.size() == kMostWaiting) return;
  free_ = std::max(free_, now);
  if (const auto speed = baud(); speed && *speed > 0)
    free_ += fromSeconds(kBitsOfByte * static_cast<double>(telegram.size()) / *speed);
  output_.push_back({free_, {std::move(telegram), baud()}});
}

void EmulatedDevice::dropOutput(Timestamp now) {
  output_.clear();
  free_ = std::min(free_, now);
}

std::vector<EmulatedDevice::Telegram> EmulatedDevice::takeOutput(Timestamp now) {
  std::vector<Telegram> out;
  while (!output_.empty() && output_.front().due <= now) {
    out.push_back(std::move(output_.front().telegram));
    output_.pop_front();
  }
  return out;
}

std::optional<Timestamp> EmulatedDevice::due() const {
  if (output_.empty()) return std::nullopt;
  return output_.front().due;
}

}  // namespace ortung
