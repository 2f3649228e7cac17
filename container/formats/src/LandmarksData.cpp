#include "ortung/formats/LandmarksData.hpp"

#include <algorithm>
#include <limits>

#include "FormatTools.hpp"
#include "TableWeigher.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWordsASighting = 3;
constexpr std::size_t kMostSightings = 4096;

}  // namespace

LandmarksData::LandmarksData(SensorId id, const Pose2& mount, Config config)
    : SensorData(std::move(id), mount),
      config_(std::move(config)),
      rangeGaussian_(config_.range),
      bearingGaussian_(config_.bearing) {
  std::vector<std::uint32_t> sorted = config_.identities;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    throw std::invalid_argument("the landmarks' identities must be at least one and unique");
  }
  for (std::size_t i = 0; i < sorted.size(); ++i)
    landmarks_.push_back({PositionTable(config_.maxRange), {}});
}

LandmarksData::~LandmarksData() = default;

std::vector<std::uint32_t> LandmarksData::encode(const Reading& reading) {
  std::vector<std::uint32_t> out;
  encode(reading, out);
  return out;
}

void LandmarksData::encode(const Reading& reading, std::vector<std::uint32_t>& out) {
  out.clear();
  out.reserve(reading.size() * kWordsASighting);
  for (const Sighting& sighting : reading) {
    out.push_back(sighting.identity);
    out.push_back(words::fromMetres(sighting.range));
    out.push_back(words::fromAngle(sighting.bearing));
  }
}

void LandmarksData::check(std::span<const std::uint32_t> words) const {
  checkEntries(words, kWordsASighting, kMostSightings,
               "three a sighting and at most 4096 sightings");
  for (std::size_t i = 2; i < words.size(); i += kWordsASighting) checkAngleWord(words[i]);
}

void LandmarksData::decode(std::span<const std::uint32_t> words) {
  reading_.clear();
  for (std::size_t i = 0; i < words.size(); i += kWordsASighting) {
    reading_.push_back({words[i], words::toMetres(words[i + 1]), words::toAngle(words[i + 2])});
  }
}

std::string LandmarksData::wordsHelp() const {
  return "[identity, distance mm, bearing 1/100 degree + 18000] a landmark in sight";
}

double LandmarksData::headingSpacing() const { return spacingOf(config_.fieldOfView); }

std::ptrdiff_t LandmarksData::indexOf(std::uint32_t identity) const {
  const auto it = std::find(config_.identities.begin(), config_.identities.end(), identity);
  return it == config_.identities.end() ? -1 : it - config_.identities.begin();
}

bool LandmarksData::isInformative() const {
  return std::any_of(reading_.begin(), reading_.end(),
                     [this](const Sighting& s) { return indexOf(s.identity) >= 0; });
}

void LandmarksData::startTables(const FieldRegion& region, double) {
  for (Landmark& landmark : landmarks_) {
    landmark.range.start(region.grid);
    landmark.bearing.start(region.grid);
  }
}

void LandmarksData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  for (const Sighting& sighting : reading_) {
    const std::ptrdiff_t index = indexOf(sighting.identity);
    if (index < 0 || sighting.range > config_.maxRange) continue;
    Landmark& landmark = landmarks_[static_cast<std::size_t>(index)];
    landmark.range.learn(sensor.x, sensor.y, sighting.range);
    landmark.bearing.learn(sensor.x, sensor.y, sensor.theta + sighting.bearing);
  }
}

std::vector<double> LandmarksData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  std::vector<double> expected;
  for (const Landmark& landmark : landmarks_) {
    expected.push_back(landmark.range.at(sensor.x, sensor.y));
    expected.push_back(wrapAngle(landmark.bearing.at(sensor.x, sensor.y) - sensor.theta));
  }
  return expected;
}

double LandmarksData::logProbabilityAt(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  const double floor = config_.range.logFloor() + config_.bearing.logFloor();
  double sum = 0.0;
  bool expects = false;
  for (const Sighting& sighting : reading_) {
    const std::ptrdiff_t index = indexOf(sighting.identity);
    if (index < 0) continue;
    const Landmark& landmark = landmarks_[static_cast<std::size_t>(index)];
    const double range = landmark.range.at(sensor.x, sensor.y);
    expects = expects || !std::isnan(range);
    if (std::isnan(range)) {
      sum += floor;  // seen from where nobody ever saw it
      continue;
    }
    const double bearing = landmark.bearing.at(sensor.x, sensor.y) - sensor.theta;
    sum += rangeGaussian_(static_cast<float>((sighting.range - range) /
                                             config_.range.sigmaAt(sighting.range))) +
           bearingGaussian_(
               static_cast<float>(wrapAngle(sighting.bearing - bearing) / config_.bearing.sigma));
  }
  return expects ? sum : std::numeric_limits<double>::quiet_NaN();
}

void LandmarksData::weigh(const SampleView& poses, std::span<float> logProbability) const {
  struct Known {
    const Landmark* landmark;
    float range;
    float bearing;
    float perRangeSigma;
  };
  std::vector<Known> known;
  for (const Sighting& sighting : reading_) {
    const std::ptrdiff_t index = indexOf(sighting.identity);
    if (index < 0) continue;
    known.push_back({&landmarks_[static_cast<std::size_t>(index)],
                     static_cast<float>(sighting.range), static_cast<float>(sighting.bearing),
                     static_cast<float>(1.0 / config_.range.sigmaAt(sighting.range))});
  }
  const auto perBearingSigma = static_cast<float>(1.0 / config_.bearing.sigma);
  TableWeigher weigher(landmarks_.front().range.cells().grid());
  forEachPoseBlock<TableWeigher::kBlock>(
      poses, mount(), [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
        float* out = logProbability.data() + first;
        weigher.start(sensor, n);
        for (const Known& k : known) {
          weigher.addDistance(k.landmark->range, rangeGaussian_, k.range, k.perRangeSigma, out);
          weigher.addBearing(k.landmark->bearing, bearingGaussian_, k.bearing, perBearingSigma,
                             out);
        }
      });
}

std::string LandmarksData::learningKey() const {
  std::string key = "landmarks max_range_m=" + keyNumber(config_.maxRange) +
                    " fov_rad=" + keyNumber(config_.fieldOfView) + " " + mountKey(mount()) +
                    " identities=";
  for (const std::uint32_t identity : config_.identities) key += std::to_string(identity) + ",";
  key.pop_back();
  return key;
}

void LandmarksData::saveTables(TableWriter& file, const std::string& prefix) const {
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const std::string name = prefix + std::to_string(config_.identities[i]);
    landmarks_[i].range.cells().save(file, name + ".distance");
    landmarks_[i].bearing.cells().save(file, name + ".direction");
  }
}

void LandmarksData::useTables(const TableFile& file, const std::string& prefix,
                              const FieldGrid& grid) {
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const std::string name = prefix + std::to_string(config_.identities[i]);
    landmarks_[i].range.cells().load(file, name + ".distance", grid);
    landmarks_[i].bearing.cells().load(file, name + ".direction", grid);
  }
}

}  // namespace ortung
