#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ortung/core/PluginFactory.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/server/PlainWorld.hpp"

namespace ortung {

/// A record for the message board, as if it were a simulator: a cycle is a moment of the record,
/// and every robot gets those of its readings that its configuration has. It begins when the first
/// robot is there. Commands of motion and manipulators are taken and come to nothing.
/// Not thread-safe.
class ORTUNG_API ServedRecord : public PlainWorld {
 public:
  /// @param repeats whether it starts over at the end, time going on
  /// @throws std::runtime_error if it is no record
  explicit ServedRecord(std::filesystem::path file, bool repeats = false);
  ~ServedRecord() override;

  WorldDescription describe() const override;
  std::vector<std::string> plugins() const override { return plugins_; }
  /// Stamp of the next time step; in repetitions time goes on.
  Timestamp now() const override { return now_; }
  bool isReady() const override { return hasBegun_ || !guests_.empty(); }
  bool isAtEnd() const override { return isAtEnd_; }
  /// Gives the readings of the next time step of the record, and reads one further ahead.
  void step() override;
  /// Gives a client's robot the record's readings of the features in its configuration.
  ServedRobot addRobot(RobotId robot, RobotWish wish) override;
  std::vector<std::string> abilities(RobotId) const override { return {}; }
  void removeRobot(RobotId robot) override;
  std::span<Message> readings(RobotId robot) override;
  RobotCommands& commands(RobotId robot) override;
  /// Begins the record anew; it has no random numbers, so the seed changes nothing.
  void reset(std::optional<std::uint64_t> seed) override;
  /// A record can't be changed: placing throws a ServeError.
  void placeRobot(RobotId robot, const Pose2& pose) override;
  void placeObject(const std::string& object, const Pose2& pose) override;

 private:
  struct Guest;
  /// Takes all commands, and nothing comes of them.
  class Deaf final : public RobotCommands {
   public:
    ~Deaf() override = default;
    void setTranslationalVelocity(double) override {}
    void setRotationalVelocity(double) override {}
    void setMotion(std::span<const double>) override {}
    void setManipulator(std::string_view, std::string_view) override {}
  };
  /// Opens the record from its beginning.
  void open();
  /// Reads the next time step, or notes the end of the record.
  void readAhead();
  /// @throws ServeError if there is no such robot
  void check(RobotId robot) const;

  std::filesystem::path file_;
  bool repeats_;
  PluginFactory factory_;
  std::vector<std::string> plugins_;
  std::unique_ptr<RecordSource> source_;
  std::unique_ptr<FrameReader> reader_;
  std::vector<Message> ahead_;  ///< the moment that the next step gives
  Timestamp now_ = 0;
  Timestamp shift_ = 0;  ///< difference of our stamps to the record's, for repetitions [us]
  bool hasBegun_ = false;
  bool isAtEnd_ = false;
  std::map<RobotId, std::unique_ptr<Guest>> guests_;
  Deaf deaf_;
};

}  // namespace ortung
