#include "ortung/formats/OdometryData.hpp"

#include "FormatTools.hpp"

namespace ortung {
namespace {

constexpr std::size_t kOwnWords = 5;
constexpr std::size_t kMostMotionWords = 16;

}  // namespace

OdometryData::OdometryData(SensorId id) : SensorData(std::move(id)) {}
OdometryData::~OdometryData() = default;

std::vector<std::uint32_t> OdometryData::encode(const Reading& reading) {
  std::vector<std::uint32_t> out;
  encode(reading, out);
  return out;
}

void OdometryData::encode(const Reading& reading, std::vector<std::uint32_t>& words) {
  words.assign({words::fromSignedMetres(reading.pose.x), words::fromSignedMetres(reading.pose.y),
                words::fromAngle(reading.pose.theta),
                words::fromSignedMetres(reading.translationalVelocity),
                words::fromRate(reading.rotationalVelocity)});
  words.insert(words.end(), reading.motionData.begin(), reading.motionData.end());
}

void OdometryData::check(std::span<const std::uint32_t> words) const {
  if (words.size() < kOwnWords || words.size() > kOwnWords + kMostMotionWords) {
    throw std::invalid_argument("found " + std::to_string(words.size()) +
                                " words, expected 5 to 21");
  }
  checkAngleWord(words[2]);
}

void OdometryData::decode(std::span<const std::uint32_t> words) {
  reading_.pose = {words::toSignedMetres(words[0]), words::toSignedMetres(words[1]),
                   words::toAngle(words[2])};
  reading_.translationalVelocity = words::toSignedMetres(words[3]);
  reading_.rotationalVelocity = words::toRate(words[4]);
  reading_.motionData.assign(words.begin() + kOwnWords, words.end());
}

std::string OdometryData::wordsHelp() const {
  return "[x mm + 2^31, y mm + 2^31, heading 1/100 degree + 18000, translational velocity mm/s + "
         "2^31, "
         "rotational velocity 1/100 degree/s + 2^31], then up to 16 of the motion plugin";
}

}  // namespace ortung
