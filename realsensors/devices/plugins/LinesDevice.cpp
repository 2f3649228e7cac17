#include <algorithm>
#include <memory>
#include <optional>

#include "ortung/core/Plugin.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/devices/BaseLines.hpp"
#include "ortung/devices/DeviceDriver.hpp"
#include "ortung/devices/Port.hpp"

namespace ortung {
namespace {

constexpr std::size_t kLongestLine = 1u << 20;

/// Anything home-made: lines as in a record, stamped by its own clock. Features that the robot file
/// does not name are passed over, lines that are none are refused.
class LinesDevice : public DeviceDriver {
 public:
  explicit LinesDevice(const Parameters& p)
      : name_(p.text("port")),
        baud_(static_cast<int>(p.integerOr("baud", 115200, {1200, 1'000'000}))),
        hasClock_(p.flagOr("has_clock", true)),
        lines_(kLongestLine) {
    if (!isLineSpeed(baud_)) p.fail("baud", "is no speed of a serial line");
  }

  void serve(std::span<const SensorData* const> features) override {
    features_.assign(features.begin(), features.end());
  }
  void open() override {
    port_ = Port::open(name_, baud_);
    lines_.clear();
    isFirst_ = true;
  }
  void read(std::chrono::milliseconds patience, std::vector<DeviceReading>& readings) override {
    std::string bytes;
    if (!port_->read(bytes, patience, 1u << 16)) return;
    lines_.add(bytes);
    while (const auto line = lines_.next()) {
      take(*line, readings);
      isFirst_ = false;
    }
  }
  /// What a server keeps for a connection ends with it; of a serial line, what was received.
  void refresh() override { open(); }
  void close() noexcept override { port_.reset(); }
  std::uint64_t refused() const override { return refused_ + lines_.refused(); }

 private:
  void take(const std::string& line, std::vector<DeviceReading>& readings) {
    if (line.empty() || line.front() == '#') return;
    auto message = parseLine(line);
    if (!message) {
      refused_ += isFirst_ ? 0 : 1;  // the first one may have begun before we listened
      return;
    }
    const auto found =
        std::find_if(features_.begin(), features_.end(),
                     [&](const SensorData* data) { return data->id() == message->id; });
    if (found == features_.end()) return;
    DeviceReading reading;
    reading.feature = static_cast<std::size_t>(found - features_.begin());
    reading.words = std::move(message->words);
    if (hasClock_) reading.deviceTime = message->stamp;
    readings.push_back(std::move(reading));
  }

  std::string name_;
  int baud_;
  bool hasClock_;
  LineCutter lines_;
  std::vector<const SensorData*> features_;
  std::unique_ptr<Port> port_;
  bool isFirst_ = true;
  std::uint64_t refused_ = 0;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lines_device", ortung::provide<ortung::DeviceDriver, ortung::LinesDevice>("lines"));
