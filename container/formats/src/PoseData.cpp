#include "ortung/formats/PoseData.hpp"

#include "FormatTools.hpp"

namespace ortung {

PoseData::PoseData(SensorId id) : SensorData(std::move(id)) {}
PoseData::~PoseData() = default;

std::vector<std::uint32_t> PoseData::encode(const Pose2& pose) {
  std::vector<std::uint32_t> out;
  encode(pose, out);
  return out;
}

void PoseData::encode(const Pose2& pose, std::vector<std::uint32_t>& words) {
  words.assign({words::fromSignedMetres(pose.x), words::fromSignedMetres(pose.y),
                words::fromAngle(pose.theta)});
}

void PoseData::check(std::span<const std::uint32_t> words) const {
  checkWordCount(words, 3);
  checkAngleWord(words[2]);
}

void PoseData::decode(std::span<const std::uint32_t> words) {
  reading_ = {words::toSignedMetres(words[0]), words::toSignedMetres(words[1]),
              words::toAngle(words[2])};
}

Format PoseData::format() const { return Format(kFormat); }

std::string PoseData::wordsHelp() const {
  return "[x mm + 2^31, y mm + 2^31, heading 1/100 degree + 18000] in the field frame";
}

}  // namespace ortung
