#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::server {

/// One record of a playback. Its time is counted from its first reading.
class PlaybackRun {
 public:
  /// @param progress as of ServedPlayback, of this record
  PlaybackRun(const ServedPlayback::Run& run, const std::function<bool(double)>& progress);
  ~PlaybackRun();

  const std::vector<ServedFeature>& features() const { return features_; }
  const std::vector<ServedPlayback::Mark>& marks() const { return marks_; }
  const std::vector<ServedPlayback::Content>& contents() const { return contents_; }
  /// Where the robot was, and what it may have seen: by the truth, or else by its localization, or
  /// else by odometry.
  std::optional<FieldBounds> bounds() const;
  const std::string& fingerprint() const { return fingerprint_; }
  Timestamp length() const { return length_; }
  const ServedPlayback::Run& run() const { return run_; }

  /// As ServedPlayback::history().
  std::vector<Message> history(std::span<const SensorQuery> queries, std::size_t most,
                               const std::function<bool()>& goOn) const;

  /// Goes on to @p stamp, not included: newest() has what was new, the last one of each feature.
  void play(Timestamp stamp);
  /// Goes to @p stamp: newest() has the last one of each feature of the seconds before it.
  void seek(Timestamp stamp);
  std::span<Message> newest() { return newest_; }
  /// Where the robot truly is; nothing if the record does not say so.
  const std::optional<Pose2>& truth() const { return truth_; }
  Timestamp truthStamp() const { return truthStamp_; }

 private:
  void scan(const std::function<bool(double)>& progress);
  void note(const Message& message);
  void notePose(const Message& message);
  void noteTrack(const Message& message);
  void noteStatus(Timestamp stamp, const TrackData::Reading& told);
  void noteTruth(const Message& message);
  void noteTalk(const Message& message);
  void mark(Timestamp stamp, const std::string& text);
  void open(Timestamp from);
  void take(Message&& message);
  std::size_t placeOf(const SensorId& id);

  ServedPlayback::Run run_;
  std::vector<ServedFeature> features_;
  std::vector<ServedPlayback::Mark> marks_;
  std::vector<ServedPlayback::Content> contents_;  ///< of features_, in their order
  std::optional<FieldBounds> truths_;              ///< boxes around all poses of a kind
  std::optional<FieldBounds> estimates_;
  std::optional<FieldBounds> odometries_;
  std::string fingerprint_;
  Timestamp first_ = 0;  ///< stamp of the first reading in the record
  Timestamp length_ = 0;

  std::unique_ptr<RecordSource> source_;
  std::optional<Message> ahead_;
  std::vector<Message> newest_;
  std::vector<std::size_t> taken_;  ///< place in newest_, plus 1, by feature; 0: none
  std::optional<Pose2> truth_;
  Timestamp truthStamp_ = 0;

  // while it is scanned
  std::map<std::string, std::string> formats_;  ///< that the record's notes tell, by feature
  std::optional<TrackStatus> status_;           ///< the last one that was not uncertain
  std::optional<Timestamp> uncertainSince_;
  bool isMarkedUncertain_ = false;
  std::optional<std::uint32_t> relocalizations_;
  std::optional<std::pair<Timestamp, Pose2>> lastTruth_;
};

}  // namespace ortung::server
