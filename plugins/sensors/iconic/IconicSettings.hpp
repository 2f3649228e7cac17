#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "../common/SensorSettings.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/tables/SensorModel.hpp"

namespace ortung {

/// The features that an iconic camera can detect, by name.
inline const std::vector<std::string> kIconicFeatures = {"lines", "goals",  "posts",
                                                         "ball",  "robots", "obstacles"};

/// Landmarks of one kind: goals or posts.
struct IconicLandmarks {
  std::string kind;            ///< kind of the landmarks in the world
  bool areIdentified = true;   ///< whether they can be distinguished
  LandmarksData::Config list;  ///< format if they are identified
  PointsData::Config points;   ///< format if they are not identified
};

/// Settings of both halves of the iconic camera and of the iconic omnivision, which differ in their
/// field of view.
struct IconicSettings {
  SensorId id;  ///< its feature is not used
  Mounting mounting;
  std::vector<std::string> see;  ///< detected features, of kIconicFeatures
  double fieldOfView = kTurn;    ///< full opening angle [rad]; 2 pi: all around
  double minRange = 0.0;         ///< least range along the floor [m]
  double maxRange = 10.0;        ///< greatest range along the floor [m]
  double period = 0.1;           ///< time between two readings [s]
  int rays = 120;                ///< number of scan lines along which field lines are searched
  PointsData::Config lines;
  IconicLandmarks goals;
  IconicLandmarks posts;
  bool occlusion = true;      ///< whether bodies hide what is behind them
  double slack = 0.3;         ///< distance from a landmark within which bodies do not hide it [m]
  double visibleShare = 0.5;  ///< share of a body's width that must be visible
  // The simulated camera's noise.
  double noiseRangeSigma = 0.0;  ///< standard deviation at range 0 [m]
  double noiseRangeSigmaPerMetre = 0.0;
  double noiseBearingSigma = 0.0;  ///< standard deviation of bearings [rad]
  double missedShare = 0.0;
  double falseShare = 0.0;

