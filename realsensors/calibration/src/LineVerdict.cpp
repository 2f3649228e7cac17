#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "ortung/calibration/LineCalibration.hpp"

namespace ortung {
namespace {

// What an error means for a robot: a place 3 m away is off by about as much as its localization.
constexpr double kMostFloorSigma = 0.03;
constexpr double kMostShare = 0.04;  ///< greatest sigma of focal length and height / the value
constexpr double kMostTilt =
    2.0;  ///< greatest sigma of the tilt, which a shift of the centre replaces [degrees]
constexpr double kMostRoll = 1.5;         ///< greatest sigma of the roll [degrees]
constexpr double kMostCentre = 0.02;      ///< greatest sigma of the centre / the longer side
constexpr double kMostDistortion = 0.06;  ///< greatest sigma of k1 and k2
constexpr double kLeastPoints = 40.0;     ///< least number of points within 5 m
constexpr double kLeastKind = 3;          ///< number of cameras from which a kind is known

constexpr const char* kMoreNear = "pictures that show more lines within 5 m";
constexpr const char* kMoreDirections =
    "pictures that show lines in several directions near the camera, as corners and the circle";
constexpr const char* kMorePlaces = "pictures that show the field from other places";

const LineSetting& settingOf(const LineCalibration& c, const std::string& name) {
  return *std::find_if(c.settings.begin(), c.settings.end(),
                       [&](const LineSetting& s) { return s.name == name; });
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void addPictureChecks(const LineCalibration& c, std::vector<Check>& checks) {
  double near = 0.0;
  double stray = 0.0;
  LinesInSight seen;
  for (const LinePictureFit& fit : c.pictures) {
    near += static_cast<double>(fit.points);
    stray += static_cast<double>(fit.strayNear);
    seen.found += fit.inSight.found;
    seen.missing += fit.inSight.missing;
    seen.marksFound += fit.inSight.marksFound;
    seen.marksMissing += fit.inSight.marksMissing;
  }
  checks.push_back({"points within 5 m", near, kLeastPoints, true, "", 0, kMoreNear});
  checks.push_back({"of these on no line", 100.0 * stray / std::max(1.0, near), 20.0, false, "%", 0,
                    "pictures that show this field alone, without things that look like lines"});
  checks.push_back({"lines in sight that were not found", 100.0 * seen.missingShare(), 25.0, false,
                    "%", 0, kMorePlaces});
  const int marks = seen.marksFound + seen.marksMissing;
  if (marks > 0)
    checks.push_back({"marks in sight that were not found", 100.0 * seen.marksMissing / marks, 50.0,
                      false, "%", 0, kMorePlaces});
}

void addSigmaChecks(const LineCalibration& c, std::vector<Check>& checks) {
  const ImageSize size = c.view.model().size();
  const auto share = [&](const char* name) {
    const LineSetting& s = settingOf(c, name);
    return 100.0 * s.sigma / s.value;
  };
  checks.push_back({"sigma of places 1 to 3 m away", 100.0 * c.floorSigma, 100.0 * kMostFloorSigma,
                    false, "%", 1, kMoreDirections});
  checks.push_back({"sigma of the focal length", share("focal_px"), 100.0 * kMostShare, false, "%",
                    1, kMoreDirections});
  checks.push_back({"sigma of the height", share("height_m"), 100.0 * kMostShare, false, "%", 1,
                    kMoreDirections});
  checks.push_back({"sigma of the tilt", settingOf(c, "tilt_deg").sigma, kMostTilt, false,
                    "degrees", 2, kMoreDirections});
  checks.push_back({"sigma of the roll", settingOf(c, "roll_deg").sigma, kMostRoll, false,
                    "degrees", 2, kMoreDirections});
  checks.push_back(
      {"sigma of the centre",
       std::hypot(settingOf(c, "centre_u_px").sigma, settingOf(c, "centre_v_px").sigma),
       kMostCentre * std::max(size.width, size.height) * std::sqrt(2.0), false, "px", 1,
       kMoreDirections});
  checks.push_back({"sigma of the distortion",
                    std::max(settingOf(c, "k1").sigma, settingOf(c, "k2").sigma), kMostDistortion,
                    false, "", 3, kMoreDirections});
}

void addKindCheck(const LineCalibration& c, const LineCalibrationGuess& guess,
                  std::vector<Check>& checks) {
  if (static_cast<double>(guess.kind.size()) < kLeastKind) return;
  const double median = medianOf(guess.kind);
  std::vector<double> off;
  for (const double focal : guess.kind) off.push_back(std::abs(focal - median));
  // Of a normal distribution, the median deviation is 0.6745 sigmas. Lenses of one kind differ by
  // a per cent even where the others happen to agree better.
  const double spread = std::max(medianOf(off) / 0.6745, 0.01 * median);
  const LineSetting& focal = settingOf(c, "focal_px");
  checks.push_back({"focal length against its kind",
                    std::abs(focal.value - median) / std::hypot(spread, focal.sigma), 3.0, false,
                    "sigmas", 1, kMorePlaces});
}

}  // namespace

Verdict judgeCalibration(const LineCalibration& calibration, const LineCalibrationGuess& guess) {
  Verdict verdict;
  if (calibration.settings.empty()) return verdict;
  std::vector<Check>& checks = verdict.checks;
  addPictureChecks(calibration, checks);
  checks.push_back(
      {"cost of the second-best camera", calibration.rivalCost, 9.0, true, "", 1, kMorePlaces});
  double most = 0.0;
  // What was expected of the distortion is a guess at the kind of lens.
  for (const LineSetting& s : calibration.settings)
    if (s.name != "k1" && s.name != "k2")
      most = std::max(most, std::abs(s.value - s.expected) / s.expectedSigma);
  checks.push_back(
      {"setting farthest from what was expected", most, 3.0, false, "sigmas", 1, kMorePlaces});
  if (calibration.pictures.size() > 1)
    checks.push_back({"change of the focal length without a picture", calibration.mostChange, 5.0,
                      false, "sigmas", 1, kMorePlaces});
  addKindCheck(calibration, guess, checks);
  addSigmaChecks(calibration, checks);
  return verdict;
}

}  // namespace ortung
