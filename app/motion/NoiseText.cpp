#include "NoiseText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung::app {
namespace {

/// Least probability of a reading. A model needs some even if a log shows less: other logs have
/// more.
constexpr double kLeastFloor = 0.005;

struct TermText {
  NoiseTerm term;
  const char* name;
  const char* unit;
  double scale;
};

const std::vector<TermText>& termTexts() {
  static const std::vector<TermText> kTerms = {
      {NoiseTerm::kRangeBias, "range bias", "m", 1.0},
      {NoiseTerm::kRangePerMetre, "  per m", "m/m", 1.0},
      {NoiseTerm::kRangePerMetreRad, "  per m and rad", "1/rad", 1.0},
      {NoiseTerm::kRangePerMetreRad2, "  per m and rad^2", "1/rad^2", 1.0},
      {NoiseTerm::kBearingBias, "bearing bias", "deg", degrees(1.0)},
      {NoiseTerm::kBearingPerRad, "  per rad", "rad/rad", 1.0},
      {NoiseTerm::kBearingPerRad2, "  per rad^2", "1/rad", 1.0},
      {NoiseTerm::kMountX, "mount x", "m", 1.0},
      {NoiseTerm::kMountY, "mount y", "m", 1.0},
      {NoiseTerm::kMountTheta, "mount theta", "deg", degrees(1.0)},
      {NoiseTerm::kLatency, "latency", "s", 1.0}};
  return kTerms;
}

std::string line(const char* name, const Learned& learned, double scale, const char* unit) {
  return fmt::format("  {:<17}{:>9.4f} +- {:.4f} {}", name, scale * learned.value,
                     scale * learned.error, unit);
}

std::string shapeText(const char* what, const NoiseShape& shape, double scale, const char* unit) {
  if (shape.values == 0) return "";
  std::string text = fmt::format("  {} {}\n", shape.values, what);
  text += line("sigma", shape.sigma, scale, unit) + "\n";
  if (shape.sigmaPerMetre.value > 0.0)
    text += line("sigma per metre", shape.sigmaPerMetre, 1.0, "m/m") + "\n";
  text += line("outliers", shape.outliers, 100.0, "%");
  return text + fmt::format(" (p at least {:.3f}; a value counts for {:.3f})\n", shape.floor,
                            shape.independent);
}

double known(const LearnedNoise& noise, NoiseTerm term) {
  const auto k = static_cast<std::size_t>(term);
  return noise.fit.isKnown[k] ? noise.fit.terms[k].value : 0.0;
}

std::string number(double value) { return fmt::format("{:.4f}", value); }

/// Adds the mount as a table in braces, if it was learned.
void addPose(const SensorConfig& sensor, const LearnedNoise& noise, std::vector<TomlEntry>& out) {
  const double x = known(noise, NoiseTerm::kMountX);
  const double y = known(noise, NoiseTerm::kMountY);
  const double theta = known(noise, NoiseTerm::kMountTheta);
  if (x == 0.0 && y == 0.0 && theta == 0.0) return;
  const Parameters pose = sensor.parameters.table("pose");
  std::string text = fmt::format("{{ x_m = {}, y_m = {}", number(pose.numberOr("x_m", 0.0) + x),
                                 number(pose.numberOr("y_m", 0.0) + y));
  if (pose.has("z_m")) text += ", z_m = " + number(pose.number("z_m"));
  const double turn = pose.numberOr("theta_deg", 0.0) + degrees(theta);
  out.emplace_back("pose", text + ", theta_deg = " + number(turn) + " }");
}

void addSigmas(const NoiseShape& shape, const std::string& stem, std::vector<TomlEntry>& out) {
  out.emplace_back(stem + "_m", number(std::max(1e-4, shape.sigma.value)));
  out.emplace_back(stem + "_per_m", number(shape.sigmaPerMetre.value));
}

/// Adds biases of sightings: those of the robot file, followed by those that were found in readings
/// corrected by them. Both together are again such a bias, except for terms of higher order.
void addBias(const SensorConfig& sensor, const LearnedNoise& noise, std::vector<TomlEntry>& out) {
  const Parameters& p = sensor.parameters;
  const auto both = [&](const char* key, double found) {
    const double sum = p.numberOr(key, 0.0) + found;
    if (sum != 0.0 || p.has(key)) out.emplace_back(key, number(sum));
  };
  // The known bias has scaled the range by this factor, so it scales the new bias, too.
  const double first = 1.0 + p.numberOr("range_bias_per_m", 0.0);
  const double then = 1.0 + known(noise, NoiseTerm::kRangePerMetre);
  const double lopsided = p.numberOr("range_bias_per_m_rad", 0.0);
  const double bent = p.numberOr("range_bias_per_m_rad2", 0.0);
  const double thenLopsided = known(noise, NoiseTerm::kRangePerMetreRad);
  both("range_bias_m", first * known(noise, NoiseTerm::kRangeBias));
  both("range_bias_per_m", first * (then - 1.0));
  both("range_bias_per_m_rad", first * thenLopsided + (then - 1.0) * lopsided);
  both("range_bias_per_m_rad2", first * known(noise, NoiseTerm::kRangePerMetreRad2) +
                                    (then - 1.0) * bent + lopsided * thenLopsided);
  both("bearing_bias_deg", degrees(known(noise, NoiseTerm::kBearingBias)));
  both("bearing_bias_per_rad", known(noise, NoiseTerm::kBearingPerRad));
  both("bearing_bias_per_rad2", known(noise, NoiseTerm::kBearingPerRad2));
}

}  // namespace

std::string noiseText(std::span<SensorData* const> features, const LearnedNoise& noise) {
  std::string text = toText(features.front()->id());
  if (features.size() > 1) text += fmt::format(" and {} more", features.size() - 1);
  text += fmt::format(", {} readings\n", noise.readings);
  text += shapeText("ranges", noise.fit.distances, 1.0, "m");
  text += shapeText("bearings", noise.fit.angles, degrees(1.0), "deg");
  for (const TermText& t : termTexts()) {
    const auto k = static_cast<std::size_t>(t.term);
    const Learned& learned = noise.fit.terms[k];
    if (std::isnan(learned.error)) continue;
    text += line(t.name, learned, t.scale, t.unit);
    text += noise.fit.isKnown[k] ? "\n" : " (none: less than three errors)\n";
  }
  return text;
}

std::vector<TomlEntry> noiseEntries(const SensorConfig& sensor, const LearnedNoise& noise) {
  const NoiseShape& distances = noise.fit.distances;
  const NoiseShape& angles = noise.fit.angles;
  std::vector<TomlEntry> out;
  const bool isCylinders = sensor.plugin == "lrf_cylinders";
  const bool isLandmarks = isCylinders || sensor.plugin == "landmarks";
  if (!isLandmarks && sensor.plugin != "lrf" && sensor.plugin != "sonar") return out;
  if (distances.values > 0) addSigmas(distances, isLandmarks ? "range_sigma" : "sigma", out);
  if (angles.values > 0) out.emplace_back("bearing_sigma_deg", number(degrees(angles.sigma.value)));
  const double floor = std::max({kLeastFloor, distances.floor, angles.floor});
  out.emplace_back("outliers", number(std::min(0.5, floor)));
  if (isCylinders || (isLandmarks && sensor.parameters.textOr("features", "each") == "list"))
    addBias(sensor, noise, out);
  addPose(sensor, noise, out);
  return out;
}

}  // namespace ortung::app