  bool sees(const std::string& feature) const {
    return std::find(see.begin(), see.end(), feature) != see.end();
  }
};

namespace iconic {

inline std::vector<std::string> readSee(const Parameters& p) {
  std::vector<std::string> see = kIconicFeatures;
  if (!p.has("see")) return see;
  see = p.texts("see");
  if (see.empty()) p.fail("see", "is empty, expected features that the camera detects");
  for (std::size_t i = 0; i < see.size(); ++i) {
    if (std::find(kIconicFeatures.begin(), kIconicFeatures.end(), see[i]) == kIconicFeatures.end())
      p.fail("see",
             "has \"" + see[i] + "\", expected lines, goals, posts, ball, robots or obstacles");
    if (std::find(see.begin(), see.begin() + static_cast<std::ptrdiff_t>(i), see[i]) !=
        see.begin() + static_cast<std::ptrdiff_t>(i))
      p.fail("see", "has \"" + see[i] + "\" twice");
  }
  return see;
}

inline std::vector<std::uint32_t> readIdentities(const Parameters& p,
                                                 const std::vector<double>& defaults) {
  std::vector<std::uint32_t> identities;
  for (const double number : p.numbersOr("identities", defaults, -1, {0, 1e6})) {
    const auto identity = static_cast<std::uint32_t>(number);
    if (identity != number)
      p.fail("identities", "has " + std::to_string(number) + ", must have whole numbers");
    if (std::find(identities.begin(), identities.end(), identity) != identities.end())
      p.fail("identities", "has " + std::to_string(identity) + " twice");
    identities.push_back(identity);
  }
  if (identities.empty() || identities.size() > 256)
    p.fail("identities",
           "has " + std::to_string(identities.size()) + " numbers, must have 1 to 256");
  return identities;
}

/// Reads the landmarks of a kind. @param p the table [sensor.goals] or [sensor.posts]
inline IconicLandmarks readLandmarks(const Parameters& p, const IconicSettings& s,
                                     const std::string& kind,
                                     const std::vector<double>& identities) {
  IconicLandmarks l;
  l.kind = kind;
  l.areIdentified = p.flagOr("identified", true);
  const double maxRange = p.numberOr("max_range_m", s.maxRange, {0.05, s.maxRange});
  if (l.areIdentified) {
    l.list.identities = readIdentities(p, identities);
    l.list.range = SensorModel::read(p, "range_sigma_m", {.sigma = 0.1, .sigmaPerMetre = 0.05});
    l.list.bearing = SensorModel::read(p, "bearing_sigma_deg", {.sigma = radians(3.0)});
    l.list.maxRange = maxRange;
    l.list.fieldOfView = s.fieldOfView;
  } else {
    l.points.model =
        SensorModel::read(p, "sigma_m", {.sigma = 0.1, .sigmaPerMetre = 0.05, .exponent = 1.0});
    l.points.maxRange = maxRange;
    l.points.fieldOfView = s.fieldOfView;
  }
  return l;
}

/// Reads the lines. @param p the table [sensor.lines]
inline void readLines(const Parameters& p, IconicSettings& s) {
  PointsData::Config& c = s.lines;
  s.rays = static_cast<int>(p.integerOr("rays", 120, {1, 1440}));
  c.maxRange = p.numberOr("max_range_m", std::min(s.maxRange, 6.0), {0.05, s.maxRange});
  c.fieldOfView = s.fieldOfView;
  c.cell = p.numberOr("cell_m", c.cell, {0.005, 1.0});
  c.usedPoints = static_cast<int>(p.integerOr("used_points", 0, {0, 4096}));
  c.model = SensorModel::read(p, "sigma_m", c.model);
}

}  // namespace iconic

/// Reads all settings of both halves.
/// @param fieldOfViewDeg default opening angle [degrees] @throws ConfigError
inline IconicSettings readIconicSettings(const Parameters& p, const char* model,
                                         double fieldOfViewDeg) {
  IconicSettings s;
  if (p.has("feature")) p.fail("feature", "is given, but the features' names come from see");
  s.id = sensorIdOf(p, {model, "camera", "iconic"});
  s.mounting = readMounting(p, 0.6);
  s.see = iconic::readSee(p);
  s.fieldOfView = radians(p.numberOr("fov_deg", fieldOfViewDeg, {1.0, 360.0}));
  s.maxRange = p.numberOr("max_range_m", 10.0, {0.05, 1000.0});
  s.minRange = p.numberOr("min_range_m", 0.0, {0.0, s.maxRange});
  s.period = readPeriod(p, 0.1);
  s.occlusion = p.flagOr("occlusion", true);
  s.slack = p.numberOr("slack_m", 0.3, {0.0, 10.0});
  s.visibleShare = p.numberOr("visible_share", 0.5, {0.0, 1.0});
  // Tables of features that are not detected stay unread and are reported as unknown keys.
  if (s.sees("lines")) iconic::readLines(p.table("lines"), s);
  if (s.sees("goals")) s.goals = iconic::readLandmarks(p.table("goals"), s, "goal", {1, 2});
  if (s.sees("posts")) s.posts = iconic::readLandmarks(p.table("posts"), s, "post", {1, 2, 3, 4});
  s.noiseRangeSigma = p.numberOr("noise_range_sigma_m", 0.02, {0.0, 100.0});
  s.noiseRangeSigmaPerMetre = p.numberOr("noise_range_sigma_per_m", 0.03, {0.0, 10.0});
  s.noiseBearingSigma = radians(p.numberOr("noise_bearing_sigma_deg", 1.0, {0.0, 180.0}));
  s.missedShare = readShare(p, "missed_share");
  s.falseShare = readShare(p, "false_share");
  return s;
}

inline IconicSettings readOmnivisionSettings(const Parameters& p) {
  return readIconicSettings(p, "omnivision", 360.0);
}

inline IconicSettings readCameraSettings(const Parameters& p) {
  return readIconicSettings(p, "webcam", 60.0);
}

}  // namespace ortung
