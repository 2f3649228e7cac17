#include "LineRivals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kNear = 5.0;          ///< range within which cameras are compared [m]
constexpr double kOtherCamera = 0.04;  ///< difference of places / their range of another camera
constexpr int kGrid = 12;              ///< rows and columns of pixels that are compared
constexpr std::size_t kLeftOut = 12;   ///< greatest number of pictures that are left out in turn
constexpr double kLeastChange = 0.02;  ///< changes of a focal length's share that mean nothing

/// Calls @p what for an even grid of pixels.
template <typename What>
void eachPixel(ImageSize size, const What& what) {
  for (int row = 0; row < kGrid; ++row)
    for (int column = 0; column < kGrid; ++column)
      what(Pixel{(column + 0.5) * size.width / kGrid - 0.5,
                 (row + 0.5) * size.height / kGrid - 0.5});
}

/// Whether the same pixels show other places of the floor within 5 m.
bool isOtherCamera(const CameraView& a, const CameraView& b) {
  double sum = 0.0;
  int count = 0;
  eachPixel(a.model().size(), [&](const Pixel& pixel) {
    const auto here = a.floorAt(pixel);
    if (!here || std::hypot(here->x, here->y) > kNear) return;
    const auto there = b.floorAt(pixel);
    const double off = there ? std::hypot(there->x - here->x, there->y - here->y) /
                                   std::max(1.0, std::hypot(here->x, here->y))
                             : 1.0;
    sum += std::min(1.0, off * off);
    ++count;
  });
  return count == 0 || std::sqrt(sum / count) > kOtherCamera;
}

/// Sigma of the ranges of places 1 to 3 m away, as a share of them.
double floorSigmaOf(ImageSize size, const Settings& settings,
                    const SettingsCovariance& covariance) {
  const CameraView view = viewOf(size, settings);
  std::vector<CameraView> shifted;
  Settings shifts;
  for (int k = 0; k < kSettings; ++k) {
    // A tenth of a sigma: small enough for a slope, large enough for its digits.
    shifts[k] = std::max(1e-6, 0.1 * std::sqrt(std::max(0.0, covariance(k, k))));
    Settings s = settings;
    s[k] += shifts[k];
    shifted.push_back(viewOf(size, s));
  }
  double sum = 0.0;
  int count = 0;
  eachPixel(size, [&](const Pixel& pixel) {
    const auto here = view.floorAt(pixel);
    if (!here) return;
    const double range = std::hypot(here->x, here->y);
    if (range < 1.0 || range > 3.0) return;
    Settings slope;
    for (int k = 0; k < kSettings; ++k) {
      const auto there = shifted[static_cast<std::size_t>(k)].floorAt(pixel);
      slope[k] = there ? (std::hypot(there->x, there->y) - range) / (range * shifts[k]) : 0.0;
    }
    sum += slope.dot(covariance * slope);
    ++count;
  });
  return count > 0 ? std::sqrt(sum / count) : std::numeric_limits<double>::infinity();
}

/// What a setting is called and measured in.
struct Unit {
  const char* name;
  double factor;  ///< factor of the setting's own unit; logarithms: 0
};
constexpr std::array<Unit, kSettings> kUnits = {{{"focal_px", 0.0},
                                                 {"k1", 1.0},
                                                 {"k2", 1.0},
                                                 {"centre_u_px", 1.0},
                                                 {"centre_v_px", 1.0},
                                                 {"tilt_deg", 1.0 / kDegree},
                                                 {"roll_deg", 1.0 / kDegree},
                                                 {"height_m", 0.0}}};

void addSettings(LineCalibration& out, const LineSolution& solution, const Settings& priorSigmas,
                 const SettingsCovariance& covariance) {
  Settings factors;
  for (int k = 0; k < kSettings; ++k) {
    const Unit& unit = kUnits[static_cast<std::size_t>(k)];
    const bool isLogarithm = unit.factor == 0.0;
    const auto valueOf = [&](double s) { return isLogarithm ? std::exp(s) : unit.factor * s; };
    factors[k] = isLogarithm ? valueOf(solution.settings[k]) : unit.factor;
    const double prior = isLogarithm ? valueOf(solution.prior[k]) : unit.factor;
    out.settings.push_back({unit.name, valueOf(solution.settings[k]),
                            factors[k] * std::sqrt(covariance(k, k)), valueOf(solution.prior[k]),
                            prior * priorSigmas[k]});
  }
  for (int row = 0; row < kSettings; ++row)
    for (int column = 0; column < kSettings; ++column)
      out.covariance.push_back(factors[row] * factors[column] * covariance(row, column));
}

