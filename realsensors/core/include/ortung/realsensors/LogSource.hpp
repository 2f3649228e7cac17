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

/// A foreign log as a source: a derived class reads the whole log when it is made and adds readings
/// in any order; they are given in the order of time. Not thread-safe.
class ORTUNG_API LogSource : public Source {
 public:
  ~LogSource() override;
  bool next(Message& message) final;
  double progress() const final;

 protected:
  /// A feature's number. Readings of one moment come in the order of these numbers.
  std::uint32_t addFeature(SensorId id);
  void add(std::uint32_t feature, Timestamp stamp, std::span<const std::uint32_t> words);
  /// Puts readings in the order of time. Of two of a feature at one moment the later added stays.
  /// @throws std::runtime_error if there is no reading at all
  void finish(const std::string& where);

 private:
  struct Entry {
    Timestamp stamp;
    std::uint32_t feature;
    std::uint32_t count;
    std::size_t firstWord;
  };
  std::vector<SensorId> features_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> words_;
  std::size_t at_ = 0;
};

/// Odometry poses, whose velocities follow from their differences. Not thread-safe.
class ORTUNG_API PoseOdometry {
 public:
  /// Words of OdometryData for the pose at a time; stamps must not fall.
  std::vector<std::uint32_t> words(Timestamp stamp, const Pose2& pose);

 private:
  std::optional<std::pair<Timestamp, Pose2>> last_;
  double translational_ = 0.0;  ///< [m/s]
  double rotational_ = 0.0;     ///< [rad/s]
};

/// Pose after moving with constant velocities: along an arc, exactly.
/// @param v [m/s] @param w [rad/s] @param seconds [s]
ORTUNG_API Pose2 alongArc(const Pose2& pose, double v, double w, double seconds);

/// Directions of the way along @p places [rad], for truths that know no heading: of each the one
/// from the last to the next of those that are @p step [m] apart. Those before the first step are 0
/// if there is none.
ORTUNG_API std::vector<double> headingsOfWay(std::span<const Pose2> places, double step);

/// "1.5", as short as it reads back the same; always with a point, so that TOML takes it for a
/// float.
ORTUNG_API std::string tomlNumber(double value);
/// A TOML string with everything escaped that must be.
ORTUNG_API std::string tomlText(const std::string& text);

}  // namespace ortung
