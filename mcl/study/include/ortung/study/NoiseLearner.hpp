#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/study/NoiseFit.hpp"

namespace ortung {

/// Readings of a robot with its true poses.
struct NoiseLog {
  struct Reading {
    Timestamp stamp = 0;               ///< stamp of the reading [us]
    std::vector<std::uint32_t> words;  ///< data of the reading, in the feature's format
  };
  std::vector<std::pair<Timestamp, Pose2>> reference;  ///< true poses, field frame; stamps rise
  /// Readings in order of time, keyed by "model/type/feature".
  std::map<std::string, std::vector<Reading>> readings;
};

/// Collects new readings of all features that localize. Not thread-safe.
class ORTUNG_API NoiseLogger {
 public:
  /// Appends readings that are newer than those of the last call.
  void look(const SensorContainer& container, NoiseLog& log);

 private:
  std::map<const SensorData*, std::uint64_t> seen_;
};

/// Options of learning noise.
struct NoiseLearning {
  /// Terms of the systematic error that are learned.
  ByNoiseTerm<bool> wanted = {true, true, true, true, true, true, true, true, true, true, true};
  double longestGap = 1.0;  ///< longest gap over which the reference is interpolated [s]
  /// Most values; longer logs are thinned to some readings and beams.
  std::size_t mostValues = 100000;
};

/// The noise of the features of one device, pooled.
struct LearnedNoise {
  std::size_t readings = 0;  ///< number of readings with a reference
  NoiseFit fit;
};

/// Learns the noise from residuals: readings minus the features' expectations at the reference,
/// interpolated between the cells and directions of their tables. Distances beyond the range are
/// not used.
/// @param features features of one device, with tables; their readings are overwritten by the logs'
/// @param tables description of their tables
/// @throws std::runtime_error if there are too few values, or the features' format has no
///   expectations to compare with
ORTUNG_API LearnedNoise learnNoise(std::span<SensorData* const> features, const TableInfo& tables,
                                   std::span<const NoiseLog> logs, const NoiseLearning& how);

}  // namespace ortung
