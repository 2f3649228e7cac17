#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung {

/// Everything that a robot learns in a world, from both to the table file: `ortung learn` as a
/// library. The tables do not depend on the number of threads. Not thread-safe.
class ORTUNG_API TableLearner {
 public:
  struct Settings {
    double cell = 0.1;            ///< edge length of a cell [m]
    double headingStepDeg = 2.0;  ///< angle between headings [degrees]; divides a turn
    std::string area = "auto";    ///< part of the floor, as learnAreaOf() reads it
    unsigned threads = 1;         ///< threads that generate readings
    /// @throws std::invalid_argument naming the setting, its value and what was expected
    void check() const;
  };

  /// @param world without moving bodies
  /// @throws ConfigError, PluginError; std::invalid_argument for settings out of their range, and
  ///   as Learner and learnAreaOf()
  TableLearner(std::unique_ptr<SimWorld> world, RobotConfig robot, const Settings& settings);
  ~TableLearner();
  TableLearner(const TableLearner&) = delete;
  TableLearner& operator=(const TableLearner&) = delete;

  Learner& learner();
  const SimWorld& world() const;
  const RobotConfig& robot() const;
  const FieldRegion& region() const;
  /// Returns the area of the other parts of the floor on which the robot could stand [m^2].
  double leftOut() const;

  /// Writes the tables. @pre all was learned @returns how many bytes the file has
  /// @throws TableError
  std::uintmax_t write(const std::filesystem::path& out) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung
