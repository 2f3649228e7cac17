#include "LiveSetup.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "CloudLayout.hpp"
#include "CloudShape.hpp"
#include "MapWorld.hpp"
#include "ScanShape.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"
#include "ortung/realsensors/Scanner.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::size_t kMostComplaints = 32;
constexpr std::chrono::milliseconds kLook{100};  ///< between questions whether to go on
constexpr std::size_t kMostFrames = 4096;

/// A topic as part of a feature's name.
std::string cleaned(const std::string& topic) {
  std::string name;
  for (const char c : topic) {
    const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (isPlain || !name.empty()) name += isPlain ? c : '_';
  }
  return name.empty() ? "scan" : name;
}

}  // namespace

LiveSetup::LiveSetup(Options options, Participant& node)
    : options_(std::move(options)),
      node_(node),
      scans_(options_.scans.size()),
      cloudFrames_(options_.clouds.size()) {
  if (!options_.map.empty())
    node.subscribe(options_.map, OccupancyGrid::kType, Qos::kLatched,
                   [this](std::string_view cdr) { takeMap(cdr); });
  node.subscribe("/tf_static", TfMessage::kType, Qos::kLatched,
                 [this](std::string_view cdr) { takeFrames(cdr); });
  // Some robots tell mounts again and again, with all that moves.
  node.subscribe("/tf", TfMessage::kType, Qos::kDefault,
                 [this](std::string_view cdr) { takeFrames(cdr); });
  for (std::size_t i = 0; i < options_.scans.size(); ++i)
    node.subscribe(options_.scans[i], LaserScan::kType, Qos::kSensor,
                   [this, i](std::string_view cdr) { takeScan(i, cdr); });
  for (std::size_t i = 0; i < options_.clouds.size(); ++i)
    node.subscribe(options_.clouds[i], PointCloud::kType, Qos::kSensor,
                   [this, i](std::string_view cdr) { takeCloud(i, cdr); });
}

std::string LiveSetup::featureOf(const std::string& topic) { return cleaned(topic) + "/LRF/scan"; }

void LiveSetup::complain(const std::string& what) {
  if (complaints_.size() < kMostComplaints) complaints_.push_back(what);
}

void LiveSetup::takeMap(std::string_view cdr) {
  std::string why;
  auto map = fromCdr<OccupancyGrid>(cdr, why);
  if (map) why = whyNoWorld(*map);
  // Only what the map shows counts: map_server says the time anew.
  std::size_t digest = 0;
  if (why.empty()) {
    map->header = {};
    map->mapLoadTime = 0;
    digest = std::hash<std::string>()(toCdr(*map));
  }
  const std::lock_guard lock(mutex_);
  if (!why.empty()) return complain(options_.map + ": " + why);
  if (digest == mapDigest_) return;
  mapDigest_ = digest;
  newMap_ = std::move(map);
  arrived_.notify_all();
}

void LiveSetup::takeScan(std::size_t scanner, std::string_view cdr) {
  const std::lock_guard lock(mutex_);
  if (scans_[scanner]) return;
  std::string why;
  auto scan = fromCdr<LaserScan>(cdr, why);
  try {
    if (scan) ScanShape shape(*scan);
  } catch (const std::invalid_argument& error) {
    why = error.what();
  }
  if (!why.empty()) return complain(options_.scans[scanner] + ": " + why);
  scans_[scanner] = std::move(scan);
  arrived_.notify_all();
}

/// Takes the frame of a lidar, from the first cloud that is sound.
void LiveSetup::takeCloud(std::size_t lidar, std::string_view cdr) {
  {
    const std::lock_guard lock(mutex_);
    if (cloudFrames_[lidar]) return;
  }
  std::string why;
  const auto cloud = fromCdr<PointCloud>(cdr, why);
  const bool isSound = cloud && CloudLayout::of(*cloud, why);
  const std::lock_guard lock(mutex_);
  if (!isSound) return complain(options_.clouds[lidar] + ": " + why);
  cloudFrames_[lidar] = cloud->header.frame;
  arrived_.notify_all();
}

void LiveSetup::takeFrames(std::string_view cdr) {
  std::string why;
  const auto all = fromCdr<TfMessage>(cdr, why);
  const std::lock_guard lock(mutex_);
  if (!all) return complain("/tf_static: " + why);
  for (const TransformStamped& one : all->transforms)
    if (frames_.size() < kMostFrames || frames_.hasFrame(one.childFrame)) frames_.add(one, true);
  arrived_.notify_all();
}

bool LiveSetup::knowsScanners() const {
  const auto isThere = [](const auto& one) { return one.has_value(); };
  return std::all_of(scans_.begin(), scans_.end(), isThere) &&
         std::all_of(cloudFrames_.begin(), cloudFrames_.end(), isThere);
}

