#include "ortung/calibration/LineCalibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "LineFit.hpp"
#include "LineRivals.hpp"

namespace ortung {
namespace {

constexpr std::size_t kRefined = 10;                       ///< number of tries that are refined
constexpr std::array<double, 2> kFloorEnds = {8.0, 25.0};  ///< [m]

/// Tries focal lengths, heights and horizons one by one: the best first.
std::vector<LineSolution> bestTries(const LineFit& fit, const LineCalibrationGuess& guess,
                                    const std::function<void()>& tell) {
  const std::array<double, 3> heights = {guess.height * std::exp(-guess.heightShare), guess.height,
                                         guess.height * std::exp(guess.heightShare)};
  std::vector<LineSolution> tries;
  for (const double focal : guess.focals)
    for (const double height : heights)
      for (const double far : kFloorEnds) {
        const Settings start = fit.start(focal, height, far);
        Settings prior = start;
        prior[kHeight] = std::log(guess.height);
        tries.push_back(fit.search(start, prior));
        tell();
      }
  std::sort(tries.begin(), tries.end(),
            [](const LineSolution& a, const LineSolution& b) { return a.cost < b.cost; });
  tries.resize(std::min(tries.size(), kRefined));
  return tries;
}

}  // namespace

std::optional<LineCalibration> calibrateByLines(ImageSize size,
                                                std::span<const LinePicture> pictures,
                                                const LinePoseSearch& field,
                                                const LineCalibrationGuess& guess,
                                                const std::function<void(double)>& progress) {
  if (std::all_of(pictures.begin(), pictures.end(),
                  [](const LinePicture& p) { return p.points.empty(); }))
    return std::nullopt;
  const LineFit fit(size, pictures, field, guess);
  double done = 0.0;
  const double all = static_cast<double>(guess.focals.size() * 3 * kFloorEnds.size() + kRefined);
  const auto tell = [&] {
    if (progress) progress(std::min(1.0, ++done / all));
  };
  std::vector<LineSolution> found = bestTries(fit, guess, tell);
  for (LineSolution& solution : found) {
    fit.refine(solution, 30);
    LineSolution again = fit.search(solution.settings, solution.prior);
    fit.refine(again, 40);
    if (again.cost < solution.cost) solution = std::move(again);
    tell();
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const LineSolution& a, const LineSolution& b) { return a.cost < b.cost; });
  return describe(fit, found, pictures, guess);
}

}  // namespace ortung
