#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Commands.hpp"
#include "Sources.hpp"
#include "ortung/mcl/Evaluation.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung::app {

/// A robot as its file describes it: a container with its features, and their tables if it was
/// opened with some.
struct Robot {
  PluginFactory factory{PluginFactory::standardFolders()};
  RobotConfig config;
  SensorContainer container;
  std::vector<Device> devices;  ///< point into config and container
  TableInfo tables;
};

/// @throws ConfigError, PluginError
std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile);
/// @throws as above, and TableError
std::unique_ptr<Robot> openRobot(const std::filesystem::path& robotFile,
                                 const std::filesystem::path& tablesFile);

/// The motion model that [motion] of a robot file asks for. @throws ConfigError, PluginError
std::unique_ptr<MotionModel> makeMotion(const Parameters& motion, PluginFactory& factory);

/// [motion] of a robot file or of a file of its own, such as `ortung learn-motion` writes.
/// @throws ConfigError
Parameters readMotionFile(const std::filesystem::path& file);

/// @throws std::runtime_error if both fingerprints are known and differ, unless @p anyWorld
void checkWorld(const std::string& sourceName, const Source& source,
                const std::filesystem::path& tablesFile, const TableInfo& tables, bool anyWorld);

/// MCL on a source: what eval and localize do alike.
class Localization {
 public:
  explicit Localization(const LocalizationArguments& arguments);
  ~Localization();

  /// The next update of the belief, or nothing at the end of the source.
  /// @throws Interrupted, std::runtime_error
  std::optional<EvaluationStep> next();

  /// Called for every moment of the source, before it is looked at by MCL.
  void onMoment(std::function<void(const Feeder&)> listener) { listener_ = std::move(listener); }

  Feeder& feeder() { return *feeder_; }
  const Source& source() const { return *source_; }
  const Robot& robot() const { return *robot_; }
  const MclConfig& config() const { return config_; }

 private:
  /// Where the samples start, as the command line says.
  struct Start {
    enum class Kind { kGlobal, kTruth, kPose } kind = Kind::kGlobal;
    Pose2 pose;
    double sigmaPosition = 0.0;  ///< [m]
    double sigmaHeading = 0.0;   ///< [rad]

    static Start read(const LocalizationArguments& arguments);
  };

  bool isStarted();

  std::string sourceName_;
  Start start_;
  std::unique_ptr<Robot> robot_;
  std::unique_ptr<Source> source_;
  std::unique_ptr<Feeder> feeder_;
  MclConfig config_;
  std::unique_ptr<Mcl> mcl_;
  std::function<void(const Feeder&)> listener_;
  bool waitsForTruth_ = false;
  double milliseconds_ = 0.0;  ///< of updates since the last one that weighed
};

}  // namespace ortung::app
