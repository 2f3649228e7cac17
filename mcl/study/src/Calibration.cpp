#include "ortung/study/Calibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ortung {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Computes the area under the ROC curve by the ranks of the claims that came true (Mann and
/// Whitney, "On a test of whether one of two random variables is stochastically larger than the
/// other", Annals of Mathematical Statistics 18, 1947).
/// @param claims claims by increasing probability
double areaUnderCurve(const std::vector<Claim>& claims) {
  double pairs = 0.0;  // pairs in which the claim that came true was the higher one
  double lower = 0.0;  // claims that did not come true so far
  double all = 0.0;    // claims that came true
  for (std::size_t i = 0; i < claims.size();) {
    std::size_t end = i;
    double isTrue = 0.0;
    while (end < claims.size() && claims[end].probability == claims[i].probability)
      isTrue += claims[end++].cameTrue ? 1.0 : 0.0;
    const double isFalse = static_cast<double>(end - i) - isTrue;
    pairs += isTrue * (lower + isFalse / 2);
    lower += isFalse;
    all += isTrue;
    i = end;
  }
  return all > 0.0 && lower > 0.0 ? pairs / (all * lower) : kNan;
}

}  // namespace

Calibration calibrationOf(std::vector<Claim> claims) {
  std::erase_if(claims, [](const Claim& c) { return !(c.probability >= 0 && c.probability <= 1); });
  std::ranges::sort(claims, {}, &Claim::probability);
  Calibration result;
  const auto kBins = result.bins.size();
  for (const Claim& claim : claims) {
    const auto place = static_cast<std::size_t>(claim.probability * static_cast<float>(kBins));
    ReliabilityBin& bin = result.bins[std::min(place, kBins - 1)];
    ++bin.count;
    bin.claimed += static_cast<double>(claim.probability);
    bin.share += claim.cameTrue ? 1.0 : 0.0;
  }
  result.error = claims.empty() ? kNan : 0.0;
  for (ReliabilityBin& bin : result.bins) {
    const auto count = static_cast<double>(bin.count);
    bin.claimed = bin.count > 0 ? bin.claimed / count : kNan;
    bin.share = bin.count > 0 ? bin.share / count : kNan;
    if (bin.count > 0)
      result.error +=
          std::abs(bin.claimed - bin.share) * count / static_cast<double>(claims.size());
  }
  result.area = areaUnderCurve(claims);
  return result;
}

Calibration qualityCalibration(const std::vector<EvaluationPoint>& points) {
  constexpr double kRight = 0.5;  // [m], as in PoseEstimate::quality
  std::vector<Claim> claims;
  for (const EvaluationPoint& p : points)
    claims.push_back({static_cast<float>(p.quality), p.positionError < kRight});
  return calibrationOf(std::move(claims));
}

}  // namespace ortung
