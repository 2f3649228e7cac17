#include "ortung/run/Localization.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "BeliefFile.hpp"
#include "EstimateData.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/formats/ChangesData.hpp"
#include "ortung/formats/ClustersData.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/SamplesData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/formats/WorkData.hpp"
#include "ortung/run/OpenSource.hpp"
#include "ortung/run/Published.hpp"
#include "ortung/tables/FieldParts.hpp"

namespace ortung {
namespace {

/// Time between two calls of a program that asks for estimates [us].
constexpr Timestamp kAsking = 100'000;
constexpr Timestamp kTellingMap = 1'000'000;  ///< least time between two readings of the map [us]
constexpr Timestamp kTellingMapAgain = 2'000'000;  ///< time after which one is told again [us]

MclConfig readMcl(const LocalizationConfig& config, const RobotConfig& robot) {
  MclConfig mcl = MclConfig::read(robot.mcl);
  mcl.seed = config.seed;
  if (config.threads) mcl.threads = *config.threads;
  if (config.particles) {
    mcl.maxSamples = *config.particles;
    if (mcl.minSamples > mcl.maxSamples) mcl.minSamples = mcl.maxSamples;
  }
  mcl.check();
  return mcl;
}

std::unique_ptr<MotionModel> readMotion(const LocalizationConfig& config, Robot& robot) {
  return makeMotion(config.motion.value_or(robot.config.motion), robot.factory);
}

double millisecondsOnTheClock() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string metres(double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

/// @param what the pose is, for the error
/// @throws std::invalid_argument if the robot can't stand there nor near by
void checkPlace(const FieldRegion& region, const Pose2& pose, double sigma,
                const std::string& what) {
  if (!isFinite(pose)) throw std::invalid_argument(what + " is not a number");
  const FieldGrid& grid = region.grid;
  const double near = 3.0 * sigma + grid.cell;
  if (canStandNear(region, pose.x, pose.y, near)) return;
  const std::string place = what + " (" + metres(pose.x) + ", " + metres(pose.y) + ") m";
  if (grid.cellAt(pose.x, pose.y) < 0)
    throw std::invalid_argument(place + " is off the map, which reaches from (" +
                                metres(grid.originX) + ", " + metres(grid.originY) + ") to (" +
                                metres(grid.originX + grid.columns * grid.cell) + ", " +
                                metres(grid.originY + grid.rows * grid.cell) + ") m");
  throw std::invalid_argument(place + " is where the robot can't stand, nor within " +
                              metres(near) + " m of it (3 sigma)");
}

void checkSigmas(const char* of, double position, double heading) {
  if (position >= 0.0 && heading >= 0.0 && std::isfinite(position) && std::isfinite(heading))
    return;
  throw std::invalid_argument(std::string(of) + ": sigmas are " + std::to_string(position) +
                              " m and " + std::to_string(heading) + " rad, expected numbers >= 0");
}

/// Returns the effective number of samples, 1 / sum w^2.
double worthOf(const SampleSet& samples) {
  if (samples.size() == 0) return 0.0;
  const float best = *std::max_element(samples.logWeight.begin(), samples.logWeight.end());
  double sum = 0.0;
  double squares = 0.0;
  for (const float logWeight : samples.logWeight) {
    const double weight = std::exp(static_cast<double>(logWeight - best));
    sum += weight;
    squares += weight * weight;
  }
  return std::isfinite(sum) ? sum * sum / squares : static_cast<double>(samples.size());
}

/// Moves each sample by normal noise.
void widen(double sigmaPosition, double sigmaHeading, std::uint64_t seed, SampleSet& samples) {
  constexpr std::uint64_t kStream = 0x62656c696566;  // differs from all other streams of that seed
  Random random(seed, kStream);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples.x[i] += static_cast<float>(sigmaPosition * random.gaussian());
    samples.y[i] += static_cast<float>(sigmaPosition * random.gaussian());
    samples.theta[i] = static_cast<float>(
        wrapAngle(static_cast<double>(samples.theta[i]) + sigmaHeading * random.gaussian()));
  }
}

}  // namespace

WorldMismatch::~WorldMismatch() = default;

void addPublishedFeatures(SensorContainer& container) {
  container.add(std::make_unique<EstimateData>());
  container.add(std::make_unique<PoseData>(kSmoothId));
  container.add(std::make_unique<TrackData>());
  container.add(std::make_unique<ProtectionData>());
  container.add(std::make_unique<ClustersData>());
  container.add(std::make_unique<ChangesData>());
  container.add(std::make_unique<WorkData>());
  container.add(std::make_unique<SamplesData>());
}

Localization::Opened Localization::open(const LocalizationConfig& config) {
  Opened opened{openRobot(config.robot, config.tables), nullptr};
  if (!config.source.empty())
    opened.source = openSource(config.source, config.robot, opened.robot->factory);
  return opened;
}

Localization::Localization(const LocalizationConfig& config) : Localization(open(config), config) {}

Localization::Localization(std::unique_ptr<Robot> robot, std::unique_ptr<Source> source,
                           const LocalizationConfig& config)
    : Localization(Opened{std::move(robot), std::move(source)}, config) {}

Localization::Localization(Opened opened, const LocalizationConfig& config)
    : sourceName_(config.source),
      robot_(std::move(opened.robot)),
      source_(std::move(opened.source)),
      mclConfig_(readMcl(config, robot_->config)),
      filter_(config.filter),
      mcl_(std::make_unique<Mcl>(mclConfig_, robot_->tables.region, readMotion(config, *robot_))),
      publishes_(config.publish) {
  for (const auto& data : robot_->container.all())
    if (odometry_ == nullptr && isOf(*data, formats::kOdometry)) odometry_ = data.get();
  if (config.keepsTime) mcl_->keepTime(millisecondsOnTheClock);
  if (filter_ != LocalizationFilter::kMcl)
    grid_ = std::make_unique<GridFilter>(mclConfig_, config.grid, robot_->tables.region,
                                         readMotion(config, *robot_));
  if (publishes_) {
    requireMcl("publish");
    addPublishedFeatures(robot_->container);
  }
  if (source_) feeder_ = std::make_unique<Feeder>(sourceName_, *source_, robot_->container);
  checkWorld(config);
  start(config.start);
}

Localization::~Localization() = default;

void Localization::checkWorld(const LocalizationConfig& config) {
  const TableInfo& tables = robot_->tables;
  const std::string world = source_ ? source_->worldFingerprint() : "";
  if (world.empty() || tables.worldFingerprint.empty() || world == tables.worldFingerprint) return;
  worldMismatch_ = sourceName_ + ": comes from the world " + world + ", but " +
                   config.tables.string() + " was learned in the world " + tables.worldFingerprint +
                   " ('" + tables.world + "')";
  if (!config.anyWorld)
    throw WorldMismatch(worldMismatch_ + "; learn the tables in the same world, or set anyWorld");
}

void Localization::start(const LocalizationStart& start) {
  checkSigmas("start", start.sigmaPosition, start.sigmaHeading);
  start_ = start;
  waitsForTruth_ = start.kind == LocalizationStart::Kind::kTruth;
  if (start.kind == LocalizationStart::Kind::kGlobal) {
    mcl_->startGlobal();
    if (grid_) grid_->startGlobal();
  }
  if (start.kind != LocalizationStart::Kind::kPose) return;
  checkPlace(robot_->tables.region, start.pose, start.sigmaPosition, "start:");
  startAt(start.pose);
}

void Localization::startAt(const Pose2& pose) {
  mcl_->startAt(pose, start_.sigmaPosition, start_.sigmaHeading);
  if (grid_) grid_->startAt(pose, start_.sigmaPosition, start_.sigmaHeading);
  waitsForTruth_ = false;
}

void Localization::requireMcl(const char* what) const {
  if (!isGrid()) return;
  throw std::logic_error(std::string(what) + " is of MCL, and a grid filter is in its place");
}

void Localization::checkPose(const Pose2& pose, double sigmaPosition) const {
  checkPlace(robot_->tables.region, pose, sigmaPosition, "the pose");
}

void Localization::setPose(const Pose2& pose, const PoseCovariance& covariance) {
  requireMcl("setPose");
  const double variance = positionVariance(covariance);
  // Otherwise MCL throws and says why.
  const bool isNumber = variance >= 0.0 && std::isfinite(variance);
  checkPlace(robot_->tables.region, pose, isNumber ? std::sqrt(variance) : 0.0, "the pose set");
  mcl_->setPose(pose, covariance);
  waitsForTruth_ = false;
  if (!publishes_ || !mcl_->hasOdometry()) return;
  // No reading may come that tells it: the world may stand.
  const PoseEstimate estimate = present();
  toldAt_ = estimate.stamp;
  publish(estimate);
}

void Localization::relocalize() {
  requireMcl("relocalize");
  mcl_->relocalize();
  waitsForTruth_ = false;
  publishChange();
}

void Localization::saveBelief(const std::filesystem::path& file) const {
  requireMcl("saveBelief");
  const auto belief = waitsForTruth_ ? std::nullopt : mcl_->belief();
  if (!belief) throw std::logic_error("there is no belief yet that could be saved");
  writeBelief(file, {*belief, mcl_->mapChanges()}, robot_->tables.worldFingerprint);
}

void Localization::restoreBelief(const std::filesystem::path& file, double sigmaPosition,
                                 double sigmaHeading) {
  requireMcl("restoreBelief");
  checkSigmas("belief", sigmaPosition, sigmaHeading);
  SavedBelief saved = readBelief(file, robot_->tables);
  widen(sigmaPosition, sigmaHeading, mclConfig_.seed, saved.belief.samples);
  mcl_->restore(saved.belief);
  mcl_->restore(saved.changes);
  waitsForTruth_ = false;
}

void Localization::publish(const PoseEstimate& estimate) {
  if (!publishes_) return;
  const Timestamp stamp = estimate.stamp;
  const SampleSet& samples = mcl_->samples();
  std::vector<Message> all{
      EstimateData::message(estimate),
      smoothMessage(estimate),
      trackMessage(estimate),
      protectionMessage(estimate),
      clustersMessage(stamp, mcl_->places()),
      WorkData::message(stamp, {samples.size(), worthOf(samples), newest_ * 1e-3, estimates_})};
  if (auto changes = newChanges(stamp)) all.push_back(std::move(*changes));
  if (wantsSamples_) all.push_back(samplesMessage(stamp, samples));
  robot_->container.set(all);
  published_ = {estimate.status, estimate.reason};
}

/// Returns what is known of the map's changes if that is news, at most once a second, and every two
/// seconds if it is not: a player that jumps to a moment of a record looks back only a short way.
std::optional<Message> Localization::newChanges(Timestamp stamp) {
  if (lookedAtMap_ && stamp >= *lookedAtMap_ && stamp - *lookedAtMap_ < kTellingMap)
    return std::nullopt;
  lookedAtMap_ = stamp;
  Message message = changesMessage(stamp, mcl_->mapChanges());
  const bool isNews = message.words != toldMap_;
  const bool isEmpty = message.words.size() == 1;
  const bool isLongAgo = stamp < toldMapAt_ || stamp - toldMapAt_ >= kTellingMapAgain;
  if (!isNews && (isEmpty || !isLongAgo)) return std::nullopt;
  toldMapAt_ = stamp;
  toldMap_ = message.words;
  return message;
}

/// Returns the estimate at the time of the newest odometry; without any, of the newest weighing.
PoseEstimate Localization::present() const {
  Timestamp now = mcl_->estimate().stamp;
  if (odometry_ != nullptr) {
    const SensorContainer::ReadLock lock = robot_->container.read();
    if (odometry_->sequence() > 0) now = odometry_->stamp();
  }
  PoseEstimate estimate = mcl_->estimate(now).value_or(mcl_->estimate());  // the field is searched
  estimate.stamp = now;
  return estimate;
}

/// Publishes the status and what bounds the error if the status has changed without a new estimate.
void Localization::publishChange() {
  if (!publishes_ || odometry_ == nullptr || !(published_ || mcl_->isSearching())) return;
  const PoseEstimate estimate = present();
  const std::pair status(estimate.status, estimate.reason);
  if (status == published_) return;
  robot_->container.set(std::array{trackMessage(estimate), protectionMessage(estimate)});
  published_ = status;
}

std::optional<Pose2> Localization::truth() const {
  if (feeder_) return feeder_->truth();
  return robot_->container.get<PoseData>({.type = kGroundTruth});
}

std::optional<PoseEstimate> Localization::update() {
  if (waitsForTruth_) {
    const std::optional<Pose2> pose = truth();
    if (!pose) return std::nullopt;
    checkPlace(robot_->tables.region, *pose, start_.sigmaPosition,
               sourceName_ + (sourceName_.empty() ? "" : ": ") + "the first ground truth");
    startAt(*pose);
  }
  const double begin = millisecondsOnTheClock();
  const bool weighed =
      isGrid() ? grid_->update(robot_->container) : mcl_->update(robot_->container);
  count(millisecondsOnTheClock() - begin);
  if (grid_ && !isGrid()) grid_->update(robot_->container);
  if (!weighed) {
    publishChange();
    return std::nullopt;
  }
  longest_ = std::exchange(longestSince_, 0.0);
  spent_ = std::exchange(spentSince_, 0.0);
  if (isGrid()) return grid_->estimate();
  ++estimates_;
  // Readings of before a place was told may weigh it; what is published does not go back in time.
  const bool isOlder = toldAt_ && mcl_->estimate().stamp < *toldAt_;
  publish(isOlder ? present() : mcl_->estimate());
  return mcl_->estimate();
}

void Localization::followOdometry() {
  if (!isGrid()) mcl_->followOdometry(robot_->container);
  if (grid_) grid_->followOdometry(robot_->container);
}

std::optional<PoseEstimate> Localization::estimate(Timestamp stamp) const {
  if (waitsForTruth_ || (knownSince_ && stamp < *knownSince_)) return std::nullopt;
  return isGrid() ? grid_->estimate(stamp) : mcl_->estimate(stamp);
}

bool Localization::advance() {
  const Timestamp since = feeder().stamp();
  if (!feeder().next()) return false;
  if (knownSince_ && feeder().stamp() < *knownSince_) knownSince_.reset();  // a clock was set back
  searchMeanwhile(since, feeder().stamp());
  return true;
}

void Localization::take(std::span<const Message> moment) {
  const Timestamp stamp = moment.front().stamp;
  robot_->container.set(moment);
  if (knownSince_ && stamp < *knownSince_) knownSince_.reset();  // a clock was set back
  searchMeanwhile(taken_.value_or(0), stamp);
  taken_ = stamp;
}

/// Searches on between readings: they may be seconds apart in logs, and a robot asks for its pose
/// meanwhile. A result is known from the time of its search on, not before.
void Localization::searchMeanwhile(Timestamp since, Timestamp until) {
  for (Timestamp now = since + kAsking; now < until && mcl_->isSearching(); now += kAsking) {
    const bool waited = !mcl_->estimate(now);
    const double begin = millisecondsOnTheClock();
    mcl_->searchOn();
    count(millisecondsOnTheClock() - begin);
    if (waited && mcl_->estimate(now)) knownSince_ = now;
  }
}

/// Notes the duration of an update.
void Localization::count(double milliseconds) {
  newest_ = milliseconds;
  longestSince_ = std::max(longestSince_, milliseconds);
  spentSince_ += milliseconds;
}

std::optional<PoseEstimate> Localization::next(const std::function<bool()>& goOn) {
  while (!goOn || goOn()) {
    if (!advance()) {
      if (isStarted()) return std::nullopt;
      throw std::runtime_error(sourceName_ +
                               ": has no ground truth to start from, expected a feature of type " +
                               kGroundTruth);
    }
    if (const std::optional<PoseEstimate> estimate = update()) return estimate;
  }
  return std::nullopt;
}

Source& Localization::source() {
  if (!source_) throw std::logic_error("this localization has no source");
  return *source_;
}

Feeder& Localization::feeder() {
  if (!feeder_) throw std::logic_error("this localization has no source");
  return *feeder_;
}

}  // namespace ortung
