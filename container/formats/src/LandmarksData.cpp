#include "ortung/formats/LandmarksData.hpp"

#include <algorithm>
#include <limits>

#include "FormatTools.hpp"
#include "TableSlope.hpp"
#include "TableWeigher.hpp"
#include "UnidentifiedSight.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {
namespace {

constexpr std::size_t kWordsASighting = 3;
constexpr std::size_t kMostSightings = 4096;

}  // namespace

struct LandmarksData::Model {
  explicit Model(const Config& c)
      : range(c.range),
        bearing(c.bearing),
        ranges(c.range),
        bearings(c.bearing),
        unidentified(std::make_shared<UnidentifiedSight::Model>(c.range, c.bearing)) {}
  SensorModel range;
  SensorModel bearing;
  GaussianTable ranges;
  GaussianTable bearings;
  std::shared_ptr<const UnidentifiedSight::Model> unidentified;
};

struct LandmarksData::Tables {
  struct Landmark {
    PositionTable range;
    BearingTable bearing;
  };
  explicit Tables(const Config& config) {
    if (!config.identified) return;
    landmarks.reserve(config.identities.size());
    for (std::size_t i = 0; i < config.identities.size(); ++i)
      landmarks.push_back({PositionTable(config.maxRange), {}});
  }
  /// Tables in the order of the identities; empty if unidentified.
  std::vector<Landmark> landmarks;
  std::shared_ptr<LandmarkPlaces> places = std::make_shared<LandmarkPlaces>();
};

class LandmarksData::Sight final : public Weigher, public Polishable, public Correctable {
 public:
  Sight(std::shared_ptr<const Model> model, std::shared_ptr<const Tables> tables,
        const Pose2& mount)
      : model_(std::move(model)), tables_(std::move(tables)), mount_(mount) {}

  void add(std::size_t index, const Sighting& sighting) {
    known_.push_back({&tables_->landmarks[index], sighting.range, sighting.bearing,
                      model_->range.sigmaAt(sighting.range)});
  }
  bool isEmpty() const { return known_.empty(); }

 private:
  struct Known {
    const Tables::Landmark* landmark;
    double range;    ///< [m]
    double bearing;  ///< [rad]
    double sigma;    ///< standard deviation of the range [m]
  };

  double logProbabilityAt(const Pose2& pose) const override {
    const Pose2 sensor = pose * mount_;
    const double floor = model_->range.logFloor() + model_->bearing.logFloor();
    double sum = 0.0;
    bool expects = false;
    for (const Known& k : known_) {
      const double range = k.landmark->range.at(sensor.x, sensor.y);
      expects = expects || !std::isnan(range);
      if (std::isnan(range)) {
        sum += floor;  // it was never seen from there
        continue;
      }
      const double bearing = k.landmark->bearing.at(sensor.x, sensor.y) - sensor.theta;
      sum += model_->ranges(static_cast<float>((k.range - range) / k.sigma)) +
             model_->bearings(
                 static_cast<float>(wrapAngle(k.bearing - bearing) / model_->bearing.sigma));
    }
    return expects ? sum : std::numeric_limits<double>::quiet_NaN();
  }

  void weigh(const SampleView& poses, std::span<float> logProbability) const override {
    const auto perBearingSigma = static_cast<float>(1.0 / model_->bearing.sigma);
    TableWeigher weigher(tables_->landmarks.front().range.cells().grid());
    forEachPoseBlock<TableWeigher::kBlock>(
        poses, mount_, [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
          float* out = logProbability.data() + first;
          weigher.start(sensor, n);
          for (const Known& k : known_) {
            weigher.addDistance(k.landmark->range, model_->ranges, static_cast<float>(k.range),
                                static_cast<float>(1.0 / k.sigma), out);
            weigher.addBearing(k.landmark->bearing, model_->bearings, static_cast<float>(k.bearing),
                               perBearingSigma, out);
          }
        });
  }

  Slope slopeAt(const Pose2& robot) const override {
    const Pose2 sensor = robot * mount_;
    Slope slope;
    for (const Known& k : known_) {
      addReading(slope, k.landmark->range, k.range, k.sigma, model_->range, robot, sensor);
      addReading(slope, k.landmark->bearing, k.bearing, model_->bearing.sigma, model_->bearing,
                 robot, sensor);
    }
    return slope;
  }

