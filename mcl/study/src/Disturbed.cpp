#include "ortung/study/Disturbed.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "Disturbance.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/run/Feeder.hpp"

namespace ortung {
namespace {

constexpr std::uint64_t kStream = 0xFA17ULL << 32;  ///< separate from MCL's streams
/// Most features that get disturbances of their own; a hostile log may have more.
constexpr std::size_t kMostFeatures = 10000;
/// Farthest stamp from 0 that FrameReader takes [us].
constexpr Timestamp kFarthest = Timestamp{1} << 60;

/// The facts about a feature that faults need.
struct Known {
  const SensorData* data;
  std::string format;  ///< its name
};
using Formats = std::map<std::string, Known>;  ///< formats of all features but ground truth

Formats knownOf(const SensorContainer& robot) {
  Formats formats;
  for (const auto& data : robot.all())
    if (data->id().type != kGroundTruth)
      formats.emplace(toText(data->id()), Known{data.get(), data->format().name()});
  return formats;
}

bool isOdometry(const Formats& formats, const std::string& feature) {
  const auto found = formats.find(feature);
  return found != formats.end() && found->second.format == formats::kOdometry;
}

/// Returns whether a fault of values (beams, landmarks, rows) applies to a feature. If readings
/// have a single value, or say nothing about the pose, the fault must name the feature.
bool canHave(const Fault& fault, const Formats& formats, const std::string& feature) {
  const auto found = formats.find(feature);
  if (found == formats.end()) return false;
  const std::string& format = found->second.format;
  if (fault.kind == Fault::Kind::kCrowd) return format == formats::kScan;
  if (format == formats::kScan || !rowOf(found->second.data->format()).empty()) return true;
  if (format == formats::kLandmarks) return fault.kind == Fault::Kind::kRandom;
  return fault.what == feature && (format == formats::kRange || format == formats::kCone ||
                                   format == formats::kBearing || format == formats::kPoints);
}

/// Returns whether a fault alters a feature of the log that is not ground truth.
bool concerns(const Fault& fault, const Formats& formats, const std::string& feature) {
  const FaultOf of = groupOf(fault.kind);
  if (of == FaultOf::kScan && !canHave(fault, formats, feature)) return false;
  if (fault.what == "odometry") return isOdometry(formats, feature);
  if (fault.what == "readings") return !isOdometry(formats, feature);
  return fault.what == feature;
}

void check(const Fault& fault, const Formats& formats) {
  std::string names;
  bool concernsAny = false;
  for (const auto& [feature, known] : formats) {
    names += (names.empty() ? "" : ", ") + feature;
    if (groupOf(fault.kind) == FaultOf::kOdometry && !isOdometry(formats, feature)) continue;
    concernsAny = concernsAny || concerns(fault, formats, feature);
  }
  if (concernsAny) return;
  const char* wanted = "feature";
  if (groupOf(fault.kind) == FaultOf::kScan) wanted = "scan";
  if (groupOf(fault.kind) == FaultOf::kOdometry || fault.what == "odometry") wanted = "odometry";
  throw FaultError("fault '" + fault.text + "': the robot has no " + wanted + " '" + fault.what +
                   "', its features are " + (names.empty() ? "none" : names));
}

class Disturbed : public Source {
 public:
  Disturbed(std::unique_ptr<Source> source, const std::vector<Fault>& faults,
            const SensorContainer& robot, std::uint64_t seed)
      : source_(std::move(source)), formats_(knownOf(robot)), seed_(seed) {
    for (const Fault& fault : faults) {
      check(fault, formats_);
      faults_.push_back({fault, false});
    }
  }

  bool next(Message& message) override {
    while (!isReady()) read();
    if (waiting_.empty()) return false;
    message = std::move(waiting_.begin()->second.message);
    waiting_.erase(waiting_.begin());
    return true;
  }

  double progress() const override { return source_->progress(); }
  bool isLive() const override { return source_->isLive(); }
  std::string worldFingerprint() const override { return source_->worldFingerprint(); }
  FeatureFormats formats() const override { return source_->formats(); }
  std::string robotToml() const override { return source_->robotToml(); }
  void writeWorld(const std::filesystem::path& file) const override { source_->writeWorld(file); }
  std::string remark() const override {
    std::string text = source_->remark();
    for (const Active& fault : faults_) {
      if (fault.metReading) continue;
      text += (text.empty() ? "" : "; ") + ("the fault '" + fault.fault.text + "' met no reading");
    }
    return text;
  }

