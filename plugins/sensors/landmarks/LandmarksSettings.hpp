#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "../common/SensorSettings.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// Settings of both halves of the observer of identified landmarks.
struct LandmarksSettings {
  SensorId id;  ///< identifier; its feature is used only for a list
  Mounting mounting;
  bool isIdentified = true;  ///< whether real readings distinguish them
  /// Whether the feature is one LandmarksData; otherwise each landmark has features of its own:
  bool isList = false;
  bool hasDistances = true;
  bool hasBearings = true;
  std::string kind;  ///< kind of the landmarks in the world, and prefix of the features' names
  std::vector<std::uint32_t> identities;
  double minRange = 0.0;       ///< least range [m]
  double maxRange = 20.0;      ///< greatest range [m]
  double fieldOfView = kTurn;  ///< full opening angle [rad]; 2 pi: all around
  SensorModel range;           ///< model of distances [m]
  SensorModel bearing;         ///< model of bearings [rad]
  SightingBias bias;           ///< bias of real readings in a list
  bool slant = false;          ///< whether distances are measured in space, not along the floor
  double rangeScale = 1.0;     ///< measured by true distance
  double period = 0.1;         ///< time between two readings [s]
  double slack = 0.3;          ///< distance from a landmark within which bodies do not hide it [m]
  bool occlusion = true;       ///< whether obstacles hide landmarks
  double noiseRangeSigma = 0.0;  ///< standard deviation of simulated distances at distance 0 [m]
  double noiseRangeSigmaPerMetre = 0.0;
  double noiseBearingSigma = 0.0;  ///< standard deviation of simulated bearings [rad]
  double missedShare = 0.0;        ///< probability that a landmark in sight is missed
  double falseShare = 0.0;  ///< share of false sightings, which are anywhere in the field of view
};

/// Refuses a kind other than letters, digits and "_.-", or one too long to be part of a feature's
/// name.
inline void checkKind(const Parameters& p, const std::string& kind) {
  const bool isName =
      !kind.empty() && kind.size() <= 32 && std::all_of(kind.begin(), kind.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '.' || c == '-';
      });
  if (!isName) p.fail("kind", "is \"" + kind + "\", must be 1 to 32 of [A-Za-z0-9_.-]");
}

inline std::vector<std::uint32_t> readIdentities(const Parameters& p) {
  const std::vector<double> numbers = p.numbersOr("identities", {1, 2, 3, 4}, -1, {0, 1e6});
  if (numbers.empty() || numbers.size() > 256)
    p.fail("identities", "has " + std::to_string(numbers.size()) + " numbers, must have 1 to 256");
  std::vector<std::uint32_t> identities;
  for (const double number : numbers) {
    if (number != std::floor(number))
      p.fail("identities", "has " + std::to_string(number) + ", must have whole numbers");
    const auto identity = static_cast<std::uint32_t>(number);
    if (std::find(identities.begin(), identities.end(), identity) != identities.end())
      p.fail("identities", "has " + std::to_string(identity) + " twice");
    identities.push_back(identity);
  }
  return identities;
}

/// Reads the bias of real readings. @throws ConfigError
inline SightingBias readSightingBias(const Parameters& p, bool isList) {
  for (const char* key :
       {"range_bias_m", "range_bias_per_m", "range_bias_per_m_rad", "range_bias_per_m_rad2",
        "bearing_bias_deg", "bearing_bias_per_rad", "bearing_bias_per_rad2"}) {
    if (p.has(key) && !isList)
      p.fail(key, "needs range and bearing of a sighting together: features = \"list\"");
  }
  SightingBias bias;
  bias.metres = p.numberOr("range_bias_m", 0.0, {-10.0, 10.0});
  bias.perMetre = p.numberOr("range_bias_per_m", 0.0, {-0.5, 0.5});
  bias.perMetreRad = p.numberOr("range_bias_per_m_rad", 0.0, {-1.0, 1.0});
  bias.perMetreRad2 = p.numberOr("range_bias_per_m_rad2", 0.0, {-1.0, 1.0});
  bias.radians = radians(p.numberOr("bearing_bias_deg", 0.0, {-180.0, 180.0}));
  bias.perRad = p.numberOr("bearing_bias_per_rad", 0.0, {-0.3, 0.3});
  bias.perRad2 = p.numberOr("bearing_bias_per_rad2", 0.0, {-0.2, 0.2});
  return bias;
}

/// Reads all settings of both halves. @throws ConfigError
inline LandmarksSettings readLandmarksSettings(const Parameters& p) {
  LandmarksSettings s;
  s.kind = p.textOr("kind", "post");
  checkKind(p, s.kind);
  const std::string features =
      p.choiceOr("features", "each", {"each", "list", "distances", "bearings"});
  s.isList = features == "list";
  s.isIdentified = p.flagOr("identified", true);
  if (!s.isIdentified && !s.isList)
    p.fail("identified", "is false, which needs features = \"list\"");
  s.hasDistances = features != "bearings";
  s.hasBearings = features != "distances";
  if (!s.isList && p.has("feature"))
    p.fail("feature",
           "is given, but with features = \"" + features + "\" the names come from kind");
  s.id = sensorIdOf(p, {"omnivision", "camera", s.kind + "s"});
  s.mounting = readMounting(p, 0.5);
  s.identities = readIdentities(p);
  s.maxRange = p.numberOr("max_range_m", 20.0, {0.05, 1000.0});
  s.minRange = p.numberOr("min_range_m", 0.0, {0.0, s.maxRange});
  s.fieldOfView = radians(p.numberOr("fov_deg", 360.0, {1.0, 360.0}));
  s.range = SensorModel::read(p, "range_sigma_m", {.sigma = 0.1});
  s.bearing = SensorModel::read(p, "bearing_sigma_deg", {.sigma = radians(3.0)});
  s.bias = readSightingBias(p, s.isList);
  s.slant = p.flagOr("slant", false);
  s.rangeScale = p.numberOr("range_scale", 1.0, {0.1, 10.0});
  if (!s.isIdentified && (s.slant || s.rangeScale != 1.0))
    p.fail("identified",
           "is false, so landmarks' places are learned: neither slant nor range_scale");
  s.period = readPeriod(p, 0.1);
  s.slack = p.numberOr("slack_m", 0.3, {0.0, 10.0});
  s.occlusion = p.flagOr("occlusion", true);
  s.noiseRangeSigma = p.numberOr("noise_range_sigma_m", s.range.sigma, {0.0, 100.0});
  s.noiseRangeSigmaPerMetre =
      p.numberOr("noise_range_sigma_per_m", s.range.sigmaPerMetre, {0.0, 10.0});
  s.noiseBearingSigma = p.has("noise_bearing_sigma_deg")
                            ? radians(p.number("noise_bearing_sigma_deg", {0.0, 180.0}))
                            : s.bearing.sigma;
  s.missedShare = readShare(p, "missed_share");
  s.falseShare = readShare(p, "false_share");
  return s;
}

inline constexpr const char* kDistanceEnding = "Distance";
inline constexpr const char* kBearingEnding = "Bearing";

}  // namespace ortung
