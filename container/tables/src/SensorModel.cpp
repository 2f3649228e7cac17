#include "ortung/tables/SensorModel.hpp"

#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung {

double SensorModel::logProbability(double sigmas) const {
  return std::log((1.0 - outliers) * std::exp(-0.5 * sigmas * sigmas) + outliers);
}

double SensorModel::logFloor() const { return exponent * std::log(outliers); }

SensorModel SensorModel::read(const Parameters& p, const std::string& sigmaKey,
                              const SensorModel& defaults) {
  const bool inDegrees = sigmaKey.ends_with("_deg");
  const double unit = inDegrees ? kDegree : 1.0;
  constexpr double kTiny = 1e-6;
  SensorModel model = defaults;
  model.sigma =
      unit * p.numberOr(sigmaKey, defaults.sigma / unit, {kTiny, inDegrees ? 180.0 : 1000.0});
  if (!inDegrees) {
    // "range_sigma_m" goes with "range_sigma_per_m", "sigma_m" with "sigma_per_m"
    const std::string stem = sigmaKey.substr(0, sigmaKey.rfind('_'));
    model.sigmaPerMetre = p.numberOr(stem + "_per_m", defaults.sigmaPerMetre, {0.0, 10.0});
  }
  model.outliers = p.numberOr("outliers", defaults.outliers, {kTiny, 1.0 - kTiny});
  model.maxRangeMass = p.numberOr("max_range_mass", defaults.maxRangeMass, {kTiny, 1.0 - kTiny});
  model.exponent = p.numberOr("exponent", defaults.exponent, {1e-3, 1.0});
  return model;
}

GaussianTable::GaussianTable(const SensorModel& model) : values_(kSize) {
  for (int i = 0; i < kSize; ++i) {
    const double sigmas = static_cast<double>(i) / static_cast<double>(kPerSigma);
    values_[static_cast<std::size_t>(i)] =
        static_cast<float>(model.exponent * model.logProbability(sigmas));
  }
  values_.back() = static_cast<float>(model.logFloor());
}

}  // namespace ortung
