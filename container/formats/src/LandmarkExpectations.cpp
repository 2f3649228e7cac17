#include "LandmarkExpectations.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "FormatTools.hpp"
#include "TableSlope.hpp"
#include "TableWeigher.hpp"

namespace ortung {

LandmarkExpectations::Model::Model(const LandmarksData::Config& config)
    : range(config.range),
      bearing(config.bearing),
      ranges(config.range),
      bearings(config.bearing),
      unidentified(std::make_shared<UnidentifiedSight::Model>(config.range, config.bearing)) {}

LandmarkExpectations::Tables::Tables(const LandmarksData::Config& config) {
  if (!config.identified) return;
  landmarks.reserve(config.identities.size());
  for (std::size_t i = 0; i < config.identities.size(); ++i)
    landmarks.push_back({PositionTable(config.maxRange), {}});
}

void LandmarkExpectations::Tables::complete() {
  std::vector<LandmarkLevels::Tables> tables;
  for (const Landmark& landmark : landmarks) tables.push_back({landmark.range, landmark.bearing});
  levels = LandmarkLevels(tables);
}

class LandmarkExpectations::Sight final : public Weigher, public Polishable, public Correctable {
 public:
  Sight(std::shared_ptr<const Model> model, std::shared_ptr<const Tables> tables,
        const Pose2& mount)
      : model_(std::move(model)), tables_(std::move(tables)), mount_(mount) {}

  void add(std::size_t index, const LandmarksData::Sighting& sighting) {
    known_.push_back({index, &tables_->landmarks[index], sighting.range, sighting.bearing,
                      model_->range.sigmaAt(sighting.range)});
  }
  bool isEmpty() const { return known_.empty(); }

 private:
  struct Known {
    std::size_t index;  ///< of the landmark
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
    const bool isList = !tables_->levels.isEmpty();
    TableWeigher weigher(tables_->landmarks.front().range.cells().grid());
    forEachPoseBlock<TableWeigher::kBlock>(
        poses, mount_, [&](std::size_t first, const SensorPoses& sensor, std::size_t n) {
          weigher.start(sensor, n, logProbability.data() + first,
                        isList ? &tables_->levels : nullptr);
          for (const Known& k : known_) isList ? addFromList(weigher, k) : addByTables(weigher, k);
          weigher.finish();
        });
  }

  void addFromList(TableWeigher& weigher, const Known& k) const {
    weigher.addLandmark(
        k.index, static_cast<float>(k.landmark->range.metresPerLevel()),
        {model_->ranges, static_cast<float>(k.range), perSigma(k.sigma)},
        {model_->bearings, static_cast<float>(k.bearing), perSigma(model_->bearing.sigma)});
  }

  void addByTables(TableWeigher& weigher, const Known& k) const {
    weigher.addDistance(k.landmark->range, model_->ranges, static_cast<float>(k.range),
                        perSigma(k.sigma));
    weigher.addBearing(k.landmark->bearing, model_->bearings, static_cast<float>(k.bearing),
                       perSigma(model_->bearing.sigma));
  }

  static float perSigma(double sigma) { return static_cast<float>(1.0 / sigma); }

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

LandmarkExpectations::LandmarkExpectations(const LandmarksData& landmarks,
                                           const LandmarksData::Config& config)
    : landmarks_(landmarks),
      model_(std::make_shared<Model>(config)),
      tables_(std::make_shared<Tables>(config)) {}

std::string LandmarkExpectations::key() const {
  const LandmarksData::Config& config = landmarks_.config();
  std::string key = "landmarks max_range_m=" + keyNumber(config.maxRange) +
                    " fov_rad=" + keyNumber(config.fieldOfView) + " " +
                    mountKey(landmarks_.mount()) + " identities=";
  for (const std::uint32_t identity : config.identities) key += std::to_string(identity) + ",";
  key.pop_back();
  return config.identified ? key : key + " unidentified";
}

double LandmarkExpectations::headingSpacing() const {
  return spacingOf(landmarks_.config().fieldOfView);
}

void LandmarkExpectations::start(const FieldRegion& region, double) {
  const LandmarksData::Config& config = landmarks_.config();
  tables_ = std::make_shared<Tables>(config);
  if (!config.identified) tables_->places->start(region.grid, config.identities.size());
  for (Tables::Landmark& landmark : tables_->landmarks) {
    landmark.range.start(region.grid);
    landmark.bearing.start(region.grid);
  }
}

void LandmarkExpectations::learn(const Pose2& sensor) {
  const LandmarksData::Config& config = landmarks_.config();
  for (const LandmarksData::Sighting& sighting : landmarks_.reading()) {
    const std::ptrdiff_t index = landmarks_.indexOf(sighting.identity);
    if (index < 0 || sighting.range > config.maxRange) continue;
    if (!config.identified) {
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

void LandmarkExpectations::finish() {
  if (landmarks_.config().identified)
    tables_->complete();
  else
    tables_->places->finish();
}

void LandmarkExpectations::save(TableWriter& file, const std::string& prefix) const {
  const LandmarksData::Config& config = landmarks_.config();
  if (!config.identified) tables_->places->save(file, prefix);
  for (std::size_t i = 0; i < tables_->landmarks.size(); ++i) {
    const std::string name = prefix + std::to_string(config.identities[i]);
    tables_->landmarks[i].range.cells().save(file, name + ".distance");
    tables_->landmarks[i].bearing.cells().save(file, name + ".direction");
  }
}

void LandmarkExpectations::load(const std::shared_ptr<const TableFile>& file,
                                const std::string& prefix, const FieldGrid& grid) {
  const LandmarksData::Config& config = landmarks_.config();
  auto tables = std::make_shared<Tables>(config);
  if (!config.identified) tables->places->load(file, prefix, grid, config.identities.size());
  for (std::size_t i = 0; i < tables->landmarks.size(); ++i) {
    const std::string name = prefix + std::to_string(config.identities[i]);
    tables->landmarks[i].range.cells().load(file, name + ".distance", grid);
    tables->landmarks[i].bearing.cells().load(file, name + ".direction", grid);
  }
  tables->complete();
  tables_ = std::move(tables);
}

std::vector<double> LandmarkExpectations::at(const Pose2& sensor) const {
  const LandmarksData::Config& config = landmarks_.config();
  std::vector<double> expected;
  for (std::size_t i = 0; !places().isEmpty() && i < config.identities.size(); ++i) {
    const double dx = places().x(i) - sensor.x;
    const double dy = places().y(i) - sensor.y;
    const double range = std::hypot(dx, dy);
    const bool isSeen = range <= config.maxRange;
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

std::shared_ptr<const Weigher> LandmarkExpectations::weigher() const {
  if (!landmarks_.config().identified) {
    if (places().isEmpty()) return nullptr;
    auto all = std::make_shared<UnidentifiedSight>(model_->unidentified, tables_->places,
                                                   landmarks_.mount());
    for (const LandmarksData::Sighting& sighting : landmarks_.reading()) {
      const auto [identity, range, bearing] = landmarks_.corrected(sighting);
      if (range <= landmarks_.config().maxRange) all->add(range, bearing);
    }
    return all->isEmpty() ? nullptr : all;
  }
  auto sight = std::make_shared<Sight>(model_, tables_, landmarks_.mount());
  for (const LandmarksData::Sighting& sighting : landmarks_.reading()) {
    const std::ptrdiff_t index = landmarks_.indexOf(sighting.identity);
    if (index >= 0) sight->add(static_cast<std::size_t>(index), landmarks_.corrected(sighting));
  }
  return sight->isEmpty() ? nullptr : sight;
}

}  // namespace ortung
