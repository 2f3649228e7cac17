/// scanlog2rawlog --stamps LOG.rawlog: prints the time [s] of every step that MRPT's programs make
/// of a log of actions and observations. scanlog2rawlog OUT.rawlog < scans.txt: brings a neutral
/// text log of scans with odometry (t odom_x odom_y odom_theta n r1..rn; the first comment line
/// names the beams' step as "k*STEP rad", where beam 0 looks at -90 degrees, or "ANGLES FIRST
/// STEP", and may say where the scanner is, as "sensor at x=X m") to MRPT's rawlog format, so that
/// MRPT's own programs can be compared on it.

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr double kFirstAngle = -std::numbers::pi / 2;  // [rad]
constexpr float kMaxRange = 30.0F;  // SICK scanners say 32.8 and more for "nothing" [m]
constexpr float kNoise = 0.02F;     // [m]
constexpr std::size_t kMostBeams = 8192;

struct Scan {
  double stamp = 0.0;  // [s]
  mrpt::poses::CPose2D odometry;
  std::vector<float> ranges;  // [m]
};

[[noreturn]] void fail(std::size_t line, const std::string& message) {
  throw std::runtime_error("line " + std::to_string(line) + ": " + message);
}

/// How the scanner looks and where it is, as the log's first comment says.
struct Scanner {
  double first = kFirstAngle;  // angle of beam 0 [rad]
  double step = 0.0;           // [rad]
  double x = 0.0;              // before the robot's centre [m]
};

std::optional<Scanner> scannerOf(const std::string& comment) {
  Scanner scanner;
  const auto behind = [&](const char* text) -> const char* {
    const std::size_t at = comment.find(text);
    return at == std::string::npos ? nullptr : comment.c_str() + at + std::string_view(text).size();
  };
  if (const char* angles = behind("ANGLES")) {
    char* end = nullptr;
    scanner.first = std::strtod(angles, &end);
    scanner.step = std::strtod(end, nullptr);
  } else if (const char* step = behind("k*")) {
    scanner.step = std::strtod(step, nullptr);
  }
  if (const char* x = behind("sensor at x=")) scanner.x = std::strtod(x, nullptr);
  if (scanner.step <= 1e-4 || scanner.step >= 1.0) return std::nullopt;
  return scanner;
}

Scan parse(const std::string& text, std::size_t line) {
  std::istringstream in(text);
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;
  std::size_t beams = 0;
  Scan scan;
  if (!(in >> scan.stamp >> x >> y >> theta >> beams)) fail(line, "expected t x y theta n");
  if (beams < 2 || beams > kMostBeams) {
    fail(line, "found " + std::to_string(beams) + " beams, expected 2 to 8192");
  }
  scan.odometry = {x, y, theta};
  scan.ranges.resize(beams);
  for (float& range : scan.ranges) {
    if (!(in >> range)) fail(line, "found fewer than " + std::to_string(beams) + " ranges");
  }
  return scan;
}

mrpt::obs::CObservation2DRangeScan::Ptr observationOf(const Scan& scan, const Scanner& scanner) {
  auto observation = mrpt::obs::CObservation2DRangeScan::Create();
  const double span = scanner.step * static_cast<double>(scan.ranges.size() - 1);
  observation->timestamp = mrpt::Clock::fromDouble(scan.stamp);
  observation->sensorLabel = "LASER";
  observation->aperture = static_cast<float>(span);
  observation->rightToLeft = true;
  observation->maxRange = kMaxRange;
  observation->stdError = kNoise;
  // MRPT centres a scan on the sensor's axis.
  observation->sensorPose = mrpt::poses::CPose3D(scanner.x, 0, 0, scanner.first + span / 2, 0, 0);
  observation->resizeScan(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    observation->setScanRange(i, scan.ranges[i]);
    observation->setScanRangeValidity(i, scan.ranges[i] > 0.0F && scan.ranges[i] < kMaxRange);
  }
  return observation;
}

/// The same noise as the defaults of ortung::OdometryMotion.
mrpt::obs::CActionRobotMovement2D motionBetween(const Scan& from, const Scan& to) {
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  options.gaussianModel = {0.1, 0.05, 0.1, 0.1, 0.003, 0.002};
  mrpt::obs::CActionRobotMovement2D motion;
  motion.timestamp = mrpt::Clock::fromDouble(to.stamp);
  motion.computeFromOdometry(to.odometry - from.odometry, options);
  return motion;
}

void convert(std::istream& in, const std::string& file) {
  mrpt::obs::CRawlog log;
  std::optional<Scanner> scanner;
  std::optional<Scan> last;
  std::string text;
  for (std::size_t line = 1; std::getline(in, text); ++line) {
    if (text.empty()) continue;
    if (text[0] == '#') {
      if (!scanner) scanner = scannerOf(text);
      continue;
    }
    if (!scanner) {
      fail(line,
           "no comment before the first scan names the step of the beams (k*STEP, or ANGLES FIRST "
           "STEP)");
    }
    const Scan scan = parse(text, line);
    mrpt::obs::CActionCollection actions;
    actions.insert(motionBetween(last.value_or(scan), scan));
    mrpt::obs::CSensoryFrame frame;
    frame.insert(observationOf(scan, *scanner));
    log.insert(actions);
    log.insert(frame);
    last = scan;
  }
  if (!last) throw std::runtime_error("found no scan");
  if (!log.saveToRawLogFile(file)) throw std::runtime_error("cannot write " + file);
}

/// A step is an action and the observations after it, as CRawlog::getActionObservationPair() reads.
void printStamps(const std::string& file) {
  mrpt::obs::CRawlog log;
  if (!log.loadFromRawLogFile(file)) throw std::runtime_error("cannot read " + file);
  mrpt::obs::CActionCollection::Ptr action;
  mrpt::obs::CSensoryFrame::Ptr observations;
  std::size_t entry = 0;
  while (entry + 1 < log.size() && log.getActionObservationPair(action, observations, entry)) {
    double stamp = 0.0;
    for (const auto& observation : *observations) {
      const bool isScan = IS_CLASS(*observation, mrpt::obs::CObservation2DRangeScan);
      if (isScan || stamp == 0.0) stamp = mrpt::Clock::toDouble(observation->timestamp);
    }
    std::printf("%.6f\n", stamp);
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count == 3 && std::string_view(arguments[1]) == "--stamps") {
      printStamps(arguments[2]);
    } else if (count == 2) {
      convert(std::cin, arguments[1]);
    } else {
      throw std::runtime_error(
          "usage: scanlog2rawlog OUT.rawlog < scans.txt, or scanlog2rawlog --stamps LOG.rawlog");
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scanlog2rawlog: %s\n", error.what());
    return 1;
  }
}