std::vector<std::string> LiveSetup::framesWithoutMount() const {
  std::vector<std::string> frames;
  const auto look = [&](const std::string& frame) {
    if (!frames_.find(frame, options_.base)) frames.push_back(frame);
  };
  for (const auto& scan : scans_)
    if (scan) look(scan->header.frame);
  for (const auto& frame : cloudFrames_)
    if (frame) look(*frame);
  return frames;
}

std::string LiveSetup::missing() const {
  const std::lock_guard lock(mutex_);
  if (mapDigest_ == 0 && !options_.map.empty())
    return "the map at " + node_.wholeName(options_.map);
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (!scans_[i]) return "scans at " + node_.wholeName(options_.scans[i]);
  for (std::size_t i = 0; i < cloudFrames_.size(); ++i)
    if (!cloudFrames_[i]) return "clouds at " + node_.wholeName(options_.clouds[i]);
  const auto frames = framesWithoutMount();
  if (frames.empty()) return "";
  std::string known;
  for (const std::string& name : frames_.names()) known += (known.empty() ? "" : ", ") + name;
  return "a transform from " + options_.base + " to " + frames.front() + "; frames at " +
         node_.wholeName("/tf_static") + " and " + node_.wholeName("/tf") + " are " +
         (known.empty() ? "none" : known) + " (--base-frame?)";
}

bool LiveSetup::wait(const std::function<bool()>& goOn, const std::function<bool()>& isThere) {
  std::unique_lock lock(mutex_);
  while (!isThere()) {
    lock.unlock();
    if (!goOn()) return false;
    lock.lock();
    if (!isThere()) arrived_.wait_for(lock, kLook);
  }
  return true;
}

bool LiveSetup::waitForMap(const std::function<bool()>& goOn) {
  return wait(goOn, [this] { return newMap_.has_value(); });
}

bool LiveSetup::waitForScanners(const std::function<bool()>& goOn) {
  if (!wait(goOn, [this] { return knowsScanners(); })) return false;
  return wait(goOn, [this] { return knowsMounts(); });
}

bool LiveSetup::hasNewMap() const {
  const std::lock_guard lock(mutex_);
  return newMap_.has_value();
}

void LiveSetup::writeWorld(const std::filesystem::path& file) {
  std::optional<OccupancyGrid> map;
  {
    const std::lock_guard lock(mutex_);
    std::swap(map, newMap_);
  }
  if (!map) throw std::runtime_error(options_.map + ": there is no new map");
  writeWorldOf(*map, file);
}

/// Returns the tables of the lidars, whose heights above the floor have to be known.
std::string LiveSetup::cloudsToml() const {
  std::string text;
  for (std::size_t i = 0; i < cloudFrames_.size(); ++i) {
    const std::string& topic = options_.clouds[i];
    const auto mount = frames_.find(*cloudFrames_[i], options_.base);
    if (!mount)
      throw std::runtime_error(topic + ": found no transform from " + options_.base + " to " +
                               inQuotes(*cloudFrames_[i]) +
                               ", expected it at /tf_static: it tells how high the lidar sits");
    constexpr double kPeriod = 0.1;  // of most lidars [s]
    text += scannerToml(CloudShape(options_.bands.of(topic), *mount).scanner(), kPeriod,
                        parseSensorId(featureOf(topic)));
  }
  return text;
}

void LiveSetup::writeRobot(const std::filesystem::path& file, const std::string& more) const {
  const std::lock_guard lock(mutex_);
  std::string text = robotHead(file.stem().string());
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const ScanShape shape(*scans_[i]);
    const auto found = frames_.find(shape.frame(), options_.base);
    const PlanarMount mount = found ? onPlane(*found) : PlanarMount();
    if (!mount.isLevel())
      throw std::runtime_error(options_.scans[i] + ": the scanner is tilted, expected a level one");
    Scanner scanner = shape.scanner(mount.isUpsideDown());
    scanner.mount = mount.pose;
    scanner.maxRange = shape.usefulRange();
    if (options_.maxRange > 0.0) scanner.maxRange = std::min(*scanner.maxRange, options_.maxRange);
    const double period = static_cast<double>(scans_[i]->scanTime);
    text += scannerToml(scanner, period >= 0.001 && period <= 10.0 ? period : 0.1,
                        parseSensorId(featureOf(options_.scans[i])));
  }
  writeFile(file, text + cloudsToml() + more);
}

std::vector<std::string> LiveSetup::complaints() {
  const std::lock_guard lock(mutex_);
  return std::exchange(complaints_, {});
}

}  // namespace ortung::ros2
