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

/// Readings of a robot beside where it was.
struct NoiseLog {
  struct Reading {
    Timestamp stamp = 0;
    std::vector<std::uint32_t> words;
  };
  std::vector<std::pair<Timestamp, Pose2>> reference;    ///< in the order of time
  std::map<std::string, std::vector<Reading>> readings;  ///< by "model/type/feature"
};

/// Keeps the newest readings of all features that localize, if they are new.
class ORTUNG_API NoiseLogger {
 public:
  void look(const SensorContainer& container, NoiseLog& log);

 private:
  std::map<const SensorData*, std::uint64_t> seen_;
};

/// How to learn.
struct NoiseLearning {
  ByNoiseTerm<bool> wanted = {true, true, true, true, true, true, true, true, true, true, true};
  double longestGap = 1.0;          ///< of the reference, within which it is interpolated [s]
  std::size_t mostValues = 100000;  ///< of longer logs some readings and beams count
};

/// The noise of features that are of one device, pooled.
struct LearnedNoise {
  std::size_t readings = 0;  ///< with a reference
  NoiseFit fit;
};

/// Learns from residuals: readings beside what the features expect at the reference, interpolated
/// between the cells and directions of their tables. Distances beyond reach say nothing.
/// @param features of one device, with tables; they take readings of the logs meanwhile
/// @param tables what their tables say of themselves
/// @throws std::runtime_error if there are too few values, or the features' format has no
///   expectations to compare with
ORTUNG_API LearnedNoise learnNoise(std::span<SensorData* const> features, const TableInfo& tables,
                                   std::span<const NoiseLog> logs, const NoiseLearning& how);

}  // namespace ortung
