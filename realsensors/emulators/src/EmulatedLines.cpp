#include "ortung/emulators/EmulatedLines.hpp"

#include <algorithm>

#include "ortung/core/ReadingLine.hpp"

namespace ortung {

EmulatedLines::EmulatedLines(std::span<const SensorData* const> features, std::optional<int> baud)
    : baud_(baud) {
  for (const SensorData* data : features) features_.push_back(data->id());
}

void EmulatedLines::sense(const Message& reading, Timestamp now) {
  if (std::find(features_.begin(), features_.end(), reading.id) == features_.end()) return;
  Message stamped = reading;
  stamped.stamp = clock.at(now);
  std::string line;
  writeLine(stamped, line);
  send(line + "\n", now);
}

}  // namespace ortung
