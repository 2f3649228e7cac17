#pragma once

#include <memory>

#include "ortung/base/Random.hpp"
#include "ortung/core/Message.hpp"
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
/// Faults of a share of what a reading tells: beams, landmarks, rows.
/// @param feature whose readings they are; it must live as long
std::unique_ptr<Disturbance> makeEntriesFault(const Fault& fault, const SensorData& feature,
                                              const Random& random);
/// People who stand and walk slowly around a scanner, with it wherever it goes.
std::unique_ptr<Disturbance> makeCrowd(const ScanData::Config& scan, Random random);

/// Which of these makes a kind.
enum class FaultOf { kReading, kOdometry, kScan };
FaultOf groupOf(Fault::Kind kind);

}  // namespace ortung
