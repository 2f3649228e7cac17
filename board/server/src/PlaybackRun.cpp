#include "PlaybackRun.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "Request.hpp"
#include "ortung/formats/ChangesData.hpp"
#include "ortung/formats/ClustersData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/SamplesData.hpp"
#include "ortung/formats/TalkData.hpp"
#include "ortung/formats/WorkData.hpp"

namespace ortung::server {
namespace {

constexpr std::size_t kMostMarks = 10'000;
constexpr std::size_t kMostFeatures = 1024;
constexpr std::size_t kMostWordsOfALine = 8192;  // as in all lines, see docs/protocol.md
constexpr std::size_t kMostWordsOfHistory = 4u << 20;
constexpr std::uint64_t kBetweenProgress = 4096;  // readings
// How far a seek reads back for what is in sight: scans come ten times a second, camera pictures at
// least once.
constexpr Timestamp kBefore = 3'000'000;  // [us]
// Robots do not drive faster than that: a faster one was carried.
constexpr Timestamp kWavers = 1'000'000;  ///< shorter than this, being uncertain is no event [us]
constexpr double kFastest = 10.0;         // [m/s]
constexpr double kNoJump = 0.3;           // [m]
constexpr double kMargin = 1.0;           // around true poses and estimates [m]
constexpr double kInSight = 5.0;  // around poses of odometry, which no field is known for [m]
const SensorId kEstimate{"mcl", "LOCALIZATION", "pose"};
const SensorId kOdometry{"odometry", "odometry", "pose"};

ServedFeature served(const SensorData& data) {
  return {data.id(), data.wordsHelp(), {}, data.format().toText()};
}

/// Returns what is known of a feature from its name alone.
ServedFeature featureOf(const SensorId& id) {
  if (id.type == "groundTruth") return served(PoseData(id));
  if (id == kOdometry) return served(OdometryData(id));
  if (id == kEstimate) return served(PoseFixData(id, {}));
  if (id == SensorId{"mcl", "LOCALIZATION", "smooth"}) return served(PoseData(id));
  if (const TrackData track; track.id() == id) return served(track);
  if (const ProtectionData bound; bound.id() == id) return served(bound);
  if (const ChangesData changes; changes.id() == id) return served(changes);
  if (const ClustersData clusters; clusters.id() == id) return served(clusters);
  if (const WorkData work; work.id() == id) return served(work);
  if (const SamplesData samples; samples.id() == id) return served(samples);
  return {id, ""};
}

std::optional<Pose2> poseOf(const Message& message) {
  PoseData data(message.id);
  try {
    data.setData(message.stamp, message.words);
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // another format of the same type
  }
  return data.reading();
}

/// The pose that a reading of odometry or of a localization says.
template <class Data>
std::optional<Pose2> poseIn(Data data, const Message& message) {
  try {
    data.setData(message.stamp, message.words);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  if constexpr (std::is_same_v<Data, PoseFixData>) {
    if (data.reading().empty()) return std::nullopt;
    return data.reading().front().pose;
  } else {
    return data.reading().pose;
  }
}

void include(const Pose2& pose, std::optional<FieldBounds>& box) {
  if (!box) box = {pose.x, pose.y, pose.x, pose.y};
  *box = {std::min(box->xMin, pose.x), std::min(box->yMin, pose.y), std::max(box->xMax, pose.x),
          std::max(box->yMax, pose.y)};
}

/// Whether reading @p i of @p count is one of at most @p most, evenly chosen, the last one among
/// them.
bool isChosen(std::uint64_t i, std::uint64_t count, std::size_t most) {
  return count <= most || (i + 1) * most / count > i * most / count;
}

}  // namespace

PlaybackRun::PlaybackRun(const ServedPlayback::Run& run,
                         const std::function<bool(double)>& progress)
    : run_(run) {
  scan(progress);
  open(0);
}

PlaybackRun::~PlaybackRun() = default;

std::size_t PlaybackRun::placeOf(const SensorId& id) {
  const auto found = std::find_if(features_.begin(), features_.end(),
                                  [&](const ServedFeature& one) { return one.id == id; });
  if (found != features_.end()) return static_cast<std::size_t>(found - features_.begin());
  if (features_.size() == kMostFeatures)
    throw std::runtime_error(run_.record.string() + ": has more than " +
                             std::to_string(kMostFeatures) + " features");
  const auto known = std::find_if(run_.features.begin(), run_.features.end(),
                                  [&](const ServedFeature& one) { return one.id == id; });
  features_.push_back(known == run_.features.end() ? featureOf(id) : *known);
  // What was recorded counts, whatever a robot file says today.
  if (const auto noted = formats_.find(toText(id)); noted != formats_.end())
    features_.back().format = noted->second;
  return features_.size() - 1;
}

void PlaybackRun::scan(const std::function<bool(double)>& progress) {
  RecordSource source(run_.record);
  fingerprint_ = source.worldFingerprint();
  for (const auto& [id, format] : source.formats())
    formats_.try_emplace(toText(id), format.toText());
  Message message;
  for (std::uint64_t count = 0; source.next(message); ++count) {
    if (count == 0) first_ = message.stamp;
    if (count % kBetweenProgress == 0 && progress && !progress(std::max(0.0, source.progress())))
      throw std::runtime_error(run_.record.string() + ": reading was given up");
    const std::size_t place = placeOf(message.id);
    message.stamp -= first_;
    length_ = std::max(length_, message.stamp);
    if (place == contents_.size()) contents_.push_back({message.id, 0, message.stamp, 0});
    ++contents_[place].readings;
    contents_[place].last = message.stamp;
    note(message);
  }
  if (features_.empty()) throw std::runtime_error(run_.record.string() + ": has no readings");
}

void PlaybackRun::note(const Message& message) {
  const std::string& format = features_[placeOf(message.id)].format;
  if (format.substr(0, format.find(' ')) == formats::kTrack) noteTrack(message);
  if (message.id.type == "groundTruth") noteTruth(message);
  notePose(message);
  if (message.id.type == "referee") noteTalk(message);
}

void PlaybackRun::noteTrack(const Message& message) {
  TrackData track;
  try {
    track.setData(message.stamp, message.words);
  } catch (const std::invalid_argument&) {
    return;
  }
  const TrackData::Reading& told = track.reading();
  // An hour has hundreds of corrections by readings, most of them of centimetres.
  if (relocalizations_ && told.relocalizations != *relocalizations_ &&
      told.relocalization != Relocalization::kReadings)
    mark(message.stamp, std::string("relocalized: ") + nameOf(told.relocalization));
  relocalizations_ = told.relocalizations;
  noteStatus(message.stamp, told);
}

void PlaybackRun::noteStatus(Timestamp stamp, const TrackData::Reading& told) {
  const std::string why = std::string(nameOf(told.status)) + ": " + nameOf(told.reason);
  if (told.status == TrackStatus::kUncertain) {
    if (!uncertainSince_) uncertainSince_ = stamp;
    if (!status_ || isMarkedUncertain_ || stamp - *uncertainSince_ < kWavers) return;
    mark(stamp, why);
    isMarkedUncertain_ = true;
    return;
  }
  uncertainSince_.reset();
  const bool wasUncertain = std::exchange(isMarkedUncertain_, false);
  if (told.status == status_ && !wasUncertain) return;
  // A run that has just begun is not lost.
  if (told.status == TrackStatus::kTracking)
    mark(stamp, nameOf(told.status));
  else if (status_)
    mark(stamp, why);
  status_ = told.status;
}

void PlaybackRun::noteTruth(const Message& message) {
  const auto pose = poseOf(message);
  if (!pose) return;
  include(*pose, truths_);
  if (lastTruth_) {
    const auto& [stamp, last] = *lastTruth_;
    const double way = std::hypot(pose->x - last.x, pose->y - last.y);
    if (way > kNoJump + kFastest * toSeconds(message.stamp - stamp))
      mark(message.stamp, "carried away");
  }
  lastTruth_ = {message.stamp, *pose};
}

void PlaybackRun::notePose(const Message& message) {
  if (message.id == kEstimate) {
    if (const auto pose = poseIn(PoseFixData(message.id, {}), message)) include(*pose, estimates_);
  } else if (message.id == kOdometry) {
    if (const auto pose = poseIn(OdometryData(message.id), message)) include(*pose, odometries_);
  }
}

std::optional<FieldBounds> PlaybackRun::bounds() const {
  const auto& box = truths_ ? truths_ : estimates_ ? estimates_ : odometries_;
  if (!box) return std::nullopt;
  const double margin = truths_ || estimates_ ? kMargin : kInSight;
  return FieldBounds{box->xMin - margin, box->yMin - margin, box->xMax + margin,
                     box->yMax + margin};
}

std::vector<Message> PlaybackRun::history(std::span<const SensorQuery> queries, std::size_t most,
                                          const std::function<bool()>& goOn) const {
  RecordSource source(run_.record);
  std::vector<std::uint64_t> passed(features_.size(), 0);
  std::vector<bool> isWanted;
  for (const ServedFeature& feature : features_)
    isWanted.push_back(std::any_of(queries.begin(), queries.end(), [&](const SensorQuery& query) {
      return matches(query, feature.id);
    }));
  std::vector<Message> found;
  std::size_t words = 0;
  Message message;
  for (std::uint64_t count = 0; source.next(message); ++count) {
    if (count % kBetweenProgress == 0 && !goOn()) return {};
    const auto place = std::find_if(features_.begin(), features_.end(),
                                    [&](const auto& one) { return one.id == message.id; });
    if (place == features_.end()) continue;  // the file has become longer since
    const auto i = static_cast<std::size_t>(place - features_.begin());
    if (!isWanted[i] || !isChosen(passed[i]++, contents_[i].readings, most)) continue;
    if (message.words.size() > kMostWordsOfALine) continue;
    words += message.words.size() + 1;
    if (words > kMostWordsOfHistory)
      throw ServeError("limit",
                       "these readings are too many for one answer; ask for fewer features "
                       "or fewer readings, most=N");
    message.stamp -= first_;
    found.push_back(std::move(message));
  }
  return found;
}

void PlaybackRun::noteTalk(const Message& message) {
  TalkData talk(message.id);
  try {
    talk.setData(message.stamp, message.words);
  } catch (const std::invalid_argument&) {
    return;
  }
  for (const TalkData::Message& one : talk.reading().messages)
    mark(message.stamp - fromSeconds(one.age), one.text);
}

void PlaybackRun::mark(Timestamp stamp, const std::string& text) {
  if (marks_.size() < kMostMarks) marks_.push_back({stamp, run_.name + ": " + printable(text)});
}

void PlaybackRun::open(Timestamp from) {
  source_ = std::make_unique<RecordSource>(run_.record, RecordPart{toSeconds(from)});
  ahead_.emplace();
  if (!source_->next(*ahead_)) ahead_.reset();
  newest_.clear();
  taken_.assign(features_.size(), 0);
}

/// Takes a reading; of each feature only the newest one is kept.
void PlaybackRun::take(Message&& message) {
  const std::size_t place = placeOf(message.id);
  if (taken_[place] == 0) {
    newest_.push_back(std::move(message));
    taken_[place] = newest_.size();
  } else {
    newest_[taken_[place] - 1] = std::move(message);
  }
}

void PlaybackRun::play(Timestamp stamp) {
  newest_.clear();
  std::fill(taken_.begin(), taken_.end(), 0);
  while (ahead_ && ahead_->stamp - first_ < stamp) {
    ahead_->stamp -= first_;
    if (ahead_->id.type == "groundTruth")
      if (const auto pose = poseOf(*ahead_)) {
        truth_ = pose;
        truthStamp_ = ahead_->stamp;
      }
    take(std::move(*ahead_));
    if (!source_->next(*ahead_)) ahead_.reset();
  }
}

void PlaybackRun::seek(Timestamp stamp) {
  truth_.reset();
  open(std::max<Timestamp>(0, stamp - kBefore));
  play(stamp);
}

}  // namespace ortung::server