/// Judges the place of each picture with the camera of a solution.
void judgePlaces(const LineFit& fit, const LineSolution& solution, const LinePoseSearch& field,
                 std::span<const LinePicture> pictures, std::vector<LinePictureFit>& fits) {
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const CameraView view = fit.viewOf(solution.settings, i);
    const LineFit::Places places = fit.placesOf(solution.settings, i);
    fits[i].inSight = linesInSight(field.lines(), view, solution.poses[i], pictures[i].points,
                                   pictures[i].floor, kNear);
    fits[i].place =
        judgePose(field, places.points, places.sigmas, solution.poses[i], fits[i].inSight);
  }
}

/// The greatest change of the focal length without one of the pictures, in sigmas of the change:
/// what a picture adds makes the focal length surer by as much as it may change it (Hausman).
double mostChangeOf(const LineSolution& best, double sigma, std::span<const LinePicture> pictures,
                    const LineFit& fit, const LineCalibrationGuess& guess) {
  double most = 0.0;
  if (pictures.size() < 2) return most;
  for (std::size_t i = 0; i < std::min(pictures.size(), kLeftOut); ++i) {
    std::vector<LinePicture> others(pictures.begin(), pictures.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    LineSolution without = best;
    without.poses.erase(without.poses.begin() + static_cast<std::ptrdiff_t>(i));
    const LineFit rest(fit.size(), others, fit.field(), guess);
    if (rest.points() == 0) continue;
    rest.refine(without, 20);
    const double wider = rest.certainty(without).covariance(kFocal, kFocal);
    const double change = std::abs(without.settings[kFocal] - best.settings[kFocal]);
    most = std::max(
        most, change / std::sqrt(std::max(wider - sigma * sigma, kLeastChange * kLeastChange)));
  }
  return most;
}

}  // namespace

LineCalibration describe(const LineFit& fit, std::span<const LineSolution> found,
                         std::span<const LinePicture> pictures, const LineCalibrationGuess& guess) {
  std::vector<LineSolution> all(found.begin(), found.end());
  const auto isCheaper = [](const LineSolution& a, const LineSolution& b) {
    return a.cost < b.cost;
  };
  // A picture taken elsewhere may mean another camera.
  std::vector<LinePictureFit> fits = fit.fits(found[0]);
  judgePlaces(fit, found[0], fit.field(), pictures, fits);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!std::isfinite(fits[i].place.rivalCost) ||
        fit.placesOf(found[0].settings, i).points.empty())
      continue;
    LineSolution other = found[0];
    other.poses[i] = fits[i].place.rival;
    fit.refine(other, 25);
    all.push_back(std::move(other));
  }
  std::stable_sort(all.begin(), all.end(), isCheaper);
  const LineSolution& best = all.front();
  LineCalibration out{
      .view = viewOf(fit.size(), best.settings), .cost = best.cost, .pictures = fit.fits(best)};
  judgePlaces(fit, best, fit.field(), pictures, out.pictures);
  const LineFit::Certainty certainty = fit.certainty(best);
  addSettings(out, best, fit.priorSigmas(), certainty.covariance);
  out.points = certainty.points;
  out.floorSigma = floorSigmaOf(fit.size(), best.settings, certainty.covariance);
  out.rivalCost = std::numeric_limits<double>::infinity();
  for (const LineSolution& other : all) {
    const CameraView view = viewOf(fit.size(), other.settings);
    if (!isOtherCamera(out.view, view)) continue;
    out.rivalCost = (other.cost - best.cost) * out.points;
    out.rivalFocal = std::exp(other.settings[kFocal]);
    break;
  }
  out.mostChange =
      mostChangeOf(best, std::sqrt(certainty.covariance(kFocal, kFocal)), pictures, fit, guess);
  out.verdict = judgeCalibration(out, guess);
  return out;
}

void considerRival(LineCalibration& calibration, const LineCalibration& other) {
  if (!isOtherCamera(calibration.view, other.view)) return;
  const double cost = (other.cost - calibration.cost) * calibration.points;
  if (cost >= calibration.rivalCost) return;
  calibration.rivalCost = cost;
  calibration.rivalFocal = other.settings.empty() ? 0.0 : other.settings[0].value;
}

}  // namespace ortung
