#include "ortung/formats/OdometryData.hpp"

#include "FormatTools.hpp"

namespace ortung {
namespace {

constexpr std::size_t kOwnWords = 5;
constexpr std::size_t kMostMotionWords = 16;
constexpr std::size_t kLateralWords = 2;

/// Returns whether the last two words are the lateral velocity.
bool tellsLateral(std::span<const std::uint32_t> words) {
  return words.size() >= kOwnWords + kLateralWords &&
         words[words.size() - kLateralWords] == OdometryData::kLateralFollows;
}

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
  const std::uint32_t lateral = words::fromSignedMetres(reading.lateralVelocity);
  // Motion data that happens to look like lateral velocity must not be taken for it.
  if (lateral != words::kOffset || tellsLateral(words))
    words.insert(words.end(), {kLateralFollows, lateral});
}

void OdometryData::check(std::span<const std::uint32_t> words) const {
  const std::size_t most = kOwnWords + kMostMotionWords + (tellsLateral(words) ? kLateralWords : 0);
  if (words.size() < kOwnWords || words.size() > most) {
    throw std::invalid_argument("found " + std::to_string(words.size()) + " words, expected 5 to " +
                                std::to_string(most));
  }
  checkAngleWord(words[2]);
}

void OdometryData::decode(std::span<const std::uint32_t> words) {
  reading_.pose = {words::toSignedMetres(words[0]), words::toSignedMetres(words[1]),
                   words::toAngle(words[2])};
  reading_.translationalVelocity = words::toSignedMetres(words[3]);
  reading_.rotationalVelocity = words::toRate(words[4]);
  const bool lateral = tellsLateral(words);
  reading_.lateralVelocity = lateral ? words::toSignedMetres(words.back()) : 0.0;
  reading_.motionData.assign(
      words.begin() + kOwnWords,
      words.end() - static_cast<std::ptrdiff_t>(lateral ? kLateralWords : 0));
}

Format OdometryData::format() const { return Format(kFormat); }

std::string OdometryData::wordsHelp() const {
  return "[x mm + 2^31, y mm + 2^31, heading 1/100 degree + 18000, translational velocity mm/s + "
         "2^31, "
         "rotational velocity 1/100 degree/s + 2^31], then up to 16 of the motion plugin, then, "
         "while it moves "
         "sideways, 4294967295 and its velocity to the left [mm/s + 2^31]";
}

}  // namespace ortung
