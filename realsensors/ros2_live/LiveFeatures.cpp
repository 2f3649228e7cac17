#include "LiveFeatures.hpp"

#include <cmath>
#include <stdexcept>

#include "FrameTree.hpp"
#include "LiveImages.hpp"
#include "ReadingMessages.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/ros2/Messages.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

template <class M>
M decoded(std::string_view cdr) {
  std::string why;
  const auto message = fromCdr<M>(cdr, why);
  if (!message) throw std::invalid_argument("no message: " + why);
  return *message;
}

Message readRange(std::string_view cdr, const SensorId& feature, double maxRange) {
  const auto told = decoded<Range>(cdr);
  return {stampOf(told.header), feature, {ConeData::encode(metresOf(told), maxRange)}};
}

Message readFix(std::string_view cdr, const SensorId& feature, const std::string& map,
                const std::function<Pose2(const Pose2&)>& toField) {
  const auto told = decoded<PoseWithCovarianceStamped>(cdr);
  if (told.header.frame != map)
    throw std::invalid_argument("a pose in '" + told.header.frame + "', expected '" + map + "'");
  PoseFixData::Fix fix{toPose2(told.pose), toPlane(told.covariance)};
  bool isSound = isPlausible(fix.pose);
  for (const double value : fix.covariance) isSound = isSound && std::abs(value) <= 1e12;
  for (std::size_t diagonal = 0; diagonal < 9; diagonal += 4)
    isSound = isSound && fix.covariance[diagonal] >= 0.0;
  if (!isSound) throw std::invalid_argument("a pose or covariance that is none");
  if (toField) fix.pose = toField(fix.pose);
  return {stampOf(told.header), feature, PoseFixData::encode(std::span(&fix, 1))};
}

/// The size of the pictures that a feature takes; 0 x 0: any.
ImageSize sizeIn(const Format& format) {
  if (!format.has("width") || !format.has("height")) return {0, 0};
  return {static_cast<int>(format.number("width")), static_cast<int>(format.number("height"))};
}

}  // namespace

Timestamp stampOf(const Header& header) {
  return header.stamp / 1000 - (header.stamp % 1000 < 0 ? 1 : 0);
}

std::string topicOf(const std::string& text) { return text.substr(0, text.find('=')); }

LiveFeature liveFeatureOf(const SensorContainer& container, const std::string& text,
                          const std::string& map,
                          const std::function<Pose2(const Pose2&)>& toField) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0)
    throw std::invalid_argument(text + ": expected TOPIC=MODEL/TYPE/FEATURE");
  const SensorId id = parseSensorId(text.substr(equals + 1));
  const SensorData* const data = container.findExactly(id);
  if (data == nullptr)
    throw std::invalid_argument(text + ": the robot file has no feature of that name");
  const Format format = data->format();
  LiveFeature found{topicOf(text), "", id, {}};
  if (format.name() == formats::kCone) {
    found.type = Range::kType;
    found.read = [id, most = format.number("max_m")](std::string_view cdr) {
      return readRange(cdr, id, most);
    };
  } else if (format.name() == formats::kFix) {
    found.type = PoseWithCovarianceStamped::kType;
    found.read = [id, map, toField](std::string_view cdr) {
      return readFix(cdr, id, map, toField);
    };
  } else if (format.name() == formats::kImage) {
    found.type = Image::kType;
    found.read = [id, size = sizeIn(format)](std::string_view cdr) -> Message {
      const auto image = decoded<Image>(cdr);
      return {stampOf(image.header), id, wordsOf(image, size)};
    };
  } else {
    throw std::invalid_argument(text + ": no message of ROS 2 fills a feature of the format " +
                                std::string(format.name()) + ", expected " + formats::kCone + ", " +
                                formats::kFix + " or " + formats::kImage);
  }
  return found;
}

}  // namespace ortung::ros2
