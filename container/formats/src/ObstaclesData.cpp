#include "ortung/formats/ObstaclesData.hpp"

#include "FormatTools.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWordsAnObstacle = 5;

}  // namespace

ObstaclesData::ObstaclesData(SensorId id, const Pose2& mount) : SensorData(std::move(id), mount) {}
ObstaclesData::~ObstaclesData() = default;

std::vector<std::uint32_t> ObstaclesData::encode(std::span<const Obstacle> obstacles) {
  std::vector<std::uint32_t> out;
  out.reserve(obstacles.size() * kWordsAnObstacle);
  for (const Obstacle& o : obstacles) {
    const bool isCircle = o.shape == Shape::kCircle;
    out.push_back(static_cast<std::uint32_t>(o.shape));
    out.push_back(words::fromSignedMetres(o.x));
    out.push_back(words::fromSignedMetres(o.y));
    out.push_back(isCircle ? words::fromMetres(o.radius) : words::fromSignedMetres(o.endX));
    out.push_back(isCircle ? 0 : words::fromSignedMetres(o.endY));
  }
  return out;
}

void ObstaclesData::check(std::span<const std::uint32_t> words) const {
  checkEntries(words, kWordsAnObstacle, kMostObstacles,
               "five an obstacle and at most 1024 obstacles");
  for (std::size_t i = 0; i < words.size(); i += kWordsAnObstacle)
    if (words[i] > 1)
      throw std::invalid_argument("found the shape " + std::to_string(words[i]) +
                                  ", expected 0 for a circle or 1 for a segment");
}

void ObstaclesData::decode(std::span<const std::uint32_t> words) {
  reading_.clear();
  for (std::size_t i = 0; i < words.size(); i += kWordsAnObstacle) {
    const std::span<const std::uint32_t> w = words.subspan(i, kWordsAnObstacle);
    Obstacle o;
    o.shape = static_cast<Shape>(w[0]);
    o.x = words::toSignedMetres(w[1]);
    o.y = words::toSignedMetres(w[2]);
    if (o.shape == Shape::kCircle) {
      o.radius = words::toMetres(w[3]);
    } else {
      o.endX = words::toSignedMetres(w[3]);
      o.endY = words::toSignedMetres(w[4]);
    }
    reading_.push_back(o);
  }
}

Format ObstaclesData::format() const { return Format(kFormat); }

std::string ObstaclesData::wordsHelp() const {
  return "[0, x mm + 2^31, y mm + 2^31, radius mm, 0] a circle, [1, x, y, x, y of both ends mm + "
         "2^31] a segment";
}

}  // namespace ortung
