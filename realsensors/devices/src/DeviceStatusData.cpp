#include "ortung/devices/DeviceStatusData.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ortung/formats/FormatNames.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWords = 9;
constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();

std::uint32_t wordOf(std::uint64_t count) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(count, kMost));
}

std::uint32_t wordOf(double value) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 4e9)));
}

}  // namespace

SensorId DeviceStatusData::idOf(std::size_t number, const std::string& plugin) {
  return {"device", "status", plugin + std::to_string(number)};
}

DeviceStatusData::DeviceStatusData(std::size_t number, const std::string& plugin)
    : SensorData(idOf(number, plugin)) {}

DeviceStatusData::~DeviceStatusData() = default;

Message DeviceStatusData::message(const SensorId& id, Timestamp now, const DeviceStatus& status) {
  return {now,
          id,
          {static_cast<std::uint32_t>(status.state), wordOf(status.readings),
           wordOf(1000.0 * status.rate), status.age ? wordOf(1000.0 * *status.age) : kMost,
           wordOf(status.refused), wordOf(status.repeated), wordOf(status.flooded),
           wordOf(status.late), wordOf(status.clockJumps)}};
}

Format DeviceStatusData::format() const {
  std::vector<const char*> states;
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(DeviceState::kLast); ++i)
    states.push_back(toText(static_cast<DeviceState>(i)));
  return Format(kFormat).with("status", states);
}

std::string DeviceStatusData::wordsHelp() const {
  return "[0 opening, 1 absent, 2 running, 3 stale, 4 frozen, 5 failed, 6 late; readings; rate "
         "1/1000 a "
         "second; age ms, 4294967295: none; refused; repeated; flooded; late; clock jumps]";
}

void DeviceStatusData::check(std::span<const std::uint32_t> words) const {
  if (words.size() != kWords || words[0] > static_cast<std::uint32_t>(DeviceState::kLast))
    throw std::invalid_argument("expected " + std::to_string(kWords) +
                                " words, the first one at most 6");
}

void DeviceStatusData::decode(std::span<const std::uint32_t>) {}

}  // namespace ortung
