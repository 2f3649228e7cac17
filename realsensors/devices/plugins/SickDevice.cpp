#include <chrono>
#include <string>
#include <string_view>
#include <thread>

#include "MrptScanner.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/devices/Port.hpp"

namespace ortung {
namespace {

using namespace std::string_view_literals;

constexpr int kSpeedAtStart = 9600;  ///< speed of a scanner that was just switched on [bit/s]
constexpr std::chrono::milliseconds kAnswering{150};
constexpr std::chrono::milliseconds kChangingSpeed{500};
/// Commands that change the speed, and the begin of the answer "done" (SICK, list of telegrams of
/// the LMS 2xx).
constexpr std::string_view kTo38400 = "\x02\x00\x02\x00\x20\x40\x50\x08"sv;
constexpr std::string_view kTo500000 = "\x02\x00\x02\x00\x20\x48\x58\x08"sv;
constexpr std::string_view kDone = "\x02\x80\x03\x00\xA0\x00"sv;

struct SickSettings {
  std::string port;
  int baud;
  int view;        ///< [degrees]
  int resolution;  ///< [1/100 degree]
  std::string unit;

  static SickSettings read(const Parameters& p) {
    SickSettings s;
    s.port = p.text("port");
    s.baud = static_cast<int>(p.integerOr("baud", 38400, {9600, 500000}));
    if (s.baud != 9600 && s.baud != 38400 && s.baud != 500000)
      p.fail("baud", "is " + std::to_string(s.baud) + ", must be 9600, 38400 or 500000");
    s.view = static_cast<int>(p.integerOr("fov_deg", 180, {100, 180}));
    if (s.view != 100 && s.view != 180) p.fail("fov_deg", "must be 100 or 180");
    const double step = p.numberOr("step_deg", 1.0, {0.25, 1.0});
    if (step != 0.25 && step != 0.5 && step != 1.0) p.fail("step_deg", "must be 0.25, 0.5 or 1");
    s.resolution = static_cast<int>(100.0 * step);
    if (s.view == 180 && s.resolution == 25)
      p.fail("step_deg", "is 0.25, which goes with fov_deg = 100 alone");
    s.unit = p.choiceOr("unit", "mm", {"mm", "cm"});
    return s;
  }
};

/// A SICK LMS 200 or one of its family at a serial line. It has no clock, but sends what it has
/// just measured, so a reading is as old as its telegram is long.
class SickDevice : public MrptScanner {
 public:
  explicit SickDevice(const Parameters& p) : SickDevice(SickSettings::read(p)) {}

  void open() override {
    setSpeed();
    MrptScanner::open();
  }

  double latency() const override {
    constexpr double kBitsOfByte = 10.0;
    const double bytes = 10.0 + 2.0 * (100.0 * settings_.view / settings_.resolution + 1.0);
    return bytes * kBitsOfByte / settings_.baud;
  }

 private:
  explicit SickDevice(const SickSettings& s)
      : MrptScanner(s.port, {"sick", s.port, std::to_string(s.baud), std::to_string(s.view),
                             std::to_string(s.resolution), s.unit}),
        settings_(s) {}

  /// MRPT tries the speed of the settings first, and that of a scanner that was switched on again
  /// two seconds later.
  void setSpeed() const {
    if (settings_.baud == kSpeedAtStart) return;
    const auto port = Port::open(settings_.port, kSpeedAtStart);
    port->write(settings_.baud == 500000 ? kTo500000 : kTo38400);
    std::string answer;
    const auto end = std::chrono::steady_clock::now() + kAnswering;
    while (answer.find(kDone) == std::string::npos) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          end - std::chrono::steady_clock::now());
      if (left.count() <= 0) return;
      port->read(answer, left);
    }
    std::this_thread::sleep_for(kChangingSpeed);
  }

  SickSettings settings_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("sick_lms_device",
               ortung::provide<ortung::DeviceDriver, ortung::SickDevice>("sick_lms"));
