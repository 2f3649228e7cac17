// What devices send, to those drivers that parse it themselves (base, lines), with the intake
// behind them and a port of memory in front of them. The first byte of the input says which driver
// it is and in pieces of which size the other bytes come, the second how long the computer waits
// after each. A byte 0xFF is a device that goes away and comes back.
#include <algorithm>
#include <memory>

#include "Fuzz.hpp"

// The drivers are plugins, whose tables are of no use here.
#include "ortung/core/Plugin.hpp"
#undef ORTUNG_PLUGINS
#define ORTUNG_PLUGINS(...)
#include "BaseDevice.cpp"
#include "LinesDevice.cpp"
#include "ortung/devices/DeviceIntake.hpp"
#include "ortung/formats/BearingData.hpp"

namespace {

std::string_view rest;   // what the device has yet to send
std::string answer;      // what it says at once, before that
std::size_t piece = 1;   // bytes that come together
bool isOpening = false;  // what it sends does not come before it is open

}  // namespace

namespace ortung {

DeviceAbsent::~DeviceAbsent() = default;
DeviceMisfit::~DeviceMisfit() = default;
DeviceDriver::~DeviceDriver() = default;
void DeviceDriver::refresh() {}
bool isLineSpeed(int) { return true; }

Port::Port(std::string name, int descriptor) : name_(std::move(name)), descriptor_(descriptor) {}
Port::~Port() = default;
std::unique_ptr<Port> Port::open(const std::string& name, int) {
  return std::unique_ptr<Port>(new Port(name, -1));
}
bool Port::read(std::string& bytes, std::chrono::milliseconds, std::size_t most) {
  if (isOpening) {
    bytes += std::exchange(answer, {});
    return true;
  }
  if (rest.empty()) return false;
  if (rest.front() == '\xFF') {
    rest.remove_prefix(1);
    throw DeviceAbsent(name_ + ": was closed");
  }
  const std::string_view next =
      rest.substr(0, std::min({piece, most, rest.find('\xFF'), rest.size()}));
  bytes += next;
  rest.remove_prefix(next.size());
  return true;
}
void Port::drop() { rest = {}; }
void Port::write(std::string_view bytes) {
  const auto question = base_lines::decode(bytes.substr(0, bytes.find('\r')));
  if (question && std::holds_alternative<base_lines::Question>(*question))
    answer = base_lines::encode(base_lines::Identity{1, 2});
}

}  // namespace ortung

namespace {

using namespace ortung;

constexpr Timestamp kSecond = 1'000'000;
constexpr Timestamp kOldest = 6 * kSecond / 10;  // age of a stamp
const SensorId kWheels{"odometry", "odometry", "pose"};

/// A device as its thread reads it.
class Device {
 public:
  explicit Device(bool isBase)
      : wheels_(kWheels),
        left_({"sonar", "ultrasonic", "left"}, {}, {}),
        right_({"sonar", "ultrasonic", "right"}, {}, {}),
        compass_({"compass", "compass", "north"}, {}, {}),
        features_{&wheels_, &left_, &right_},
        intake_((isBase ? void() : features_.push_back(&compass_), features_), {}) {
    Parameters parameters("input");
    parameters.set("port", "input");
    if (isBase)
      driver_ = std::make_unique<BaseDevice>(parameters);
    else
      driver_ = std::make_unique<LinesDevice>(parameters);
    driver_->serve(features_);
  }
  void open() {
    isOpening = true;
    driver_->open();
    isOpening = false;
    intake_.opened(now);
  }
  /// Reads once. @returns how many readings were taken
  std::size_t look() {
    std::vector<DeviceReading> readings;
    try {
      driver_->read({}, readings);
    } catch (const DeviceAbsent&) {
      driver_->close();
      open();
    }
    std::size_t taken = 0;
    for (DeviceReading& reading : readings) {
      const auto message = intake_.take(std::move(reading), now);
      if (!message) continue;
      ++taken;
      fuzz::require(message->stamp >= last_ && message->stamp <= std::max(now, last_ + 1));
      fuzz::require(now - message->stamp <= kOldest);
      last_ = message->stamp;
      newest_ = message->words;
      for (const SensorData* feature : features_)
        if (feature->id() == message->id) feature->checkData(message->words);
    }
    const std::uint64_t refused = driver_->refused() + intake_.status(now).refused;
    fuzz::require(refused >= refused_);
    refused_ = refused;
    return taken;
  }
  const std::vector<std::uint32_t>& newest() const { return newest_; }

  Timestamp now = 1000 * kSecond;

 private:
  OdometryData wheels_;
  ConeData left_;
  ConeData right_;
  BearingData compass_;
  std::vector<const SensorData*> features_;
  DeviceIntake intake_;
  std::unique_ptr<DeviceDriver> driver_;
  Timestamp last_ = 0;
  std::uint64_t refused_ = 0;
  std::vector<std::uint32_t> newest_;
};

/// A telegram as a sound device sends it, whatever was sent before.
std::string soundTelegram(bool isBase, std::uint32_t milliseconds,
                          const OdometryData::Reading& reading) {
  if (isBase)
    return base_lines::encode(base_lines::Odometry{.time = milliseconds, .pose = reading.pose});
  std::string line;
  writeLine({Timestamp{1000} * milliseconds, kWheels, OdometryData::encode(reading)}, line);
  return line + "\n";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size < 2) return 0;
  const bool isBase = bytes[0] % 2 == 0;
  const Timestamp wait = Timestamp{bytes[1]} * bytes[1] * 40;  // up to 2.6 s
  rest = {reinterpret_cast<const char*>(bytes) + 2, size - 2};
  piece = 1 + bytes[0] / 2;
  Device device(isBase);
  device.open();
  while (!rest.empty()) {
    device.now += wait;
    device.look();
  }
  // Whatever it has sent: once it comes back, what it measures is taken, after half a minute if its
  // clock seems to be late.
  device.now += 2 * kSecond;
  OdometryData::Reading reading;
  reading.pose = {1.5, -0.25, 0.0};
  rest = "\xFF";
  device.look();
  std::size_t taken = 0;
  for (std::uint32_t i = 0; i < 140; ++i) {
    const std::string sound = soundTelegram(isBase, 7 + 250 * i, reading);
    rest = sound;
    piece = sound.size();
    taken = device.look();
    device.now += kSecond / 4;
  }
  fuzz::require(taken == 1);
  fuzz::require(device.newest() == OdometryData::encode(reading));
  return 0;
}
