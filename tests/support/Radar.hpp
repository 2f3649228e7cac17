#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Words.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung::test {

/// A sensor that nobody of Ortung knows, as a plugin's author would write it: it sees one beacon by
/// range and bearing, learns where that is, and weighs by itself. What others may know of its words
/// stands in its format alone.
class RadarData : public SensorData {
 public:
  explicit RadarData(SensorId id, const Pose2& mount = {}) : SensorData(std::move(id), mount) {}
  ~RadarData() override = default;

  static std::vector<std::uint32_t> encode(double range, double bearing) {
    return {words::fromMetres(range), words::fromAngle(bearing)};
  }

  Format format() const override {
    return Format("radar").with("row", std::string("range_mm,bearing_cdeg")).with("max_m", 12.0);
  }
  std::string wordsHelp() const override { return "zork, blorb, nothing that anybody could parse"; }
  bool localizes() const override { return true; }
  std::vector<double> expectation(const Pose2& pose) const override {
    const Pose2 sensor = pose * mount();
    const double dx = x_ - sensor.x;
    const double dy = y_ - sensor.y;
    return {std::hypot(dx, dy), std::remainder(std::atan2(dy, dx) - sensor.theta, kTurn)};
  }

 private:
  struct Echo : Weigher {
    explicit Echo(const RadarData& radar) : x(radar.x_), y(radar.y_), mount(radar.mount()) {
      range = words::toMetres(radar.getData()[0]);
      bearing = words::toAngle(radar.getData()[1]);
    }
    void weigh(const SampleView& poses, std::span<float> logProbability) const override {
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const Pose2 sensor = Pose2{static_cast<double>(poses.x[i]), static_cast<double>(poses.y[i]),
                                   static_cast<double>(poses.theta[i])} *
                             mount;
        const double dx = x - sensor.x;
        const double dy = y - sensor.y;
        const double off = (std::hypot(dx, dy) - range) / 0.1;
        const double turned =
            std::remainder(std::atan2(dy, dx) - sensor.theta - bearing, kTurn) / 0.05;
        logProbability[i] +=
            static_cast<float>(std::max(-0.5 * (off * off + turned * turned), -10.0));
      }
    }
    double x, y, range, bearing;
    Pose2 mount;
  };

  void check(std::span<const std::uint32_t> words) const override {
    if (words.size() % 2 != 0) throw std::invalid_argument("expected two words an echo");
    for (std::size_t i = 1; i < words.size(); i += 2)
      if (words[i] >= words::kAngles) throw std::invalid_argument("no such angle");
  }
  void decode(std::span<const std::uint32_t>) override {}
  void startTables(const FieldRegion&, double) override { x_ = y_ = seen_ = 0.0; }
  void learn(const Pose2& robotInField) override {
    if (getData().empty()) return;  // it saw nothing from there
    const Pose2 sensor = robotInField * mount();
    const double range = words::toMetres(getData()[0]);
    const double angle = sensor.theta + words::toAngle(getData()[1]);
    seen_ += 1.0;
    x_ += (sensor.x + range * std::cos(angle) - x_) / seen_;
    y_ += (sensor.y + range * std::sin(angle) - y_) / seen_;
  }
  std::shared_ptr<const Weigher> makeWeigher() const override {
    return getData().empty() ? nullptr : std::make_shared<Echo>(*this);
  }

  double x_ = 0.0, y_ = 0.0, seen_ = 0.0;  ///< where the beacon is, in the field frame [m]
};

}  // namespace ortung::test