 private:
  struct Active {
    Fault fault;
    bool metReading;
  };
  struct Feature {
    std::vector<std::pair<std::size_t, std::unique_ptr<Disturbance>>> faults;
    Timestamp newest = 0;  ///< newest stamp of readings that came in time, before the fault
  };
  struct Waiting {
    Message message;
    Feature* feature;
    Timestamp original;
  };

  /// Stamps only become later, so a reading whose stamp is not behind the newest one can't be
  /// overtaken. A reading that would come after a newer one of its feature, since the clock is
  /// right again, is dropped.
  bool isReady() {
    while (!waiting_.empty() && (atEnd_ || waiting_.begin()->first.first <= now_)) {
      const Waiting& next = waiting_.begin()->second;
      if (next.feature == nullptr || next.original >= next.feature->newest) {
        if (next.feature != nullptr) next.feature->newest = next.original;
        return true;
      }
      waiting_.erase(waiting_.begin());
    }
    return atEnd_;
  }

  void read() {
    Message message;
    if (!source_->next(message)) {
      atEnd_ = true;
      return;
    }
    if (!first_) first_ = message.stamp;
    now_ = message.stamp;
    const Timestamp original = message.stamp;
    const bool isPassed =
        message.id.type == kGroundTruth || original < -kFarthest || original > kFarthest;
    Feature* feature = isPassed ? nullptr : featureOf(message.id);
    if (feature != nullptr && !alter(message, *feature)) return;
    const std::pair<Timestamp, std::uint64_t> place(message.stamp, count_++);
    waiting_.emplace(place, Waiting{std::move(message), feature, original});
  }

  bool alter(Message& message, Feature& feature) {
    const double seconds = toSeconds(message.stamp) - toSeconds(*first_);
    for (const auto& [index, disturbance] : feature.faults) {
      Active& active = faults_[index];
      const bool isNow = seconds >= active.fault.from && seconds < active.fault.to;
      active.metReading = active.metReading || isNow;
      if (!disturbance->alter(message, seconds, isNow)) return false;
    }
    return true;
  }

  Feature* featureOf(const SensorId& id) {
    const std::string name = toText(id);
    const auto found = features_.find(name);
    if (found != features_.end()) return &found->second;
    if (features_.size() == kMostFeatures) return nullptr;
    Feature& feature = features_[name];
    const std::uint64_t number = features_.size();
    for (std::size_t i = 0; i < faults_.size(); ++i) {
      const Fault& fault = faults_[i].fault;
      if (concerns(fault, formats_, name))
        feature.faults.emplace_back(i,
                                    make(fault, name, Random(seed_, kStream + (i << 16) + number)));
    }
    return &feature;
  }

  std::unique_ptr<Disturbance> make(const Fault& fault, const std::string& feature,
                                    const Random& random) const {
    switch (groupOf(fault.kind)) {
      case FaultOf::kOdometry:
        return makeOdometryFault(fault);
      case FaultOf::kScan:
        if (fault.kind == Fault::Kind::kCrowd)
          return makeCrowd(ScanData::configOf(formats_.at(feature).data->format()), random);
        return makeEntriesFault(fault, *formats_.at(feature).data, random);
      default:
        return makeReadingFault(fault, random);
    }
  }

  std::unique_ptr<Source> source_;
  Formats formats_;
  std::uint64_t seed_;
  std::vector<Active> faults_;
  std::map<std::string, Feature> features_;
  /// By stamp, then in the order of the source.
  std::map<std::pair<Timestamp, std::uint64_t>, Waiting> waiting_;
  std::uint64_t count_ = 0;
  std::optional<Timestamp> first_;
  Timestamp now_ = 0;  ///< newest stamp of the source
  bool atEnd_ = false;
};

}  // namespace

std::unique_ptr<Source> disturbed(std::unique_ptr<Source> source, const std::vector<Fault>& faults,
                                  const SensorContainer& robot, std::uint64_t seed) {
  return std::make_unique<Disturbed>(std::move(source), faults, robot, seed);
}

}  // namespace ortung
