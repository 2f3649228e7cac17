#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/study/Disturbed.hpp"

namespace ortung::test {

/// Gives the messages that it was made with.
class MadeSource : public Source {
 public:
  explicit MadeSource(std::vector<Message> messages) : messages_(std::move(messages)) {}
  bool next(Message& message) override {
    if (next_ == messages_.size()) return false;
    message = messages_[next_++];
    return true;
  }
  std::string remark() const override { return "made up"; }
  std::string worldFingerprint() const override { return "made"; }

 private:
  std::vector<Message> messages_;
  std::size_t next_ = 0;
};

inline const SensorId kOdometryId{"base", "odometry", "pose"};
inline const SensorId kScanId{"LMS200", "LRF", "scan"};
inline const SensorId kSonarId{"front", "sonar", "distance"};
inline const SensorId kTruthId{"reference", "groundTruth", "pose"};

/// A robot with odometry, a scanner of half a turn, a distance sensor and ground truth.
struct MadeRobot {
  static constexpr ScanData::Config kScan{.beams = 181,
                                          .firstAngle = -1.5707963267948966,
                                          .angleStep = 0.017453292519943295,
                                          .minRange = 0.1,
                                          .maxRange = 8.0};
  MadeRobot() {
    container.add(std::make_unique<OdometryData>(kOdometryId));
    container.add(std::make_unique<ScanData>(kScanId, Pose2{}, kScan));
    container.add(std::make_unique<ScalarData>(kSonarId, Pose2{}, ScalarData::Config{}));
    container.add(std::make_unique<PoseData>(kTruthId));
  }
  /// What comes of @p messages with the faults.
  std::vector<Message> disturb(const std::vector<Message>& messages,
                               const std::vector<std::string>& faults,
                               std::uint64_t seed = 1) const {
    std::vector<Fault> parsed;
    for (const std::string& text : faults) parsed.push_back(parseFault(text));
    const auto source = disturbed(std::make_unique<MadeSource>(messages), parsed, container, seed);
    std::vector<Message> given;
    for (Message message; source->next(message);) given.push_back(message);
    return given;
  }
  SensorContainer container;
};

/// Those of one feature.
inline std::vector<Message> only(const std::vector<Message>& messages, const SensorId& id) {
  std::vector<Message> some;
  for (const Message& message : messages)
    if (message.id == id) some.push_back(message);
  return some;
}

}  // namespace ortung::test
