#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Record.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/core/Source.hpp"

namespace ortung::app {

/// Type of the feature that holds ground truth.
inline constexpr const char* kGroundTruth = "groundTruth";

/// Opens "KIND:PATH?key=value". "record" is built in, every other kind is a plugin.
/// @param robotFile the source's "robot_file"; may be empty
/// @throws UsageError, PluginError, ConfigError, std::runtime_error
std::unique_ptr<Source> openSource(const std::string& text, const std::filesystem::path& robotFile,
                                   PluginFactory& factory);
std::unique_ptr<Source> openSource(const SourceText& text, const std::filesystem::path& robotFile,
                                   PluginFactory& factory);

/// Fills a container from a source, moment by moment, and keeps an eye on what passes.
class Feeder {
 public:
  /// @param name what errors call the source
  Feeder(std::string name, Source& source, SensorContainer& container);

  /// Also writes everything that passes into @p record, which must outlive this.
  void recordInto(RecordWriter& record) { record_ = &record; }

  /// Fills in the next moment; false at the end.
  /// @throws std::runtime_error naming the source, the time and what is wrong with a reading
  bool next();

  Timestamp stamp() const { return stamp_; }  ///< of the present moment
  double seconds() const { return toSeconds(stamp_) - toSeconds(first_); }  ///< since the first one
  std::size_t moments() const { return moments_; }
  double progress() const { return source_.progress(); }

  /// Ground truth of the present moment, if the source gave it then. Never comes from the
  /// container, so it is there for every robot file; the first feature that gives it wins.
  const std::optional<Pose2>& truth() const { return truth_; }

  /// Readings of features that the container lacks, by name.
  const std::map<std::string, std::size_t>& unknown() const { return unknown_; }
  /// Says once, on stderr, which features the robot file lacks.
  void warnOfUnknown() const;

 private:
  void look(const Message& message);

  std::string name_;
  Source& source_;
  SensorContainer& container_;
  RecordWriter* record_ = nullptr;
  FrameReader reader_;
  std::vector<Message> frame_;
  Timestamp first_ = 0;
  Timestamp stamp_ = 0;
  std::size_t moments_ = 0;
  std::optional<SensorId> truthId_;
  std::optional<Pose2> truth_;
  std::map<std::string, std::size_t> unknown_;
};

}  // namespace ortung::app
