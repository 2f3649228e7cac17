#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Source.hpp"

namespace ortung {

/// A foreign log as a source: the constructor of a derived class reads the whole log and adds
/// readings in any order; next() returns them in the order of time. Not thread-safe.
class ORTUNG_API LogSource : public Source {
 public:
  ~LogSource() override;
  /// The next reading; false at the end.
  bool next(Message& message) final;
  /// Share of the readings that were returned, in [0, 1].
  double progress() const final;

 protected:
  /// Adds a feature. @return its number; readings of one time come in the order of these numbers
  std::uint32_t addFeature(SensorId id);
  /// Adds a reading. @param words as the feature's SensorData reads them
  void add(std::uint32_t feature, Timestamp stamp, std::span<const std::uint32_t> words);
  /// Sorts the readings by time. Of two readings of a feature at one time the last added one stays.
  /// @param where file for the error
  /// @throws std::runtime_error if there is no reading at all
  void finish(const std::string& where);

 private:
  struct Entry {
    Timestamp stamp;
    std::uint32_t feature;
    std::uint32_t count;
    std::size_t firstWord;
  };
  std::vector<SensorId> features_;    ///< features by their numbers
  std::vector<Entry> entries_;        ///< readings, sorted by finish()
  std::vector<std::uint32_t> words_;  ///< words of all readings
  std::size_t at_ = 0;                ///< index of the next reading
};

/// Makes readings of odometry from poses; velocities are their differences. Not thread-safe.
class ORTUNG_API PoseOdometry {
 public:
  /// Returns the words of OdometryData for a pose. @pre stamps do not decrease
  std::vector<std::uint32_t> words(Timestamp stamp, const Pose2& pose);
  /// Returns what is said of steps that no robot takes, for a remark; "" if there was none.
  std::string remark() const;

 private:
  std::size_t leaps_ = 0;  ///< number of steps that no robot takes
  std::optional<std::pair<Timestamp, Pose2>> last_;
  double translational_ = 0.0;  ///< newest translational velocity [m/s]
  double rotational_ = 0.0;     ///< newest rotational velocity [rad/s]
};

/// Returns the pose after moving with constant velocities along an arc (exact).
/// @param pose pose at the beginning
/// @param v translational velocity [m/s]
/// @param w rotational velocity [rad/s]
/// @param seconds duration [s]
ORTUNG_API Pose2 alongArc(const Pose2& pose, double v, double w, double seconds);

/// Returns a direction of travel for each place [rad], for ground truths that have no heading: the
/// direction from the last to the next of those places that are @p step [m] apart; 0 for all if
/// there is no such step.
ORTUNG_API std::vector<double> headingsOfWay(std::span<const Pose2> places, double step);

/// Formats a number as TOML, e.g. "1.5": the shortest text that reads back the same, with a decimal
/// point, so that TOML reads it as a float.
ORTUNG_API std::string tomlNumber(double value);
/// Formats text as a quoted and escaped TOML string.
ORTUNG_API std::string tomlText(const std::string& text);

}  // namespace ortung
