#pragma once

#include <memory>

#include "ortung/base/Random.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/study/Fault.hpp"

namespace ortung {

/// One fault at work on one feature; keeps what it has to remember of the readings so far.
class Disturbance {
 public:
  virtual ~Disturbance();
  /// Called for each reading of the feature in the order of time.
  /// @param seconds since the first reading of the run
  /// @param isNow whether the fault's time is now; else the reading is only looked at
  /// @returns false if the reading does not come
  virtual bool alter(Message& message, double seconds, bool isNow) = 0;
};

/// Faults that any feature can have.
std::unique_ptr<Disturbance> makeReadingFault(const Fault& fault, const Random& random);
/// Faults of what a robot says of its own motion.
std::unique_ptr<Disturbance> makeOdometryFault(const Fault& fault);
/// Faults of a scan's beams.
std::unique_ptr<Disturbance> makeScanFault(const Fault& fault, const ScanData::Config& scan,
                                           const Random& random);
/// A share of the landmarks in sight is another one anywhere.
std::unique_ptr<Disturbance> makeLandmarksFault(const Fault& fault,
                                                const LandmarksData::Config& landmarks,
                                                const Random& random);
/// People who stand and walk slowly around a scanner, with it wherever it goes.
std::unique_ptr<Disturbance> makeCrowd(const ScanData::Config& scan, Random random);

/// Which of these makes a kind.
enum class FaultOf { kReading, kOdometry, kScan };
FaultOf groupOf(Fault::Kind kind);

}  // namespace ortung
