#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/core/Traceable.hpp"
#include "ortung/core/Weigher.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/tables/SurfaceField.hpp"

namespace ortung {

/// The beams of one scan as they lie in the field, by its table's surfaces. Immutable.
class ORTUNG_API ScanTrace {
 public:
  /// Makes a weigher of ranges in the order of beams [m]; NaN: not valid.
  using Make = std::function<std::shared_ptr<const Weigher>(std::span<const float>)>;

  /// @param mount of the sensor on the robot @param ranges of all beams [m]
  ScanTrace(std::shared_ptr<const SurfaceField> surfaces, const Pose2& mount,
            const ScanData::Config& config, std::span<const float> ranges, Make make);

  void trace(const Pose2& pose, std::vector<TracedBeam>& beams) const;
  std::shared_ptr<const Weigher> without(const std::vector<bool>& dropped) const;

 private:
  std::shared_ptr<const SurfaceField> surfaces_;
  Pose2 mount_;
  ScanData::Config config_;
  std::vector<float> ranges_;
  Make make_;
};

}  // namespace ortung
