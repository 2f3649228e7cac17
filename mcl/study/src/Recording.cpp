#include "ortung/study/Recording.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include "ortung/formats/PoseData.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/study/Verdict.hpp"

namespace ortung {

Recording::Recording(std::string name, Source& source)
    : name_(std::move(name)), worldFingerprint_(source.worldFingerprint()) {
  if (source.isLive())
    throw std::invalid_argument(name_ +
                                ": is live, so its readings come once; expected a source "
                                "that can be played again, such as a record");
  if (source.progress() < 0.0)
    throw std::invalid_argument(name_ + ": has no end, expected a source that has one");
  FrameReader reader(source);
  std::vector<Message> frame;
  std::optional<SensorId> truthId;
  DistanceMeter meter;
  std::size_t bytes = 0;
  while (reader.next(frame)) {
    bool hasTruth = false;
    const std::size_t moment = messages_.size();
    for (Message& message : frame) {
      if (message.id.type == kGroundTruth && (!truthId || *truthId == message.id) && !hasTruth) {
        truthId = message.id;
        hasTruth = true;
        PoseData truth(message.id);
        truth.setData(message.stamp, message.words);
        const Pose2 pose = truth.reading();
        truth_.push_back({message.stamp, pose, meter.add(pose), moment});
      }
      bytes += sizeof(Message) + message.words.size() * sizeof(std::uint32_t);
      if (bytes > kMostBytes) throw std::runtime_error(name_ + ": has more than 4 GiB of readings");
      messages_.push_back(std::move(message));
    }
  }
}

Recording::~Recording() = default;

}  // namespace ortung
