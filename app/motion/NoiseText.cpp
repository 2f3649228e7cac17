#include "NoiseText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung::app {
namespace {

/// A model needs some room even where a log shows less: other logs are not as tame.
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
      {NoiseTerm::kBearingBias, "bearing bias", "deg", degrees(1.0)},
      {NoiseTerm::kMountX, "mount x", "m", 1.0},
      {NoiseTerm::kMountY, "mount y", "m", 1.0},
      {NoiseTerm::kMountTheta, "mount theta", "deg", degrees(1.0)},
      {NoiseTerm::kLatency, "latency", "s", 1.0}};
  return kTerms;
}

std::string line(const char* name, const Learned& learned, double scale, const char* unit) {
  return fmt::format("  {:<16}{:>10.4f} +- {:.4f} {}", name, scale * learned.value,
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

/// The mount as a table in braces, if it moved.
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
  const bool isLandmarks = sensor.plugin == "landmarks";
  if (!isLandmarks && sensor.plugin != "lrf" && sensor.plugin != "sonar") return out;
  if (distances.values > 0) addSigmas(distances, isLandmarks ? "range_sigma" : "sigma", out);
  if (angles.values > 0) out.emplace_back("bearing_sigma_deg", number(degrees(angles.sigma.value)));
  const double floor = std::max({kLeastFloor, distances.floor, angles.floor});
  out.emplace_back("outliers", number(std::min(0.5, floor)));
  addPose(sensor, noise, out);
  return out;
}

}  // namespace ortung::app