  void residualsAt(const Pose2& robot, std::vector<ReadingResidual>& residuals) const override {
    const Pose2 sensor = robot * mount_;
    const auto add = [&](const std::optional<ReadingResidual>& one) {
      if (one) residuals.push_back(*one);
    };
    for (const Known& k : known_) {
      add(residualOf(k.landmark->range, k.range, k.sigma, model_->range, robot, sensor));
      add(residualOf(k.landmark->bearing, k.bearing, model_->bearing.sigma, model_->bearing, robot,
                     sensor));
    }
  }

  std::shared_ptr<const Weigher> corrected(const DeviceBias& bias) const override {
    auto without = std::make_shared<Sight>(model_, tables_, mount_);
    without->known_ = known_;
    for (Known& k : without->known_) {
      k.range = bias.distance(k.range);
      k.bearing = bias.bearing(k.bearing);
    }
    return without;
  }

  std::shared_ptr<const Model> model_;
  std::shared_ptr<const Tables> tables_;
  Pose2 mount_;
  std::vector<Known> known_;
};

LandmarksData::LandmarksData(SensorId id, const Pose2& mount, Config config)
    : SensorData(std::move(id), mount),
      config_(std::move(config)),
      model_(std::make_shared<Model>(config_)),
      tables_(std::make_shared<Tables>(config_)) {
  std::vector<std::uint32_t> sorted = config_.identities;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    throw std::invalid_argument("the landmarks' identities must be at least one and unique");
  }
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

Format LandmarksData::format() const { return Format(formats::kLandmarks); }

std::string LandmarksData::wordsHelp() const {
  return "[identity, distance mm, bearing 1/100 degree + 18000] a landmark in sight, or none: "
         "looked and saw nothing";
}

double LandmarksData::headingSpacing() const { return spacingOf(config_.fieldOfView); }

LandmarksData::Sighting LandmarksData::corrected(const Sighting& sighting) const {
  const auto [range, bearing] = config_.bias.corrected({sighting.range, sighting.bearing});
  return {sighting.identity, range, bearing};
}

std::ptrdiff_t LandmarksData::indexOf(std::uint32_t identity) const {
  const auto it = std::find(config_.identities.begin(), config_.identities.end(), identity);
  return it == config_.identities.end() ? -1 : it - config_.identities.begin();
}

std::ptrdiff_t LandmarksData::indexOf(const Sighting& sighting, const Pose2& pose) const {
  if (config_.identified || sighting.identity != kUnknown) return indexOf(sighting.identity);
  if (tables_->places->isEmpty()) return -1;
  const Pose2 sensor = pose * mount();
  const Sighting truly = corrected(sighting);
  const double angle = sensor.theta + truly.bearing;
  const std::uint16_t which = tables_->places->nearestTo(sensor.x + truly.range * std::cos(angle),
                                                         sensor.y + truly.range * std::sin(angle));
  return which == LandmarkPlaces::kNone ? -1 : which;
}

void LandmarksData::startTables(const FieldRegion& region, double) {
  tables_ = std::make_shared<Tables>(config_);
  if (!config_.identified) tables_->places->start(region.grid, config_.identities.size());
  for (Tables::Landmark& landmark : tables_->landmarks) {
    landmark.range.start(region.grid);
    landmark.bearing.start(region.grid);
  }
}

void LandmarksData::learn(const Pose2& robotInField) {
  const Pose2 sensor = robotInField * mount();
  for (const Sighting& sighting : reading_) {
    const std::ptrdiff_t index = indexOf(sighting.identity);
    if (index < 0 || sighting.range > config_.maxRange) continue;
    if (!config_.identified) {
      const double angle = sensor.theta + sighting.bearing;
      tables_->places->mark(static_cast<std::size_t>(index),
                            sensor.x + sighting.range * std::cos(angle),
                            sensor.y + sighting.range * std::sin(angle));
      continue;
    }
    Tables::Landmark& landmark = tables_->landmarks[static_cast<std::size_t>(index)];
    landmark.range.learn(sensor.x, sensor.y, sighting.range);
    landmark.bearing.learn(sensor.x, sensor.y, sensor.theta + sighting.bearing);
  }
}

void LandmarksData::finishTables() {
  if (!config_.identified) tables_->places->finish();
}

std::vector<double> LandmarksData::measured(const Pose2& pose) const {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> measured(2 * config_.identities.size(), kNothing);
  for (const Sighting& sighting : reading_) {
    const std::ptrdiff_t found = indexOf(sighting, pose);
    if (found < 0) continue;
    const Sighting truly = corrected(sighting);
    measured[2 * static_cast<std::size_t>(found)] = truly.range;
    measured[2 * static_cast<std::size_t>(found) + 1] = truly.bearing;
  }
  return measured;
}

