#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung {

/// Type of the feature that holds ground truth.
inline constexpr const char* kGroundTruth = "groundTruth";

/// Fills a container from a source, moment by moment in the order of time, and watches what passes.
/// Not thread-safe; the container may be read by others meanwhile.
class ORTUNG_API Feeder {
 public:
  /// @param name what errors call the source
  /// @param source borrowed, like @p container
  Feeder(std::string name, Source& source, SensorContainer& container);

  /// Also writes everything that passes into @p record, which is borrowed.
  void recordInto(RecordWriter& record) { record_ = &record; }
  /// Also passes each moment to @p listener, before it is in the container; on the thread of
  /// next().
  void showTo(std::function<void(std::span<const Message>)> listener) {
    listener_ = std::move(listener);
  }

  /// Fills in the next moment; returns false at the end.
  /// @throws std::runtime_error naming the source, the time and what is wrong with a reading
  bool next();

  Timestamp stamp() const { return stamp_; }  ///< time of the present moment [us]
  /// Time since the first moment [s].
  double seconds() const { return toSeconds(stamp_) - toSeconds(first_); }
  std::size_t moments() const { return moments_; }
  /// Returns the share of the source that was read, in [0, 1], or -1 if it has no end.
  double progress() const { return source_.progress(); }

  /// Returns the ground truth of the present moment, if the source gave it then. It does not come
  /// from the container, so it is there for every robot file; the first feature that gives it is
  /// taken.
  const std::optional<Pose2>& truth() const { return truth_; }

  /// Returns how many readings came of features that the container lacks, by "model/type/feature";
  /// at most 1000 names. These readings are ignored, which programs may want to report.
  const std::map<std::string, std::size_t>& unknown() const { return unknown_; }

 private:
  void look(const Message& message);

  std::string name_;
  Source& source_;
  SensorContainer& container_;
  RecordWriter* record_ = nullptr;
  std::function<void(std::span<const Message>)> listener_;
  FrameReader reader_;
  std::vector<Message> frame_;
  Timestamp first_ = 0;
  Timestamp stamp_ = 0;
  std::size_t moments_ = 0;
  std::optional<SensorId> truthId_;
  std::optional<Pose2> truth_;
  std::map<std::string, std::size_t> unknown_;
};

}  // namespace ortung
