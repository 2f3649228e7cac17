#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/formats/ScanData.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/FieldRegion.hpp"

/// What the benchmarks share: a field in closed form, clouds of samples on it, and stopwatches.
namespace ortung::bench {

inline constexpr double kLength = 18.0;   ///< of the field within its walls [m]
inline constexpr double kWidth = 12.0;    ///< [m]
inline constexpr double kCell = 0.10;     ///< of all tables [m]
inline constexpr int kBeams = 180;        ///< one a degree, the first straight to the right
inline constexpr double kMaxRange = 8.0;  ///< [m]
inline constexpr std::size_t kSamples = 10'000;
inline constexpr double kRadiansADegree = 0.017453292519943295;

/// Distance to the nearest wall, goal or post along a ray [m]. Walls stand around the field, a goal
/// box of 0.75 x 2.4 m reaches into it at both ends, and four posts of radius 0.1 m stand in it.
double castRay(double x, double y, double angle);
bool isInsideSolid(double x, double y);
const FieldRegion& fieldRegion();

/// The pose from which the readings are taken, around which concentrated clouds lie.
inline constexpr Pose2 kRobot{1.3, -0.7, 0.4};

SampleSet spreadCloud(std::size_t n);        ///< over the whole field and all headings
SampleSet concentratedCloud(std::size_t n);  ///< sigma 0.1 m, 0.05 rad
SampleSet cloud(bool spread, std::size_t n);

/// Ranges that a scanner at the robot's origin reads, without noise; infinity: nothing in range.
std::vector<float> scanAt(const Pose2& pose, int beams = kBeams);

/// A scanner that has learned the field, or a part of it, and reads it from kRobot.
std::unique_ptr<ScanData> learnedScan(ScanData::Perception perception, double headingStepDegrees,
                                      const FieldRegion& region = fieldRegion());

/// Nanoseconds that this thread has computed since construction; other programs do not count.
class Stopwatch {
 public:
  Stopwatch();
  double nanoseconds() const;

 private:
  double start_;
};

/// Runs @p work once for each iteration of a benchmark and returns the nanoseconds of the fastest:
/// what the code costs where no other program disturbs caches and clock.
template <class State, class Work>
double fastest(State& state, Work work) {
  work();  // caches and lazily made tables
  double best = 0.0;
  for (auto _ : state) {
    const Stopwatch watch;
    work();
    const double taken = watch.nanoseconds();
    if (best == 0.0 || taken < best) best = taken;
  }
  return best;
}

/// Results of this run by name, so that later benchmarks can say how they compare.
void remember(const std::string& name, double nanoseconds);
std::optional<double> recall(const std::string& name);

}  // namespace ortung::bench