std::vector<WordValue> LandmarksData::valuesIn(std::span<const std::uint32_t> words) const {
  std::vector<WordValue> values;
  const double half = halfViewOf(config_.fieldOfView);
  for (std::size_t i = 0; i + kWordsASighting <= words.size(); i += kWordsASighting) {
    const std::size_t entry = i / kWordsASighting;
    values.push_back({i, entry, ValueKind::kIdentity, static_cast<double>(indexOf(words[i])), 0.0,
                      static_cast<double>(config_.identities.size())});
    values.push_back(
        {i + 1, entry, ValueKind::kRange, words::toMetres(words[i + 1]), 0.0, config_.maxRange});
    values.push_back(
        {i + 2, entry, ValueKind::kBearing, words::toAngle(words[i + 2]), -half, half});
  }
  return values;
}

/// Stores a value; that of an identity is its place in the list.
void LandmarksData::store(const WordValue& value, std::span<std::uint32_t> words) const {
  if (value.kind != ValueKind::kIdentity) return SensorData::store(value, words);
  if (!(value.value >= 0.0)) return;  // an identity that is not in the list stays as it is
  const auto index = static_cast<std::size_t>(value.value);
  words[value.word] = config_.identities[std::min(index, config_.identities.size() - 1)];
}

std::vector<double> LandmarksData::expectation(const Pose2& pose) const {
  const Pose2 sensor = pose * mount();
  std::vector<double> expected;
  const LandmarkPlaces& places = *tables_->places;
  for (std::size_t i = 0; !places.isEmpty() && i < config_.identities.size(); ++i) {
    const double dx = places.x(i) - sensor.x;
    const double dy = places.y(i) - sensor.y;
    const double range = std::hypot(dx, dy);
    const bool isSeen = range <= config_.maxRange;
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    expected.push_back(isSeen ? range : kNothing);
    expected.push_back(isSeen ? wrapAngle(std::atan2(dy, dx) - sensor.theta) : kNothing);
  }
  for (const Tables::Landmark& landmark : tables_->landmarks) {
    expected.push_back(landmark.range.at(sensor.x, sensor.y));
    expected.push_back(wrapAngle(landmark.bearing.at(sensor.x, sensor.y) - sensor.theta));
  }
  return expected;
}

std::shared_ptr<const Weigher> LandmarksData::makeWeigher() const {
  if (!config_.identified) {
    if (tables_->places->isEmpty()) return nullptr;
    auto all = std::make_shared<UnidentifiedSight>(model_->unidentified, tables_->places, mount());
    for (const Sighting& sighting : reading_) {
      const auto [identity, range, bearing] = corrected(sighting);
      if (range <= config_.maxRange) all->add(range, bearing);
    }
    return all->isEmpty() ? nullptr : all;
  }
  auto sight = std::make_shared<Sight>(model_, tables_, mount());
  for (const Sighting& sighting : reading_) {
    const std::ptrdiff_t index = indexOf(sighting.identity);
    if (index >= 0) sight->add(static_cast<std::size_t>(index), corrected(sighting));
  }
  return sight->isEmpty() ? nullptr : sight;
}

std::string LandmarksData::learningKey() const {
  std::string key = "landmarks max_range_m=" + keyNumber(config_.maxRange) +
                    " fov_rad=" + keyNumber(config_.fieldOfView) + " " + mountKey(mount()) +
                    " identities=";
  for (const std::uint32_t identity : config_.identities) key += std::to_string(identity) + ",";
  key.pop_back();
  return config_.identified ? key : key + " unidentified";
}

void LandmarksData::saveTables(TableWriter& file, const std::string& prefix) const {
  if (!config_.identified) tables_->places->save(file, prefix);
  for (std::size_t i = 0; i < tables_->landmarks.size(); ++i) {
    const std::string name = prefix + std::to_string(config_.identities[i]);
    tables_->landmarks[i].range.cells().save(file, name + ".distance");
    tables_->landmarks[i].bearing.cells().save(file, name + ".direction");
  }
}

void LandmarksData::useTables(const std::shared_ptr<const TableFile>& file,
                              const std::string& prefix, const FieldGrid& grid) {
  auto tables = std::make_shared<Tables>(config_);
  if (!config_.identified) tables->places->load(file, prefix, grid, config_.identities.size());
  for (std::size_t i = 0; i < tables->landmarks.size(); ++i) {
    const std::string name = prefix + std::to_string(config_.identities[i]);
    tables->landmarks[i].range.cells().load(file, name + ".distance", grid);
    tables->landmarks[i].bearing.cells().load(file, name + ".direction", grid);
  }
  tables_ = std::move(tables);
}

}  // namespace ortung
